// Boundary loops, from the edges between boundary nodes.

import type { Shape } from './shape';

type Bounded = Pick<Shape, 'edges' | 'boundary'>;

function neighboursOf({ edges }: Bounded): Map<number, number[]> {
  const next = new Map<number, number[]>();
  for (let e = 0; e < edges.count; ++e) {
    if (edges.faces[2 * e + 1] >= 0) continue;
    const [a, b] = [edges.ends[2 * e], edges.ends[2 * e + 1]];
    for (const [from, to] of [[a, b], [b, a]]) next.set(from, [...(next.get(from) ?? []), to]);
  }
  return next;
}

/** All nodes of the boundary loops on which some of those nodes lie, and those nodes. */
export function withLoops(shape: Bounded, nodes: Iterable<number>): Set<number> {
  const next = neighboursOf(shape);
  const found = new Set(nodes);
  const waiting = [...found].filter((node) => shape.boundary[node]);
  while (waiting.length > 0) {
    for (const node of next.get(waiting.pop()!) ?? []) {
      if (found.has(node)) continue;
      found.add(node);
      waiting.push(node);
    }
  }
  return found;
}

/** The boundary loops, each in its order; where several meet in a node, some are cut there. */
export function loopsOf(shape: Bounded): number[][] {
  const next = neighboursOf(shape);
  const found = new Set<number>();
  const loops: number[][] = [];
  for (const first of next.keys()) {
    const loop: number[] = [];
    for (let at: number | undefined = first; at !== undefined && !found.has(at); at = next.get(at)!.find((node) => !found.has(node))) {
      found.add(at);
      loop.push(at);
    }
    if (loop.length > 0) loops.push(loop);
  }
  return loops;
}

type Place = ArrayLike<number>;
/** Of the length of a loop, on both sides of a node: what its direction there is told from, so that noise is no corner. */
const reach = 0.04;
const cornerTurn = Math.PI / 4;

/** Nodes of a loop to hold it by: its corners, or, where it has fewer than three, so many at even distances. */
export function heldOn(loop: readonly number[], positions: Float64Array, many: number): number[] {
  const place = (k: number): Place => positions.subarray(3 * loop[k % loop.length], 3 * loop[k % loop.length] + 3);
  const arc = [0];
  for (let k = 0; k < loop.length; ++k) arc.push(arc[k] + distance(place(k), place(k + 1)));
  const length = arc[loop.length];
  const corners = cornersOf(loop, place, arc);
  if (corners.length >= 3) return corners.map((k) => loop[k]);
  const begin = corners[0] ?? 0;
  const chosen = new Set<number>();
  for (let k = 0; k < Math.min(many, loop.length); ++k) {
    const at = (arc[begin] + (k * length) / many) % length;
    chosen.add(loop[Math.max(0, arc.findLastIndex((end) => end <= at)) % loop.length]);
  }
  return [...chosen];
}

function distance(a: Place, b: Place): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/** Numbers in the loop where it turns sharply, more than anywhere near. */
function cornersOf(loop: readonly number[], place: (k: number) => Place, arc: readonly number[]): number[] {
  const count = loop.length;
  const near = reach * arc[count];
  const between = (from: number, to: number): number => Math.abs(arc[to] - arc[from]);
  const apart = (a: number, b: number): number => Math.min(between(a, b), arc[count] - between(a, b));
  const away = (from: number, step: number): number => {
    let at = from;
    do at = (at + step + count) % count;
    while (at !== from && apart(from, at) < near);
    return at;
  };
  const turns = loop.map((_, k) => {
    const [before, here, after] = [place(away(k, -1)), place(k), place(away(k, 1))];
    const [a, b] = [[0, 1, 2].map((i) => here[i] - before[i]), [0, 1, 2].map((i) => after[i] - here[i])];
    const cosine = a.reduce((sum, part, i) => sum + part * b[i], 0) / (Math.hypot(...a) * Math.hypot(...b) || 1);
    return Math.acos(Math.max(-1, Math.min(1, cosine)));
  });
  return [...turns.keys()].filter((k) => turns[k] > cornerTurn && turns.every((turn, other) => turn < turns[k] || other === k || apart(k, other) >= near || (turn === turns[k] && other > k)));
}
