// The range of colours, with its numbers.

import { gradientOf } from '../../page/colours.js';
import { marksOf } from '../../page/surface_fields.js';
import type { Field } from './fields';

export function showLegend(legend: HTMLElement, field: Field | null): void {
  legend.hidden = !field;
  if (!field) return;
  legend.querySelector('figcaption')!.textContent = field.title;
  legend.querySelector<HTMLElement>('.ramp')!.style.background = gradientOf(field.map);
  legend.querySelector('.marks')!.replaceChildren(...marksOf(field.range).map((textContent: string) =>
    Object.assign(document.createElement('span'), { textContent })));
}
