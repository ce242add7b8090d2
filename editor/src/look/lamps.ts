// The lamps of reflection lines, by sliders: their number, and their rotation in the view.

import type { Lamps } from '../view/materials';

export function bindLamps(card: HTMLElement, set: (lamps: Lamps) => void): void {
  const [count, turn] = card.querySelectorAll('input');
  const tell = (): void => {
    count.parentElement!.querySelector('output')!.textContent = count.value;
    turn.parentElement!.querySelector('output')!.textContent = `${turn.value}°`;
    set({ count: count.valueAsNumber, turn: (turn.valueAsNumber * Math.PI) / 180 });
  };
  card.addEventListener('input', tell);
  tell();
}
