// Sections of surfaces and their combs.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { compiled } from './support.mjs';

const { shapeOf, placesOf } = await compiled('shape/shape');
const { verticesOf } = await compiled('shape/vertices');
const { sectionOf } = await compiled('shape/section');
const { combedSection } = await compiled('view/comb');

// Quads around an axis between two heights: rows of them, the radius of each given.
function lathe(columns, rows, radiusAt) {
  const positions = [];
  const corners = [];
  const node = (row, column) => row * columns + (column % columns);
  for (let row = 0; row <= rows; ++row) {
    const z = (2 * row) / rows - 1;
    for (let column = 0; column < columns; ++column) {
      const turn = (2 * Math.PI * (column + 0.3 * (row % 2))) / columns;
      positions.push(radiusAt(z) * Math.cos(turn), radiusAt(z) * Math.sin(turn), z);
      if (row < rows) corners.push(node(row, column), node(row, column + 1), node(row + 1, column + 1), node(row + 1, column));
    }
  }
  return shapeOf({ positions: Float64Array.from(positions), corners: Int32Array.from(corners), faceBegin: Int32Array.from({ length: corners.length / 4 + 1 }, (_, f) => 4 * f),
    boundary: new Uint8Array(positions.length / 3), warnings: [] });
}

function sections(shape, axis, at) {
  const places = placesOf(shape, shape.input);
  return sectionOf(shape, places, verticesOf(shape.faces, places, shape.edges), axis, at);
}

test('sections of a sphere are circles, and their hairs as long as one over the radius, away from the centre', () => {
  const radius = 1.5;
  const shape = lathe(48, 24, (z) => Math.sqrt(radius ** 2 - z ** 2));
  const level = sections(shape, 2, 0.31 * shape.scale);
  assert.deepEqual(level.map(({ closed }) => closed), [true]);
  const upright = sections(shape, 0, 0.4 * shape.scale);
  assert.deepEqual(upright.map(({ closed }) => closed), [false, false], 'from rim to rim on both sides');
  for (const [runs, apart, axis] of [[level, 0.31, 2], [upright, 0.4, 0]]) {
    const expected = 1 / (Math.sqrt(radius ** 2 - apart ** 2) * shape.scale);
    for (const run of runs) {
      const { points, vectors } = combedSection(run, shape.spacing);
      assert.ok(points.length > 12);
      points.forEach((point, k) => {
        if (!vectors[k]) return;
        assert.ok(vectors[k][axis] === 0);
        assert.ok(Math.abs(Math.hypot(...vectors[k]) / expected - 1) < 0.02, `${Math.hypot(...vectors[k])} for ${expected}`);
        const middle = point.map((part, i) => (i === axis ? 0 : part));
        const outwards = vectors[k].reduce((sum, part, i) => sum + part * middle[i], 0);
        assert.ok(outwards < 0, 'the vector is towards the centre, and the hair the other way');
      });
    }
  }
});

test('a section ends at sharp edges, so that hairs there say nothing of them', () => {
  const shape = lathe(4, 3, () => 1);
  const runs = sections(shape, 2, 0.1 * shape.scale);
  assert.equal(runs.length, 4);
  for (const run of runs) {
    assert.ok(!run.closed);
    for (const vector of combedSection(run, shape.spacing).vectors) assert.ok(!vector || Math.hypot(...vector) < 1e-6);
  }
  assert.deepEqual(sections(shape, 2, 2 * shape.scale), [], 'beyond it there is none');
});
