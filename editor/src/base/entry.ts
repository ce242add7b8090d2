// Entries of numbers: a length may have its unit, arrow keys and two buttons change a number by a twentieth, and a
// message says how to correct a wrong entry.

import { inUnitOfFile, unitOf } from './units';

export interface Wanted {
  /** Completes "Give …". */
  words: string;
  takes: (value: number) => boolean;
  isLength?: boolean;
}

export function wholeNumber(least: number, most: number): Wanted {
  return { words: `a whole number from ${least} to ${most}`, takes: (value) => Number.isInteger(value) && value >= least && value <= most };
}

/** NaN: none. */
function plainNumber(text: string): number {
  return text.trim() === '' ? NaN : Number(text.trim().replaceAll('−', '-').replace(',', '.'));
}

/** A number as people type it, or in words what is to be done. */
export function numberIn(text: string, { words, takes, isLength }: Wanted): number | string {
  const [, digits, unit] = text.match(/^(.*?)\s*(mm|cm|m|in|ft)?$/i)!;
  if (unit && isLength && !unitOf()) return `Choose the unit of the file below, or leave out ${unit}`;
  const value = unit && isLength ? plainNumber(digits) * inUnitOfFile(unit.toLowerCase()) : plainNumber(text);
  return takes(value) ? value : `Give ${words}`;
}

/** All digits that anybody looks at, with the minus sign of the keyboard, as it is typed over and copied. */
export function shownNumber(value: number): string {
  return String(Number(value.toPrecision(6)));
}

/** A twentieth more or less, of whole numbers one at least. */
function stepped(value: number, sign: number, takes: Wanted['takes']): number {
  const step = Math.abs(value) / 20 || 1;
  const fine = Number((value + sign * step).toPrecision(3));
  return takes(fine) ? fine : Math.round(value + sign * Math.max(1, step));
}

export class Entry {
  private shown = { value: NaN, unit: '' };
  private readonly note = Object.assign(document.createElement('p'), { className: 'wrong', hidden: true });

  /** changed: null where what is typed cannot be taken. */
  constructor(private readonly input: HTMLInputElement, private readonly wanted: () => Wanted, private readonly changed: (value: number | null) => void) {
    this.note.role = 'alert';
    input.closest('.field')!.after(this.note);
    input.after(this.stepper(-1), this.stepper(1));
    input.addEventListener('change', () => this.enter(input.value));
    input.addEventListener('keydown', (event) => {
      const sign = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (!sign) return;
      event.preventDefault();
      this.step(sign);
    });
    if (input.value) this.show(Number(input.value));
  }

  /** The last number that was taken, or is shown. */
  get value(): number {
    return this.shown.value;
  }

  get wrong(): boolean {
    return !this.note.hidden;
  }

  /** What is being typed stays until there is another number, or another unit. */
  show(value: number): void {
    const unit = this.wanted().isLength ? unitOf() : '';
    if (value !== this.shown.value || unit !== this.shown.unit) this.write(value, unit);
  }

  private write(value: number, unit: string): void {
    this.shown = { value, unit };
    this.input.value = `${shownNumber(value)}${unit && ` ${unit}`}`;
    this.say('');
  }

  private enter(text: string): void {
    const found = numberIn(text, this.wanted());
    if (typeof found === 'string') {
      this.say(found);
      this.changed(null);
      return;
    }
    this.write(found, this.wanted().isLength ? unitOf() : '');
    this.changed(found);
  }

  private step(sign: number): void {
    const { takes } = this.wanted();
    const next = stepped(this.value, sign, takes);
    if (takes(next)) this.enter(String(next));
  }

  private say(problem: string): void {
    this.note.textContent = problem;
    this.note.hidden = problem === '';
    this.input.setAttribute('aria-invalid', String(problem !== ''));
  }

  /** For the pointer; keys have the arrows. */
  private stepper(sign: number): HTMLButtonElement {
    const button = Object.assign(document.createElement('button'), { type: 'button', className: sign > 0 ? 'step more' : 'step less', tabIndex: -1, ariaHidden: 'true' });
    button.addEventListener('click', () => this.step(sign));
    return button;
  }
}
