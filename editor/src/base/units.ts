// The name of the file's unit, a mere word, as files do not give it. The browser keeps the choice.

const key = 'vspring-unit';
let unit = kept();

function kept(): string {
  try {
    return localStorage.getItem(key) ?? '';
  } catch {
    return '';  // if the browser stores nothing
  }
}

const metres: Record<string, number> = { mm: 0.001, cm: 0.01, m: 1, in: 0.0254, ft: 0.3048 };

/** How many units of the file one of that name is. */
export function inUnitOfFile(name: string): number {
  return metres[name] / metres[unit];
}

/** Empty where nobody has said. */
export function unitOf(): string {
  return unit;
}

/** A length in words. */
export function withUnit(length: string): string {
  return unit ? `${length} ${unit}` : length;
}

export function bindUnit(menu: HTMLSelectElement, changed: () => void): void {
  menu.value = unit;
  menu.addEventListener('change', () => {
    unit = menu.value;
    try {
      localStorage.setItem(key, unit);
    } catch {
      // The choice then lasts as long as the page.
    }
    changed();
  });
}
