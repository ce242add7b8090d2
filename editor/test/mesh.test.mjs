// What pictures and pages need to know of meshes.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { edgesOf, normalsOf } from '../../page/mesh.js';

test('sheets that meet along an edge of three faces keep their sides', () => {
  // A floor of two triangles along the edge 0–1, and a wall on it that runs along it as one of them does.
  const positions = Float64Array.of(0, 0, 0, 1, 0, 0, 0.5, -1, 0, 0.5, 1, 0, 0.5, 0, 1, 0.5, 2, 0);
  const faces = (wall) => ({ begin: Int32Array.of(0, 3, 6, 9, 12), nodes: Int32Array.of(...wall, 1, 0, 2, 0, 1, 3, 1, 5, 3) });
  for (const wall of [[0, 1, 4], [1, 0, 4]]) {
    const edges = edgesOf(faces(wall), 6);
    assert.deepEqual(edges.crowded.reduce((sum, one) => sum + one), 1);
    const normals = normalsOf(faces(wall), positions, edges);
    // All of the floor looks up.
    for (const node of [2, 3, 5]) assert.ok(normals[3 * node + 2] > 0.99, `node ${node} of ${wall}`);
  }
});
