// Which way is up: axes of the file as they stand in the view. Most files have Z or Y upwards and do not say which.

import type { Vector } from '../base/vectors';
import type { Shape } from './shape';

export const ups = ['z', 'y'] as const;
export type Up = (typeof ups)[number];

/** A direction of the file, as one where X goes to the right, Y to the back and Z upwards. */
export function standing([x, y, z]: Vector, up: Up): Vector {
  return up === 'z' ? [x, y, z] : [x, -z, y];
}

/** The other way round. */
export function lying([x, y, z]: Vector, up: Up): Vector {
  return up === 'z' ? [x, y, z] : [x, z, -y];
}

/** Of the height, as near to the lowest node somewhere is what the shape stands on. */
const low = 0.03;
/** So many times as large a ground as Z has is clear enough. */
const clear = 1.5;

/** What stands has more to stand on than what lies on its back. A plane curve needs no up. */
export function guessedUp({ curve, input }: Pick<Shape, 'curve' | 'input'>): Up {
  if (curve || input.length === 0) return 'z';
  return groundOf(input, 1) > clear * groundOf(input, 2) ? 'y' : 'z';
}

/** What the box around the lowest nodes covers of that around all, seen along an axis; none where the middle of all is not above it. */
function groundOf(places: Float64Array, axis: number): number {
  const others = [0, 1, 2].filter((i) => i !== axis);
  const [bottom, top] = rangeOf(places, axis, () => true);
  const ground = bottom + low * (top - bottom);
  const covered = others.map((i) => {
    const [least, most] = rangeOf(places, i, () => true);
    const [from, to] = rangeOf(places, i, (k) => places[k + axis] <= ground);
    const middle = meanOf(places, i);
    return middle >= from && middle <= to && most > least ? (to - from) / (most - least) : 0;
  });
  return covered[0] * covered[1];
}

function rangeOf(places: Float64Array, axis: number, among: (k: number) => boolean): [number, number] {
  let [least, most] = [Infinity, -Infinity];
  for (let k = 0; k < places.length; k += 3) {
    if (among(k)) [least, most] = [Math.min(least, places[k + axis]), Math.max(most, places[k + axis])];
  }
  return [least, most];
}

function meanOf(places: Float64Array, axis: number): number {
  let sum = 0;
  for (let k = axis; k < places.length; k += 3) sum += places[k];
  return (3 * sum) / places.length;
}
