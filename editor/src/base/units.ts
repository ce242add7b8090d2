// What a unit of the file is: only words, as files do not say. The browser keeps the choice.

const key = 'vspring-unit';
let unit = kept();

function kept(): string {
  try {
    return localStorage.getItem(key) ?? '';
  } catch {
    return '';  // where the browser keeps nothing
  }
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
      // It then lasts as long as the page.
    }
    changed();
  });
}
