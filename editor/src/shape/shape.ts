// The open surface or curve as the view needs it: moved to the origin and scaled to a size of one, so that single precision serves.

import { edgesOf, trianglesOf } from '../../../page/mesh.js';
import type { Vector } from '../base/vectors';
import type { Opened, OpenedCurve } from '../library/protocol';
import { planeOf } from './curve_plane';
import { setNormals, sidesOf, type Sides } from './vertices';

/** What only curves have. */
export interface CurveParts {
  /** Nodes of the chains, one chain after the other. */
  runs: { begin: Int32Array; nodes: Int32Array };
  closed: boolean[];
  /** Whether it stays at z = 0, as its file has no other place for it. */
  planar: boolean;
  /** The normal of the plane in which it lies, if in one. */
  plane: Vector | null;
}

export interface Shape {
  /** Null for a surface; of a curve there are no faces. */
  curve: CurveParts | null;
  faces: { begin: Int32Array; nodes: Int32Array };
  sides: Sides;
  boundary: Uint8Array;
  edges: { count: number; ends: Uint32Array; faces: Int32Array; against: Uint8Array };
  /** Nodes of triangles, for picking; and the corners of faces they stand for, for drawing. */
  triangles: Uint32Array;
  triangleCorners: Uint32Array;
  centre: [number, number, number];
  /** From units of the file to those of the view. */
  scale: number;
  input: Float64Array;
  /** Mean length of the edges, in units of the view. */
  spacing: number;
}

function edgesOfChains({ runs, closed }: CurveParts): Shape['edges'] {
  const ends: number[] = [];
  closed.forEach((loop, c) => {
    const nodes = runs.nodes.subarray(runs.begin[c], runs.begin[c + 1]);
    nodes.forEach((node, k) => {
      if (k + 1 < nodes.length || loop) ends.push(node, nodes[(k + 1) % nodes.length]);
    });
  });
  return { count: ends.length / 2, ends: Uint32Array.from(ends), faces: new Int32Array(ends.length).fill(-1), against: new Uint8Array(ends.length / 2) };
}

function curveOf({ positions, chainBegin, chainNodes, closed, planar }: OpenedCurve): CurveParts {
  return { runs: { begin: chainBegin, nodes: chainNodes }, closed: [...closed].map(Boolean), planar, plane: planar ? [0, 0, 1] : planeOf(positions) };
}

export function shapeOf(opened: Opened): Shape {
  const { positions, boundary } = opened;
  const curve = 'chainBegin' in opened ? curveOf(opened) : null;
  const [faceBegin, corners] = 'faceBegin' in opened ? [opened.faceBegin, opened.corners] : [Int32Array.of(0), new Int32Array()];
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < positions.length; ++k) {
    low[k % 3] = Math.min(low[k % 3], positions[k]);
    high[k % 3] = Math.max(high[k % 3], positions[k]);
  }
  const size = Math.hypot(...high.map((end, axis) => end / 2 - low[axis] / 2)) * 2;
  // Numbered by corners, so that a fan is laid through corners rather than nodes.
  const places = new Float64Array(3 * corners.length);
  corners.forEach((node, c) => places.set(positions.subarray(3 * node, 3 * node + 3), 3 * c));
  const triangleCorners: Uint32Array = trianglesOf({ begin: faceBegin, nodes: corners.map((_, c) => c) }, places);
  const faces = { begin: faceBegin, nodes: corners };
  const edges = curve ? edgesOfChains(curve) : edgesOf(faces, positions.length / 3);
  const scale = size > 0 && Number.isFinite(size) ? 1 / size : 1;
  return {
    curve,
    faces,
    sides: sidesOf(faces),
    boundary,
    edges,
    triangles: triangleCorners.map((corner) => corners[corner]),
    triangleCorners,
    centre: [0, 1, 2].map((axis) => low[axis] / 2 + high[axis] / 2) as [number, number, number],
    scale,
    input: positions,
    spacing: scale * meanLength(edges, positions),
  };
}

function meanLength({ count, ends }: Shape['edges'], positions: Float64Array): number {
  let sum = 0;
  for (let e = 0; e < count; ++e) {
    const [a, b] = [3 * ends[2 * e], 3 * ends[2 * e + 1]];
    sum += Math.hypot(positions[a] - positions[b], positions[a + 1] - positions[b + 1], positions[a + 2] - positions[b + 2]);
  }
  return count > 0 ? sum / count : 0;
}

/** What is open where nothing is: the view looks down on the plane z = 0, ten units high. */
export const nothing: Shape = {
  ...shapeOf({ positions: new Float64Array(), boundary: new Uint8Array(), warnings: [], chainBegin: Int32Array.of(0), chainNodes: new Int32Array(), closed: new Uint8Array(), planar: true }),
  centre: [0, 0, 0],
  scale: 0.1,
};

export function placesOf({ centre, scale }: Shape, positions: Float64Array): Float32Array {
  const places = new Float32Array(positions.length);
  for (let k = 0; k < positions.length; ++k) places[k] = (positions[k] - centre[k % 3]) * scale;
  return places;
}

/** Of the shape at a node, from its faces. */
export function normalNear(shape: Shape, positions: Float64Array, node: number): Vector {
  const { nodes } = shape.faces;
  const normals = new Float32Array(positions.length);
  const corners = Uint32Array.from(nodes.keys()).filter((corner) => nodes[corner] === node);
  const all = { nodes: new Uint32Array(), corners: Uint32Array.from(nodes), features: new Uint32Array() };
  setNormals(normals, nodes, shape.sides, all, placesOf(shape, positions), { vertices: Uint32Array.of(node), corners });
  return [...normals.subarray(3 * node, 3 * node + 3)] as Vector;
}
