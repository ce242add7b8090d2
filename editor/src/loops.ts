// Boundary loops, by what joins the nodes of a boundary.

import type { Shape } from './shape';

/** All nodes of the boundary loops on which some of those nodes lie, and those nodes. */
export function withLoops({ edges, boundary }: Pick<Shape, 'edges' | 'boundary'>, nodes: Iterable<number>): Set<number> {
  const next = new Map<number, number[]>();
  for (let e = 0; e < edges.count; ++e) {
    if (edges.faces[2 * e + 1] >= 0) continue;
    const [a, b] = [edges.ends[2 * e], edges.ends[2 * e + 1]];
    for (const [from, to] of [[a, b], [b, a]]) next.set(from, [...(next.get(from) ?? []), to]);
  }
  const found = new Set(nodes);
  const waiting = [...found].filter((node) => boundary[node]);
  while (waiting.length > 0) {
    for (const node of next.get(waiting.pop()!) ?? []) {
      if (found.has(node)) continue;
      found.add(node);
      waiting.push(node);
    }
  }
  return found;
}
