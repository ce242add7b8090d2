// The section of the surface by a plane across an axis: runs of places, with the surface's normals where it is smooth.

import type { Vector } from '../base/vectors';
import type { Shape } from './shape';
import { setNormals, type Vertices } from './vertices';

export interface Run {
  points: Vector[];
  /** Of the surface, in the plane and of length one. */
  normals: Vector[];
  closed: boolean;
}

/** Where the plane crosses an edge of a triangle: by the ends of the edge, and with the normal on the side of that triangle. */
interface Crossing {
  edge: number;
  point: Vector;
  normal: Vector;
}

/** Normals on both sides of an edge at which the surface goes on smoothly are the same but for rounding. */
const smooth = 0.999;

/** axis: 0, 1 or 2; places: of the nodes, in the units of `at`. */
export function sectionOf(shape: Shape, places: Float32Array, vertices: Vertices, axis: number, at: number): Run[] {
  const { triangles, triangleCorners } = shape;
  const beyond = Uint8Array.from({ length: places.length / 3 }, (_, node) => Number(places[3 * node + axis] >= at));
  const cut: number[] = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const sum = beyond[triangles[t]] + beyond[triangles[t + 1]] + beyond[triangles[t + 2]];
    if (sum === 1 || sum === 2) cut.push(t);
  }
  const normals = normalsAt(shape, places, vertices, cut);
  const crossing = (a: number, b: number): Crossing => {
    const [from, to] = triangles[a] < triangles[b] ? [a, b] : [b, a];
    const [p, q] = [3 * triangles[from], 3 * triangles[to]];
    const share = (at - places[p + axis]) / (places[q + axis] - places[p + axis]);
    const [m, n] = [from, to].map((corner) => 3 * vertices.corners[triangleCorners[corner]]);
    const point = [0, 1, 2].map((i) => places[p + i] + share * (places[q + i] - places[p + i])) as Vector;
    const normal = [0, 1, 2].map((i) => (i === axis ? 0 : normals[m + i] + share * (normals[n + i] - normals[m + i]))) as Vector;
    return { edge: triangles[from] * beyond.length + triangles[to], point, normal: unit(normal) };
  };
  const segments = cut.map((t) => {
    const ends = [0, 1, 2].filter((k) => beyond[triangles[t + k]] !== beyond[triangles[t + ((k + 1) % 3)]]);
    return ends.map((k) => crossing(t + k, t + ((k + 1) % 3)));
  });
  return joined(segments).flatMap(runsOf);
}

function unit(vector: Vector): Vector {
  const length = Math.hypot(...vector) || 1;
  return vector.map((part) => part / length) as Vector;
}

/** Of the vertices of those triangles. */
function normalsAt({ faces, sides, triangleCorners }: Shape, places: Float32Array, vertices: Vertices, cut: readonly number[]): Float32Array {
  const normals = new Float32Array(3 * vertices.nodes.length);
  const used = new Uint8Array(vertices.nodes.length);
  for (const t of cut) for (let k = 0; k < 3; ++k) used[vertices.corners[triangleCorners[t + k]]] = 1;
  const part = { vertices: Uint32Array.from(used.keys()).filter((vertex) => used[vertex]), corners: Uint32Array.from(vertices.corners.keys()).filter((corner) => used[vertices.corners[corner]]) };
  setNormals(normals, faces.nodes, sides, vertices, places, part);
  return normals;
}

/** Segments one after the other, each turned so that it begins where the one before it ends. */
function joined(segments: Crossing[][]): { chain: Crossing[][]; closed: boolean }[] {
  const at = new Map<number, number[]>();
  segments.forEach((ends, s) => ends.forEach(({ edge }) => at.set(edge, [...(at.get(edge) ?? []), s])));
  const done = new Uint8Array(segments.length);
  const next = (edge: number): number | undefined => (at.get(edge)!.length === 2 ? at.get(edge)!.find((s) => !done[s]) : undefined);
  const follow = (s: number | undefined, from: number): Crossing[][] => {
    const chain: Crossing[][] = [];
    for (let edge = from; s !== undefined; s = next(edge)) {
      done[s] = 1;
      const [a, b] = segments[s];
      chain.push(a.edge === edge ? [a, b] : [b, a]);
      edge = chain.at(-1)![1].edge;
    }
    return chain;
  };
  return segments.flatMap((ends, s) => {
    if (done[s]) return [];
    const on = follow(s, ends[0].edge);
    const first = on[0][0].edge;
    const closed = on.at(-1)![1].edge === first && on.length > 2;
    const back = closed ? [] : follow(next(first), first);
    return [{ chain: [...back.reverse().map(([a, b]) => [b, a]), ...on], closed }];
  });
}

/** Cut where the surface has an edge. */
function runsOf({ chain, closed }: { chain: Crossing[][]; closed: boolean }): Run[] {
  const sharp = chain.map(([begin], k) => {
    const before = k > 0 ? chain[k - 1] : closed ? chain.at(-1) : undefined;
    return !before || before[1].normal.reduce((sum, part, i) => sum + part * begin.normal[i], 0) < smooth;
  });
  const first = sharp.indexOf(true);
  if (first < 0) return [{ points: chain.map(([{ point }]) => point), normals: chain.map(([{ normal }]) => normal), closed: true }];
  const runs: Run[] = [];
  for (let k = 0; k < chain.length; ++k) {
    const [begin, end] = chain[(first + k) % chain.length];
    if (sharp[(first + k) % chain.length]) runs.push({ points: [begin.point], normals: [begin.normal], closed: false });
    runs.at(-1)!.points.push(end.point);
    runs.at(-1)!.normals.push(end.normal);
  }
  return runs;
}
