// Parts of a mesh for the view: edges, triangles, normals, turns.

import {cross, dot, minus} from './vectors.js';

const at = (positions, node) => [positions[3 * node], positions[3 * node + 1], positions[3 * node + 2]];

// Edges with the first two faces at each. against: 1 if both faces run along the edge in the same direction; 0 if more
// than two meet, as it is unknown which belong together.
export function edgesOf({begin, nodes}, nodeCount) {
  const first = new Int32Array(nodeCount).fill(-1);  // linked lists of the edges at their lower node
  const next = new Int32Array(nodes.length);
  const ends = new Uint32Array(2 * nodes.length);
  const faces = new Int32Array(2 * nodes.length).fill(-1);
  const against = new Uint8Array(nodes.length);
  const upward = new Uint8Array(nodes.length);
  const crowded = new Uint8Array(nodes.length);  // 1 at edges of more than two faces
  let count = 0;
  for (let f = 0; f + 1 < begin.length; ++f) {
    for (let c = begin[f]; c < begin[f + 1]; ++c) {
      const a = nodes[c];
      const b = nodes[c + 1 < begin[f + 1] ? c + 1 : begin[f]];
      const low = Math.min(a, b);
      const high = Math.max(a, b);
      let edge = first[low];
      while (edge >= 0 && ends[2 * edge + 1] !== high) edge = next[edge];
      if (edge < 0) {
        edge = count++;
        ends[2 * edge] = low;
        ends[2 * edge + 1] = high;
        next[edge] = first[low];
        first[low] = edge;
        faces[2 * edge] = f;
        upward[edge] = a < b ? 1 : 0;
      } else if (faces[2 * edge + 1] < 0) {
        faces[2 * edge + 1] = f;
        against[edge] = upward[edge] === (a < b ? 1 : 0) ? 1 : 0;
      } else {
        crowded[edge] = 1;
        against[edge] = 0;
      }
    }
  }
  return {count, ends: ends.slice(0, 2 * count), faces: faces.slice(0, 2 * count), against: against.slice(0, count),
    crowded: crowded.slice(0, count)};
}

// Twice the vector area of a face.
function areaOf({begin, nodes}, positions, f) {
  const origin = at(positions, nodes[begin[f]]);
  const sum = [0, 0, 0];
  for (let c = begin[f] + 1; c + 1 < begin[f + 1]; ++c) {
    const part = cross(minus(at(positions, nodes[c]), origin), minus(at(positions, nodes[c + 1]), origin));
    for (let i = 0; i < 3; ++i) sum[i] += part[i];
  }
  return sum;
}

// Each face as a fan from the first node from which no triangle is flipped.
export function trianglesOf(runs, positions) {
  const {begin, nodes} = runs;
  const triangles = [];
  for (let f = 0; f + 1 < begin.length; ++f) {
    const size = begin[f + 1] - begin[f];
    const node = (k) => nodes[begin[f] + k % size];
    let start = 0;
    if (size > 3) {
      const area = areaOf(runs, positions, f);
      const open = (s) => {
        const origin = at(positions, node(s));
        for (let k = 1; k + 1 < size; ++k) {
          const a = minus(at(positions, node(s + k)), origin);
          const b = minus(at(positions, node(s + k + 1)), origin);
          if (dot(cross(a, b), area) < 0) return false;
        }
        return true;
      };
      while (start < size && !open(start)) ++start;
      start %= size;
    }
    for (let k = 1; k + 1 < size; ++k) triangles.push(node(start), node(start + k), node(start + k + 1));
  }
  return Uint32Array.from(triangles);
}

// 1 for faces to reverse so that neighbours agree, as far as the surface has two sides.
function sensesOf(faceCount, {count, faces, against, crowded}) {
  const links = Array.from({length: faceCount}, () => []);
  for (let e = 0; e < count; ++e) {
    if (faces[2 * e + 1] < 0 || crowded[e]) continue;
    links[faces[2 * e]].push(faces[2 * e + 1], against[e]);
    links[faces[2 * e + 1]].push(faces[2 * e], against[e]);
  }
  const sense = new Int8Array(faceCount).fill(-1);
  for (let root = 0; root < faceCount; ++root) {
    if (sense[root] >= 0) continue;
    sense[root] = 0;
    for (const waiting = [root]; waiting.length;) {
      const f = waiting.pop();
      for (let k = 0; k < links[f].length; k += 2) {
        if (sense[links[f][k]] >= 0) continue;
        sense[links[f][k]] = sense[f] ^ links[f][k + 1];
        waiting.push(links[f][k]);
      }
    }
  }
  return sense;
}

// Normals of nodes with Max's weights (1999), exact on spheres.
export function normalsOf({begin, nodes}, positions, edges) {
  const senses = edges.against.includes(1) ? sensesOf(begin.length - 1, edges) : null;
  const normals = new Float32Array(positions.length);
  for (let f = 0; f + 1 < begin.length; ++f) {
    const size = begin[f + 1] - begin[f];
    for (let k = 0; k < size; ++k) {
      const node = nodes[begin[f] + k];
      const centre = at(positions, node);
      const a = minus(at(positions, nodes[begin[f] + (k + 1) % size]), centre);
      const b = minus(at(positions, nodes[begin[f] + (k + size - 1) % size]), centre);
      const weight = (senses && senses[f] ? -1 : 1) / (dot(a, a) * dot(b, b));
      if (!Number.isFinite(weight)) continue;
      cross(a, b).forEach((part, i) => { normals[3 * node + i] += weight * part; });
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let k = i; k < i + 3; ++k) normals[k] /= length;
  }
  return normals;
}

// Angles between the normals of the two faces at an edge, degrees.
export function turnsOf(runs, positions, {count, faces, against}) {
  const areas = Array.from({length: runs.begin.length - 1}, (_, f) => areaOf(runs, positions, f));
  const turns = [];
  for (let e = 0; e < count; ++e) {
    if (faces[2 * e + 1] < 0) continue;
    const a = areas[faces[2 * e]];
    const b = areas[faces[2 * e + 1]];
    if (dot(a, a) === 0 || dot(b, b) === 0) continue;
    const cosine = against[e] ? -dot(a, b) : dot(a, b);
    turns.push(Math.atan2(Math.hypot(...cross(a, b)), cosine) * 180 / Math.PI);
  }
  return turns;
}

// Distances of nodes from those of another shape, along its normals.
export function deviationsOf(positions, from, normals) {
  return Float32Array.from({length: positions.length / 3}, (_, n) =>
    dot(minus(at(positions, n), at(from, n)), at(normals, n)));
}
