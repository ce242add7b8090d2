// The curvature comb: a hair from every node, away from the centre of curvature and in proportion to the curvature, and
// the line through their tips.

import { quantiles } from '../../../page/numbers.js';
import { dot, type Vector } from '../base/vectors';
import type { Run } from '../shape/section';

/** As chainsOf() of page/curve.js makes them. */
export interface Chain {
  points: Vector[];
  /** Curvature vectors; null at open ends. */
  vectors: (Vector | null)[];
  arc: number[];
  curvatures: (number | null)[];
  closed: boolean;
}

const longestTooth = 0.15;  // of the size, for the sharpest place
const straight = 0.02;      // a curve that bends by less, as a share of one over its size, has shorter hairs
const longestTeeth = 0.4;   // hairs of a shape that has changed since are cut off there

/** What a comb is made of. */
type Combed = Pick<Chain, 'points' | 'vectors' | 'closed'>;

/** The length of a hair by curvature at which the sharpest place has one of 0.15 of the size, or the one that this share of all places is less sharp than. */
export function toothOf(chains: readonly Combed[], size: number, share = 1): number {
  const bends = chains.flatMap(({ vectors }) => vectors.flatMap((vector) => (vector ? [Math.hypot(...vector)] : [])));
  const [sharp] = quantiles(bends, [share]);
  return (longestTooth * size) / Math.max(sharp, straight / size);
}

/** Ends of hairs and of the envelope, six numbers a line. place: from units of the curve to those of the lines. root: hairs are as long as the root of the curvature, so that flat places show beside sharp ones. */
export function combOf(chains: readonly Combed[], tooth: number, size: number, place: (point: Vector) => Vector, root = false): { hairs: Float32Array; envelope: Float32Array } {
  const hairs: number[] = [];
  const envelope: number[] = [];
  for (const { points, vectors, closed } of chains) {
    const roots = points.map(place);
    const tips = points.map((point, k) => {
      const vector = vectors[k];
      if (!vector) return roots[k];
      const full = tooth * Math.hypot(...vector);
      const length = Math.min(longestTeeth * size, root ? Math.sqrt(full * longestTooth * size) : full);
      const stretch = full > 0 ? (tooth * length) / full : 0;
      return place(point.map((part, i) => part - stretch * vector[i]) as Vector);
    });
    tips.forEach((tip, k) => {
      hairs.push(...roots[k], ...tip);
      if (k + 1 < tips.length || closed) envelope.push(...tip, ...tips[(k + 1) % tips.length]);
    });
  }
  return { hairs: Float32Array.from(hairs), envelope: Float32Array.from(envelope) };
}

/** As many hairs at most are on one run of a section. */
const most = 300;

/**
 * A run of a section, at even steps of its length, as curvature follows from how the normals turn on the way. A section through flat faces says
 * nothing of that by its places. step: about the length of the edges, as shorter ones show the mesh.
 */
export function combedSection({ points, normals, closed }: Run, step: number): Combed {
  const ring = closed ? [...points, points[0]] : points;
  const arc = [0];
  for (let k = 1; k < ring.length; ++k) arc.push(arc[k - 1] + Math.hypot(...ring[k].map((part, i) => part - ring[k - 1][i])));
  const length = arc.at(-1)!;
  const count = Math.min(most, Math.max(4, Math.round(length / step)));
  const places: Vector[] = [];
  const facing: Vector[] = [];
  for (let k = 0, from = 0; k < count + (closed ? 0 : 1); ++k) {
    const at = (k * length) / count;
    while (from + 2 < arc.length && arc[from + 1] < at) ++from;
    const share = arc[from + 1] > arc[from] ? Math.min(1, (at - arc[from]) / (arc[from + 1] - arc[from])) : 0;
    const between = (values: readonly Vector[]): Vector => values[from].map((part, i) => part + share * (values[(from + 1) % values.length][i] - part)) as Vector;
    places.push(between(points));
    facing.push(between(normals));
  }
  const around = (k: number): number => (k + places.length) % places.length;
  const vectors = places.map((_, k) => {
    // At rims and sharp edges normals come from faces on one side only and are inaccurate.
    if (!closed && (k < 2 || k >= places.length - 2)) return null;
    const [before, after] = [around(k - 1), around(k + 1)];
    const way = places[after].map((part, i) => part - places[before][i]);
    const turn = facing[after].reduce((sum, part, i) => sum + (part - facing[before][i]) * way[i], 0) / (dot(way, way) || 1);
    return facing[k].map((part) => -turn * part) as Vector;
  });
  return { points: places, vectors, closed };
}
