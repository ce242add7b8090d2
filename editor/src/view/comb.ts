// The curvature comb: from every node a hair away from the centre of curvature, as long as the curvature is large, and the line through their tips.

import { quantiles } from '../../../page/numbers.js';
import type { Vector } from '../base/vectors';

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
const longestTeeth = 0.4;   // where those of a shape that has changed since are cut off

/** The length of a hair by curvature at which the sharpest place has one of 0.15 of the size, or the one that this share of all places is less sharp than. */
export function toothOf(chains: readonly Chain[], size: number, share = 1): number {
  const bends = chains.flatMap(({ vectors }) => vectors.flatMap((vector) => (vector ? [Math.hypot(...vector)] : [])));
  const [sharp] = quantiles(bends, [share]);
  return (longestTooth * size) / Math.max(sharp, straight / size);
}

/** Ends of hairs and of the envelope, six numbers a line. place: from units of the curve to those of the lines. root: hairs are as long as the root of the curvature, so that flat places show beside sharp ones. */
export function combOf(chains: readonly Chain[], tooth: number, size: number, place: (point: Vector) => Vector, root = false): { hairs: Float32Array; envelope: Float32Array } {
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
