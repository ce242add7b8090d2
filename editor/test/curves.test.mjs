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

test('nodes are inserted on a smooth curve and deleted, and what holds by their numbers follows', async () => {
  const { gapsBetween, inserted, nodesOf, without } = await compiled('constraints/nodes');
  const { renumbered, placed, untouched } = await compiled('constraints/constraints');
  const { keepingAdded } = await compiled('constraints/region');
  const nodes = nodesOf(shapeOf(opened), undefined);
  assert.deepEqual(gapsBetween(nodes, new Set([0, 1, 3, 6])), [{ chain: 0, at: 0, share: 0.5 }, { chain: 1, at: 3, share: 0.5 }]);
  assert.deepEqual(gapsBetween(nodes, new Set([2])), [{ chain: 0, at: 1, share: 0.5 }], 'behind the last node there is nothing');

  const more = inserted(nodes, [{ chain: 1, at: 3, share: 0.5 }, { chain: 0, at: 0, share: 0.75 }, { chain: 0, at: 0, share: 0.25 }]);
  assert.deepEqual([...more.curve.chainNodes], [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
  assert.deepEqual([...more.curve.chainBegin], [0, 5, 10]);
  assert.deepEqual([...more.curve.from], [0, -1, -1, 1, 2, 3, 4, 5, 6, -1]);
  assert.deepEqual(more.added, [{ node: 1, between: [0, 3] }, { node: 2, between: [0, 3] }, { node: 9, between: [8, 5] }]);

  const fewer = without(more.curve, new Set([0, 6, 9]));
  assert.deepEqual([[...fewer.curve.from], [...fewer.curve.chainBegin], [...fewer.curve.chainNodes]], [[-1, -1, 1, 2, 3, 5, 6], [0, 4, 7], [0, 1, 2, 3, 4, 5, 6]]);
  assert.throws(() => without(nodes, new Set([0, 1])), /at least two nodes/);
  assert.throws(() => without(nodes, new Set([3, 4])), /a closed one three/);
  assert.equal(without(nodes, new Set([0, 1, 2])).curve.closed.length, 1, 'a chain goes as a whole');

  const held = placed({ ...initial, rules: [...initial.rules, { nodes: [0, 2, 5], position: [[0, 0, 1], [0, 0, 2], [0, 0, 3]], tangent: [1, 0, 0] }, { nodes: [0, 5], tangent_in: [[1, 0], [0, 1]], corner: true }] }, [1], Float64Array.of(7, 8, 9));
  const after = renumbered(renumbered(held, more.now), fewer.now);
  assert.deepEqual(after.rules, [initial.rules[0], { nodes: [3, 5], position: [[0, 0, 2], [0, 0, 3]], tangent: [1, 0, 0] }, { nodes: [5], tangent_in: [[0, 1]], corner: true }]);
  assert.deepEqual(after.edits, { 2: { position: [7, 8, 9] } });

  const region = [{ nodes: [0, 1, 3], position: 'fixed' }];
  const kept = keepingAdded(renumbered({ ...held, region }, more.now), more, more.curve.positions);
  assert.deepEqual(kept.region[1].nodes, [1, 2], 'between nodes that stay, not beside one that moves');
  assert.deepEqual(kept.region[1].position[0], [...more.curve.positions.subarray(3, 6)]);
  assert.equal(renumbered(untouched, more.now).region, untouched.region);
});

test('a node that is inserted in a circle or at the end of a parabola lies on it', async () => {
  const { inserted } = await compiled('constraints/nodes');
  const curve = (points, closed) => ({ positions: Float64Array.from(points.flat()), chainBegin: Int32Array.of(0, points.length), chainNodes: Int32Array.from(points.keys()), closed: Uint8Array.of(Number(closed)), from: Int32Array.from(points.keys()) });
  const circle = Array.from({ length: 16 }, (_, k) => [3 * Math.cos((k * Math.PI) / 8), 3 * Math.sin((k * Math.PI) / 8), 0]);
  const ring = inserted(curve(circle, true), [{ chain: 0, at: 15, share: 0.3 }]).curve.positions.subarray(48);
  assert.ok(Math.abs(Math.hypot(...ring) - 3) < 0.004, `${Math.hypot(...ring)}`);  // the chord is 0.05 inside
  const line = inserted(curve([[0, 0, 0], [1, 2, 3]], false), [{ chain: 0, at: 0, share: 0.5 }]).curve.positions.subarray(3, 6);
  assert.deepEqual([...line].map((part) => Math.round(1e9 * part) / 1e9), [0.5, 1, 1.5]);
  const end = inserted(curve([[0, 0, 0], [1, 0.01, 0], [2, 0.04, 0]], false), [{ chain: 0, at: 0, share: 0.5 }]).curve.positions.subarray(3, 6);
  assert.ok(Math.abs(end[1] - 0.0025) < 1e-4, `${end}`);
});
