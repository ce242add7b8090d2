// Sharp places of a shape: edges at which faces turn, nodes at which a curve does.

import { partsOf } from './joined';

interface Faces {
  begin: Int32Array;
  nodes: Int32Array;
}

interface Edges {
  count: number;
  ends: Uint32Array;
  faces: Int32Array;
  against: Uint8Array;
}

/** Normals of faces, their length twice the area. */
function areasOf({ begin, nodes }: Faces, positions: ArrayLike<number>): Float64Array {
  const areas = new Float64Array(3 * (begin.length - 1));
  for (let f = 0; f + 1 < begin.length; ++f) {
    const o = 3 * nodes[begin[f]];
    for (let c = begin[f] + 1; c + 1 < begin[f + 1]; ++c) {
      const [a, b] = [3 * nodes[c], 3 * nodes[c + 1]];
      const [ax, ay, az] = [positions[a] - positions[o], positions[a + 1] - positions[o + 1], positions[a + 2] - positions[o + 2]];
      const [bx, by, bz] = [positions[b] - positions[o], positions[b + 1] - positions[o + 1], positions[b + 2] - positions[o + 2]];
      areas[3 * f] += ay * bz - az * by;
      areas[3 * f + 1] += az * bx - ax * bz;
      areas[3 * f + 2] += ax * by - ay * bx;
    }
  }
  return areas;
}

const degrees = 180 / Math.PI;
/** Of so many edges some tell what noise makes of all the others. */
const enough = 300;
/** Times the middle one of all turns: of noise one in some thousand turns by more. */
const noisy = 5;
/** Edges that turn by more are sharp beside any noise. */
const sure = 120;
/** Of the size of the shape: shorter lines of sharp edges are folds and scratches, not edges of the shape. */
const line = 0.15;

const everywhere = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
const diagonalOf = (box: readonly number[]): number => Math.hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]);

/** By how much its faces turn at each edge, in degrees; NaN where it does not join two faces of one sense. */
function turnsOf(faces: Faces, positions: ArrayLike<number>, edges: Edges): Float64Array {
  const areas = areasOf(faces, positions);
  return Float64Array.from({ length: edges.count }, (_, e) => {
    const [a, b] = [3 * edges.faces[2 * e], 3 * edges.faces[2 * e + 1]];
    if (b < 0 || edges.against[e]) return NaN;
    const dot = areas[a] * areas[b] + areas[a + 1] * areas[b + 1] + areas[a + 2] * areas[b + 2];
    const lengths = Math.hypot(areas[a], areas[a + 1], areas[a + 2]) * Math.hypot(areas[b], areas[b + 1], areas[b + 2]);
    return lengths > 0 ? Math.acos(Math.min(1, Math.max(-1, dot / lengths))) * degrees : 0;
  });
}

/** The angle, or more where noise turns most edges of a shape. */
function aboveNoise(turns: Float64Array, angle: number): number {
  const known = turns.filter((turn) => !Number.isNaN(turn)).sort();
  return known.length < enough ? angle : Math.max(angle, Math.min(sure, noisy * known[known.length >> 1]));
}

/** A box that holds the node as well. */
function grow(box: number[], positions: ArrayLike<number>, node: number): void {
  for (let i = 0; i < 3; ++i) {
    box[i] = Math.min(box[i], positions[3 * node + i]);
    box[i + 3] = Math.max(box[i + 3], positions[3 * node + i]);
  }
}

/** 1 for edges that turn by more than the angle, in degrees, and than noise does, and are part of a line long enough to be one. */
function creases(faces: Faces, positions: ArrayLike<number>, edges: Edges, angle: number): { sharp: Uint8Array; turns: Float64Array } {
  const turns = turnsOf(faces, positions, edges);
  const limit = aboveNoise(turns, angle);
  const sharp = Uint8Array.from(turns, (turn) => (turn > limit ? 1 : 0));
  if (turns.length < enough) return { sharp, turns };
  const root = partsOf(edges, positions.length / 3, (e) => sharp[e] === 1);
  const boxes = new Map<number, number[]>();
  const all = everywhere.slice();
  for (let end = 0; end < 2 * edges.count; ++end) {
    const node = edges.ends[end];
    grow(all, positions, node);
    if (!sharp[end >> 1]) continue;
    const box = boxes.get(root(node)) ?? everywhere.slice();
    grow(box, positions, node);
    boxes.set(root(node), box);
  }
  const least = line * diagonalOf(all);
  for (let e = 0; e < edges.count; ++e) if (sharp[e] && diagonalOf(boxes.get(root(edges.ends[2 * e]))!) < least) sharp[e] = 0;
  return { sharp, turns };
}

/** The same, or where the surface ends. */
export function sharpEdges(faces: Faces, positions: ArrayLike<number>, edges: Edges, angle: number): Uint8Array {
  const { sharp, turns } = creases(faces, positions, edges, angle);
  return sharp.map((is, e) => (is || Number.isNaN(turns[e]) ? 1 : 0));
}

/** Nodes of edges that turn by more than the angle; of curves those at which it turns. */
export function sharpNodes({ curve, faces, edges }: { curve: { runs: Faces; closed: boolean[] } | null; faces: Faces; edges: Edges }, positions: ArrayLike<number>, angle: number): number[] {
  if (curve) return sharpOnCurve(curve.runs, curve.closed, positions, angle);
  const { sharp } = creases(faces, positions, edges, angle);
  const found = new Set<number>();
  sharp.forEach((is, e) => { if (is) found.add(edges.ends[2 * e]).add(edges.ends[2 * e + 1]); });
  return [...found].sort((a, b) => a - b);
}

function sharpOnCurve({ begin, nodes }: Faces, closed: boolean[], positions: ArrayLike<number>, angle: number): number[] {
  const turns = new Float64Array(nodes.length).fill(NaN);
  closed.forEach((loop, c) => {
    const count = begin[c + 1] - begin[c];
    const place = (k: number): number[] => [0, 1, 2].map((i) => positions[3 * nodes[begin[c] + ((k + count) % count)] + i]);
    for (let k = loop ? 0 : 1; k < (loop ? count : count - 1); ++k) {
      const [a, b, d] = [place(k - 1), place(k), place(k + 1)];
      const [u, v] = [a.map((part, i) => b[i] - part), b.map((part, i) => d[i] - part)];
      const lengths = Math.hypot(...u) * Math.hypot(...v);
      turns[begin[c] + k] = lengths > 0 ? Math.acos(Math.min(1, Math.max(-1, u.reduce((sum, part, i) => sum + part * v[i], 0) / lengths))) * degrees : 0;
    }
  });
  const limit = aboveNoise(turns, angle);
  // A nose with few nodes turns much at each of them.
  const beside = (k: number): number => Math.max(0, ...[turns[k - 1], turns[k + 1]].filter((turn) => turn >= 0));
  return [...nodes].filter((_, k) => turns[k] - beside(k) > limit);
}
