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

/** What stands has more to stand on than what lies on its back; an open sheet lies as its sides face. A plane curve needs no up. */
export function guessedUp({ curve, input, triangles }: Pick<Shape, 'curve' | 'input' | 'triangles'>): Up {
  if (curve || input.length === 0) return 'z';
  const stands = groundOf(input, 1) > clear * groundOf(input, 2);
  return stands && facing(input, triangles, 1) >= facing(input, triangles, 2) - sideways ? 'y' : 'z';
}

/** Share of the area by which an open shape may face Z more than Y and yet have Y upwards. */
const sideways = 0.1;

/** The share of its area by which it faces along an axis more one way than the other; a closed shape faces both ways alike. */
function facing(places: Float64Array, triangles: Uint32Array, axis: number): number {
  const [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
  let [along, all] = [0, 0];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const part = (m: number, n: number): number => (places[b + m] - places[a + m]) * (places[c + n] - places[a + n]) - (places[b + n] - places[a + n]) * (places[c + m] - places[a + m]);
    along += part(i, j);
    all += Math.hypot(part(0, 1), part(1, 2), part(2, 0));
  }
  return all > 0 ? Math.abs(along) / all : 0;
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
