// What of curves needs no browser: edges of chains, planes, the comb.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { compiled } from './support.mjs';

const { shapeOf } = await compiled('shape/shape');
const { withParts, grown } = await compiled('shape/neighbours');
const { planeOf } = await compiled('shape/curve_plane');
const { combOf, toothOf } = await compiled('view/comb');
const { Pull } = await compiled('pull/pull');
const { tiltedWithin } = await compiled('base/turning');
const { heldNodes, toFile, edited, initial } = await compiled('constraints/constraints');

// An open chain of three nodes and a closed one of four, in one file.
const positions = Float64Array.of(0, 0, 0, 1, 0, 0, 2, 1, 0, 5, 0, 0, 6, 0, 0, 6, 1, 0, 5, 1, 0);
const opened = {
  positions, boundary: Uint8Array.of(1, 0, 1, 0, 0, 0, 0), warnings: [],
  chainBegin: Int32Array.of(0, 3, 7), chainNodes: Int32Array.of(0, 1, 2, 3, 4, 5, 6), closed: Uint8Array.of(0, 1), planar: false,
};

test('a curve has the edges of its chains and no face, and what is picked grows along them', () => {
  const shape = shapeOf(opened);
  assert.deepEqual([...shape.edges.ends], [0, 1, 1, 2, 3, 4, 4, 5, 5, 6, 6, 3]);
  assert.equal(shape.faces.begin.length, 1);
  assert.deepEqual(shape.curve.closed, [false, true]);
  assert.deepEqual(shape.curve.plane, [0, 0, 1]);
  assert.deepEqual([...withParts(shape, new Set([5]))].sort(), [3, 4, 5, 6]);
  assert.deepEqual([...grown(shape, new Set([6]))].sort(), [3, 5, 6]);
});

test('the plane of a curve is found wherever it lies; lines and space curves have none', () => {
  const circle = (place) => Float64Array.from(Array.from({ length: 12 }, (_, k) => place(Math.cos(k / 2), Math.sin(k / 2))).flat());
  const [x, y, z] = planeOf(circle((c, s) => [100 + c, 2 * s, 7 - c + s]));
  const length = Math.hypot(1, 0.5, 1);  // of the normal (1, −1/2, 1) of those places
  for (const [part, wanted] of [[x, 1 / length], [y, -0.5 / length], [z, 1 / length]]) assert.ok(Math.abs(part - wanted) < 1e-12, `${x} ${y} ${z}`);
  assert.equal(planeOf(circle((c, s) => [c, s, 0.01 * c * s])), null);
  assert.equal(planeOf(circle((c) => [c, 2 * c, -c])), null);
});

test('hairs of the comb are as long as curvature is large, away from the centre', () => {
  const points = [[2, 0, 0], [0, 2, 0], [-2, 0, 0], [0, -2, 0]];
  const chains = [{ points, vectors: points.map(([x, y]) => [-x / 4, -y / 4, 0]), closed: true }];  // a circle of radius 2
  const tooth = toothOf(chains, 4);
  assert.equal(tooth, 0.15 * 4 / 0.5);
  const { hairs, envelope } = combOf(chains, tooth, 4, (point) => point);
  assert.equal(hairs.length, 4 * 6);
  assert.equal(envelope.length, 4 * 6, 'the envelope is closed as the curve is');
  assert.deepEqual([...hairs.subarray(0, 6)].map((part) => Math.round(1e6 * part) / 1e6), [2, 0, 0, 2.6, 0, 0]);
  const far = combOf(chains, 100 * tooth, 4, (point) => point).hairs;
  assert.ok(Math.abs(far[3] - (2 + 0.4 * 4)) < 1e-6, 'very long ones are cut off');
  assert.equal(toothOf([{ points, vectors: points.map(() => [0, 0, 1e-9]), closed: true }], 4), 0.15 * 4 / (0.02 / 4), 'rounding on a straight one is not made large');
});

test('a curve follows the pointer at once, without steps', () => {
  const pull = new Pull('position', [3], (way) => Float64Array.from(way), 1, Infinity);
  pull.aim([5, 0, 0], 7);
  const step = pull.step();
  assert.deepEqual([...step.vectors, step.time], [5, 0, 0, 7]);
  pull.solved(step, 100);
  pull.aim([9, 0, 0], 8);
  assert.deepEqual([...pull.step().vectors], [9, 0, 0]);
});

test('tangents are held, marked and written as positions are', () => {
  const state = edited(initial, [1], () => ({ tangent: [0, 1, 0] }));
  assert.deepEqual(JSON.parse(toFile(state)).rules.at(-1), { nodes: [1], tangent: [[0, 1, 0]] });
  assert.deepEqual([...heldNodes(state, Uint8Array.of(1, 0, 1)).nodes], [1, 4, 1]);
  assert.deepEqual([...heldNodes(edited(state, [1], () => ({ tangent: 'free' })), Uint8Array.of(1, 0, 1)).nodes], [1, 0, 1]);
});

test('a tangent that is tilted stays in the plane of the curve', () => {
  const lean = [[1, 0, 0], [0, 0.8, 0.6], [0, -0.6, 0.8]];  // seen from aside
  const [x, y, z] = tiltedWithin([0, 0, 1], [0, 1, 0], lean, 0.8, 0);
  assert.deepEqual([x, y, z], [0.8 / Math.hypot(0.8, 1), 1 / Math.hypot(0.8, 1), 0]);
  assert.deepEqual(tiltedWithin([0, 0, 1], [0, 1, 0], lean, 0, -1.25).map((part) => part || 0), [0, 1, 0], 'and points somewhere');
});
