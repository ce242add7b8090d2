// Vertices for drawing a surface: its nodes, at sharp edges one for every smooth part that meets there.

import { sharpEdges } from './sharp';

interface Faces {
  begin: Int32Array;
  nodes: Int32Array;
}

/** Of every corner of a face the nodes before and after it. */
export interface Sides {
  before: Uint32Array;
  after: Uint32Array;
}

interface Edges {
  count: number;
  ends: Uint32Array;
  faces: Int32Array;
  against: Uint8Array;
}

export interface Vertices {
  /** The node of every vertex; the first are the nodes in their order. */
  nodes: Uint32Array;
  /** The vertex of every corner of a face. */
  corners: Uint32Array;
  /** Ends of edges where the surface is sharp or ends. */
  features: Uint32Array;
}

/** Corners around a node share a vertex where smooth edges join their faces. */
export function verticesOf(faces: Faces, positions: Float32Array, edges: Edges, angle = 40): Vertices {
  const { begin, nodes } = faces;
  const sharp = sharpEdges(faces, positions, edges, angle);
  const parent = Uint32Array.from(nodes.keys());
  const root = (corner: number): number => {
    while (parent[corner] !== corner) corner = parent[corner] = parent[parent[corner]];
    return corner;
  };
  const cornerAt = (face: number, node: number): number => {
    let corner = begin[face];
    while (nodes[corner] !== node) ++corner;
    return corner;
  };
  for (let e = 0; e < edges.count; ++e) {
    if (sharp[e]) continue;
    for (const node of [edges.ends[2 * e], edges.ends[2 * e + 1]])
      parent[root(cornerAt(edges.faces[2 * e], node))] = root(cornerAt(edges.faces[2 * e + 1], node));
  }
  const vertexNodes = Array.from({ length: positions.length / 3 }, (_, node) => node);
  const taken = new Uint8Array(vertexNodes.length);
  const vertexOf = new Int32Array(nodes.length).fill(-1);
  const corners = new Uint32Array(nodes.length);
  for (let c = 0; c < nodes.length; ++c) {
    const r = root(c);
    if (vertexOf[r] < 0) {
      vertexOf[r] = taken[nodes[c]] ? vertexNodes.push(nodes[c]) - 1 : nodes[c];
      taken[nodes[c]] = 1;
    }
    corners[c] = vertexOf[r];
  }
  const features: number[] = [];
  for (let e = 0; e < edges.count; ++e) if (sharp[e]) features.push(edges.ends[2 * e], edges.ends[2 * e + 1]);
  return { nodes: Uint32Array.from(vertexNodes), corners, features: Uint32Array.from(features) };
}

export function sidesOf({ begin, nodes }: Faces): Sides {
  const [before, after] = [new Uint32Array(nodes.length), new Uint32Array(nodes.length)];
  for (let f = 0; f + 1 < begin.length; ++f) {
    for (let c = begin[f]; c < begin[f + 1]; ++c) {
      after[c] = nodes[c + 1 < begin[f + 1] ? c + 1 : begin[f]];
      before[c] = nodes[c > begin[f] ? c - 1 : begin[f + 1] - 1];
    }
  }
  return { before, after };
}

/** Some vertices, and the corners of faces that they stand for. */
export interface Part {
  vertices: Uint32Array;
  corners: Uint32Array;
}

/** The vertices of triangles. */
export function partOf(triangles: Uint32Array, { nodes, corners }: Vertices): Part {
  const used = new Uint8Array(nodes.length);
  for (const vertex of triangles) used[vertex] = 1;
  return { vertices: Uint32Array.from(nodes.keys()).filter((vertex) => used[vertex]), corners: Uint32Array.from(corners.keys()).filter((corner) => used[corners[corner]]) };
}

/** Normals of vertices, or of the part, with Max's weights (1999), exact on spheres; written into normals. */
export function setNormals(normals: Float32Array, nodes: Int32Array, { before, after }: Sides, { corners }: Vertices, positions: Float32Array, part?: Part): void {
  const count = part ? part.corners.length : nodes.length;
  const vertexCount = part ? part.vertices.length : normals.length / 3;
  for (let k = 0; k < vertexCount; ++k) {
    const vertex = 3 * (part ? part.vertices[k] : k);
    normals[vertex] = normals[vertex + 1] = normals[vertex + 2] = 0;
  }
  for (let k = 0; k < count; ++k) {
    const c = part ? part.corners[k] : k;
    const [centre, a, b] = [3 * nodes[c], 3 * after[c], 3 * before[c]];
    const [ax, ay, az] = [positions[a] - positions[centre], positions[a + 1] - positions[centre + 1], positions[a + 2] - positions[centre + 2]];
    const [bx, by, bz] = [positions[b] - positions[centre], positions[b + 1] - positions[centre + 1], positions[b + 2] - positions[centre + 2]];
    const weight = 1 / ((ax * ax + ay * ay + az * az) * (bx * bx + by * by + bz * bz));
    if (!Number.isFinite(weight)) continue;  // an edge without length
    const vertex = 3 * corners[c];
    normals[vertex] += weight * (ay * bz - az * by);
    normals[vertex + 1] += weight * (az * bx - ax * bz);
    normals[vertex + 2] += weight * (ax * by - ay * bx);
  }
  for (let k = 0; k < vertexCount; ++k) {
    const vertex = 3 * (part ? part.vertices[k] : k);
    const length = Math.hypot(normals[vertex], normals[vertex + 1], normals[vertex + 2]) || 1;
    for (let i = vertex; i < vertex + 3; ++i) normals[i] /= length;
  }
}
