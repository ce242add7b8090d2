// How far a pull reaches, as a slider: at its end the whole shape moves.

import { short } from '../../../page/numbers.js';
import type { Editor } from '../edit/editor';

export function bindReach(slider: HTMLInputElement, editor: Editor): void {
  slider.addEventListener('input', () => editor.set({ reach: Math.min(1, slider.valueAsNumber / 100) }));
}

export function showReach(slider: HTMLInputElement, { reaches, shape }: Editor): void {
  slider.disabled = !shape;
  slider.value = String(Math.round(100 * reaches));
  const length = shape ? short(Number((reaches / shape.scale).toPrecision(2))) : '';
  slider.parentElement!.querySelector('output')!.textContent = reaches >= 1 ? 'all' : length;
}
