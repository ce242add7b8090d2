// Keeps nodes in their place along a shape that moved: each goes back along the new shape until it has moved across the
// shape only.

import { normalsOf } from '../../../page/mesh.js';
import { dot, type Vector } from '../base/vectors';
import type { CurveParts, Shape } from './shape';

/** What a node keeps: nothing; its place along the shape, so that it moves straight across; or one coordinate. */
export const stays = ['', 'normal', 'x', 'y', 'z'] as const;
export type Stay = (typeof stays)[number];

/** Cosine of the angle to an axis, from which on nodes would have to go far along the shape to keep that coordinate: they keep their place along it instead. */
const least = 0.3;

type Reads = ArrayLike<number>;

const at = (all: Reads, node: number): Vector => [all[3 * node], all[3 * node + 1], all[3 * node + 2]];
const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const plus = (from: Vector, way: Vector, far: number): Vector => [from[0] + far * way[0], from[1] + far * way[1], from[2] + far * way[2]];

/** Tangents of curves, normals of surfaces, three numbers a node. */
export function directionsOf({ curve, faces, edges }: Shape, positions: Float64Array): Reads {
  if (!curve) return normalsOf(faces, positions, edges) as Float32Array;
  const tangents = new Float64Array(positions.length);
  const { runs: { begin, nodes }, closed } = curve;
  closed.forEach((loop, c) => {
    const count = begin[c + 1] - begin[c];
    for (let k = 0; k < count; ++k) {
      const node = (n: number): number => nodes[begin[c] + ((n + count) % count)];
      const [before, after] = [loop || k > 0 ? k - 1 : k, loop || k + 1 < count ? k + 1 : k];
      const [u, v] = [minus(at(positions, node(k)), at(positions, node(before))), minus(at(positions, node(after)), at(positions, node(k)))];
      const [long, next] = [Math.hypot(...u) || 1, Math.hypot(...v) || 1];
      // The tangent of the circle through the three.
      const sum = u.map((part, i) => (part / long) * next + (v[i] / next) * long);
      const length = Math.hypot(...sum) || 1;
      tangents.set(sum.map((part) => part / length), 3 * node(k));
    }
  });
  return tangents;
}

/** start: where nodes were, positions: where they are. limit: across the new shape no node goes further. steep: how many nodes keep their place along the shape in place of the coordinate. */
export function stayed(shape: Shape, start: Float64Array, positions: Float64Array, stay: Exclude<Stay, ''>, limit: number): { positions: Float64Array; steep: number } {
  const directions = directionsOf(shape, positions);
  const axis = 'xyz'.indexOf(stay);
  const unit: Vector = [0, 1, 2].map((i) => Number(i === axis)) as Vector;
  const found = positions.slice();
  let steep = 0;
  for (let node = 0; node < positions.length / 3; ++node) {
    const from = at(start, node);
    const way = minus(at(positions, node), from);
    if (way.every((part) => part === 0)) continue;
    const direction = at(directions, node);
    if (axis >= 0) {
      // The way along the shape that changes the coordinate most.
      const slope = partsOf(shape, unit, direction).along;
      if (slope[axis] >= least ** 2) {
        const place = plus(at(positions, node), slope, -way[axis] / slope[axis]);
        place[axis] = from[axis];
        found.set(place, 3 * node);
        continue;
      }
      ++steep;
    }
    const { across } = partsOf(shape, way, direction);
    found.set(plus(from, across, Math.min(1, limit / Math.hypot(...across))), 3 * node);
  }
  return { positions: found, steep };
}

/** A way as its parts along the shape and across it, where the shape has that tangent, of a curve, or else that normal. */
function partsOf({ curve }: Shape, way: Vector, direction: Vector): { along: Vector; across: Vector } {
  const part = plus([0, 0, 0], direction, dot(way, direction));
  const rest = minus(way, part);
  return curve ? { along: part, across: rest } : { along: rest, across: part };
}

/** How far a node has gone along the new shape, at most. */
export function slid(shape: Shape, start: Float64Array, positions: Float64Array): number {
  const directions = directionsOf(shape, positions);
  let greatest = 0;
  for (let node = 0; node < positions.length / 3; ++node) {
    const way = minus(at(positions, node), at(start, node));
    greatest = Math.max(greatest, Math.hypot(...partsOf(shape, way, at(directions, node)).along));
  }
  return greatest;
}

/** How far nodes of a curve are from the polyline they were on, at most. The nearest place of it is looked for along the way that a node may have come on it, beginning where the last one's was, and no longer than until it is nearer than another node's. */
export function strayed({ runs: { begin, nodes }, closed }: CurveParts, start: Float64Array, positions: Float64Array): number {
  const away = (node: number): number => Math.hypot(...minus(at(positions, node), at(start, node)));
  let greatest = 0;
  closed.forEach((loop, c) => {
    const run = nodes.subarray(begin[c], begin[c + 1]);
    const count = run.length;
    const edges = loop ? count : count - 1;
    // How many edges ahead the last node's nearest place is.
    let ahead = 0;
    const follow = (k: number): void => {
      const place = at(positions, run[k]);
      let nearest = away(run[k]);
      const reach = 2 * nearest;
      const look = (further: number): number => {
        const e = (k + further + 2 * count) % count;
        if (e >= edges) return 0;
        const from = at(start, run[e]);
        const edge = minus(at(start, run[(e + 1) % count]), from);
        const length = Math.hypot(...edge);
        const share = Math.min(1, Math.max(0, dot(minus(place, from), edge) / (length ** 2 || 1)));
        const distance = Math.hypot(...minus(place, plus(from, edge, share)));
        if (distance < nearest) [nearest, ahead] = [distance, further];
        return length;
      };
      for (const further of [ahead, ahead + 1, ahead - 1]) if (nearest > greatest) look(further);
      for (let n = 0, gone = 0; n < (loop ? count : count - k) && gone <= reach && nearest > greatest; ++n) gone += look(n);
      for (let n = 1, gone = 0; n <= (loop ? count : k) && gone <= reach && nearest > greatest; ++n) gone += look(-n);
      greatest = Math.max(greatest, nearest);
    };
    // The node that moved furthest first: most others moved less in all.
    let furthest = 0;
    for (let k = 1; k < count; ++k) if (away(run[k]) > away(run[furthest])) furthest = k;
    follow(furthest);
    for (let k = 0; k < count; ++k) follow(k);
  });
  return greatest;
}
