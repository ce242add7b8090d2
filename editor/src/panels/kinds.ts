// Parts of the page for surfaces and for curves: elements with data-for, and file formats.

import type { Shape } from '../shape/shape';

const formats = { surface: ['obj', 'off', 'ply', 'stl'], curve: ['csv', 'dat', 'obj', 'svg', 'xyz'] };

/** format: the list to choose from; what the file came in is chosen. */
export function showFor(shape: Shape, name: string, format: HTMLSelectElement): void {
  const kind = shape.curve ? 'curve' : 'surface';
  for (const element of document.querySelectorAll<HTMLElement>('[data-for]')) element.hidden = element.dataset.for !== kind;
  const own = name.split('.').at(-1)!.toLowerCase();
  // Only tracks can be saved as tracks.
  const offered = own === 'gpx' && shape.curve ? [...formats[kind], own] : formats[kind];
  format.replaceChildren(...offered.map((which) => new Option(which.toUpperCase(), which)));
  format.value = offered.includes(own) ? own : offered[0];
}
