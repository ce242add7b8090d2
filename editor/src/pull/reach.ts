// How far around the pulled nodes the shape moves.

import type { Shape } from '../shape/shape';

/** Of the size, where nothing else is said and a file is as it came or only a part of it moves. */
export const near = 0.15;

/** Nodes within so much of the size of some of those nodes, as they are seen. */
export function within({ scale }: Pick<Shape, 'scale'>, seen: Float64Array, nodes: readonly number[], reach: number): Set<number> {
  const radius = reach / scale;
  const found = new Set<number>();
  const centres = nodes.map((node) => seen.subarray(3 * node, 3 * node + 3));
  for (let k = 0; k < seen.length; k += 3) {
    for (const [x, y, z] of centres) {
      if ((seen[k] - x) ** 2 + (seen[k + 1] - y) ** 2 + (seen[k + 2] - z) ** 2 > radius * radius) continue;
      found.add(k / 3);
      break;
    }
  }
  return found;
}
