// What of the page is for surfaces and what for curves: elements with data-for, and file formats.

import type { Shape } from '../shape/shape';

const formats = { surface: ['obj', 'off', 'ply', 'stl'], curve: ['csv', 'dat', 'obj', 'svg', 'xyz'] };

/** format: the list to choose from; what the file came in is chosen. */
export function showFor(shape: Shape, name: string, format: HTMLSelectElement): void {
  const kind = shape.curve ? 'curve' : 'surface';
  for (const element of document.querySelectorAll<HTMLElement>('[data-for]')) element.hidden = element.dataset.for !== kind;
  format.replaceChildren(...formats[kind].map((which) => new Option(which.toUpperCase(), which)));
  const own = name.split('.').at(-1)!.toLowerCase();
  format.value = formats[kind].includes(own) ? own : formats[kind][0];
}
