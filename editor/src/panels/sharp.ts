// The angle over which edges stay sharp, and how many do.

import { counted } from '../base/words';
import type { Editor } from '../edit/editor';

export class SharpPanel {
  private readonly slider: HTMLInputElement;

  constructor(field: HTMLElement, private readonly note: HTMLElement, private readonly editor: Editor) {
    this.slider = field.querySelector('input')!;
    this.slider.addEventListener('input', () => this.tell());
    this.slider.addEventListener('change', () => { if (editor.constraints.sharp) void editor.setSharp(this.slider.valueAsNumber); });
  }

  toggle(): void {
    void this.editor.setSharp(this.editor.constraints.sharp ? null : this.slider.valueAsNumber);
  }

  refresh(): void {
    const { constraints: { sharp }, sharp: edges, busy } = this.editor;
    if (sharp) this.slider.value = String(sharp.angle);
    this.tell();
    this.note.hidden = edges.length === 0 && !sharp;
    if (busy) return;
    this.note.textContent = edges.length > 0 ? `${counted(edges.length / 2, 'edge')} ${edges.length > 2 ? 'stay' : 'stays'} sharp.` : 'No edge turns by more than that.';
  }

  private tell(): void {
    this.slider.parentElement!.querySelector('output')!.textContent = `${this.slider.value}°`;
  }
}
