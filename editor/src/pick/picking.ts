// Finds the node under the pointer: the nearest visible one on the screen. Linear in the size of the surface.

import { hides, projected, type Seen } from '../view/seen';

/** The node within so many pixels of a point, or -1. preferred: nodes that count as nearer by half the radius. */
export function pick(seen: Seen, x: number, y: number, radius: number, preferred: (node: number) => boolean): number {
  const screen = projected(seen);
  const candidates: { node: number; distance: number }[] = [];
  for (let k = 0; k < screen.length; k += 3) {
    const [dx, dy] = [screen[k] - x, screen[k + 1] - y];
    if (Math.abs(dx) > radius || Math.abs(dy) > radius) continue;
    const distance = Math.hypot(dx, dy);
    if (distance <= radius) candidates.push({ node: k / 3, distance: preferred(k / 3) ? distance - radius / 2 : distance });
  }
  candidates.sort((a, b) => a.distance - b.distance);
  // Only the nearest few: if all of them are hidden, the rest is hidden, too, or too crowded to be meant.
  for (const { node } of candidates.slice(0, 12)) if (!hides(screen, seen.triangles, screen.subarray(3 * node, 3 * node + 3), node, 1e-4)) return node;
  return -1;
}
