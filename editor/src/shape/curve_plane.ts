// The plane of a curve, where it has one.

import { cross, dot, minus } from '../../../page/vectors.js';
import type { Vector } from '../base/vectors';

/** Its unit normal, the largest component positive; null where the places are in no plane, to a share of 1e-6 of the way between the furthest, or on a line. */
export function planeOf(positions: Float64Array): Vector | null {
  const places = Array.from({ length: positions.length / 3 }, (_, node) => [...positions.subarray(3 * node, 3 * node + 3)]);
  if (places.length < 3) return null;
  const furthest = (measure: (place: number[]) => number): number[] => places.reduce((most, place) => (measure(place) > measure(most) ? place : most));
  const along = minus(furthest((place) => Math.hypot(...minus(place, places[0]))), places[0]);
  const size = Math.hypot(...along);
  const aside = furthest((place) => Math.hypot(...cross(along, minus(place, places[0]))));
  const across = cross(along, minus(aside, places[0]));
  const area = Math.hypot(...across);
  if (!(area > 1e-6 * size * size)) return null;
  const sign = across.reduce((most: number, part: number) => (Math.abs(part) > Math.abs(most) ? part : most), 0) < 0 ? -1 : 1;
  const normal = across.map((part: number) => (sign * part) / area || 0) as Vector;
  return places.every((place) => Math.abs(dot(minus(place, places[0]), normal)) <= 1e-6 * size) ? normal : null;
}
