// Ways to fair a shape: the constraints of each.

import type { Stay } from '../shape/stays';
import { heldPosition, type Constraints, type Held, type Rule } from '../constraints/constraints';
import type { Cloud } from '../constraints/points';

export const ways = ['smooth', 'repair', 'free'] as const;
export type Way = (typeof ways)[number];

/** In standard deviations of the noise, as `--within auto`. */
const deviations = 3;
/** Of the size, where there is no noise to speak of. */
const small = 1e-3;
const noticeable = 1e-6;

/** noise: its standard deviation. size: of the shape. */
export function suggestedTolerance(noise: number, size: number): number {
  return Number((noise > noticeable * size ? deviations * noise : small * size).toPrecision(2));
}

export function isNoisy(noise: number, size: number): boolean {
  return noise > noticeable * size;
}

/** own: the nodes of the shape as it starts. stay: what they keep of their places along it. sharp: nodes of edges that stay. */
export function smoothed(begun: Constraints, own: Cloud, tolerance: number, stay: Stay, sharp: readonly number[], isCurve: boolean): Constraints {
  const region: Rule[] | null = sharp.length > 0 ? [{ nodes: sharp, position: 'fixed', ...(isCurve && { corner: true }) }] : null;
  return { ...begun, region, fit: { cloud: own, kind: 'within', value: tolerance, outliers: 0, stay } };
}

export function freed(constraints: Constraints): Constraints {
  return { ...constraints, region: null, fit: undefined };
}

/** Whether it is the fairest shape already, as far as what holds lets it be. */
export function isFree({ region, fit }: Constraints): boolean {
  return !region && !fit;
}

/** Whether something would hold a shape that is free besides. */
export function isHeld({ nodes, unmarked }: Held): boolean {
  return unmarked > 0 || nodes.some((bits) => (bits & heldPosition) !== 0);
}
