// The range of colours, with its numbers.

import { gradientOf } from '../../../page/colours.js';
import { short } from '../../../page/numbers.js';
import { marksOf } from '../../../page/surface_fields.js';
import type { Field } from '../view/fields';

function show(legend: HTMLElement, title: string, map: number[][], marks: string[]): void {
  legend.hidden = false;
  legend.querySelector('figcaption')!.textContent = title;
  legend.querySelector<HTMLElement>('.ramp')!.style.background = gradientOf(map);
  legend.querySelector('.marks')!.replaceChildren(...marks.map((textContent) => Object.assign(document.createElement('span'), { textContent })));
}

export function showLegend(legend: HTMLElement, field: Field | null): void {
  legend.hidden = !field;
  if (field) show(legend, field.title, field.map, marksOf(field.range));
}

/** Of distances from 0 to the greatest, beyond which there may be more. */
export function showLengths(legend: HTMLElement, title: string, map: number[][], greatest: number): void {
  show(legend, title, map, [0, greatest / 2, greatest].map((length) => short(Number(length.toPrecision(3)))));
}
