// The choice of the plane about which picks and moves are mirrored, and how many nodes have a mirror image.

import { counted } from '../base/words';
import type { Editor } from '../edit/editor';
import type { Mirror } from '../shape/mirror';

export function bindSymmetry(menu: HTMLSelectElement, editor: Editor): void {
  menu.addEventListener('change', () => editor.setSymmetry(menu.value ? 'xyz'.indexOf(menu.value) : null));
}

let told: Mirror | null = null;

export function showSymmetry(note: HTMLElement, { mirror, shape }: Editor): void {
  note.hidden = !mirror;
  if (mirror && mirror !== told) note.textContent = `${mirror.count.toLocaleString('en')} of ${counted(shape!.input.length / 3, 'node')} have a mirror image.`;
  told = mirror;
}
