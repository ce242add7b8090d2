// The brush's settings next to the view, for fingers, which have no keys: its size, and whether it removes.

import { narrowest, widest, type Tools } from './tools';

export class BrushCard {
  private readonly slider: HTMLInputElement;

  constructor(private readonly card: HTMLElement, private readonly tools: () => Tools) {
    this.slider = card.querySelector('input')!;
    this.slider.addEventListener('input', () => tools().setRadius(this.shown));
  }

  /** The radius where the slider is. */
  private get shown(): number {
    return narrowest * (widest / narrowest) ** (this.slider.valueAsNumber / 100);
  }

  refresh(): void {
    const { tool, radius } = this.tools();
    this.card.hidden = tool !== 'brush';
    if (Math.round(this.shown) !== radius) this.slider.value = String(100 * Math.log(radius / narrowest) / Math.log(widest / narrowest));
    this.card.querySelector('output')!.textContent = `${2 * radius} pixels`;
  }
}
