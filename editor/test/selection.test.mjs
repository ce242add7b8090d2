// What needs no browser of picking many nodes: outlines on the screen, what is hidden, neighbours, regions.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { compiled } from './support.mjs';

const { inBox, inLoop, Squares } = await compiled('pick/within');
const { visibleNodes } = await compiled('pick/visible');
const { grown, rim, shrunk, withParts, all, inverted } = await compiled('shape/neighbours');
const { restricted } = await compiled('constraints/region');
const { shapeOf } = await compiled('shape/shape');
const { initial, edited, toFile } = await compiled('constraints/constraints');

// Nodes at whole pixels, 10 across and 10 down, in rows.
const screen = Float32Array.from({ length: 300 }, (_, k) => [Math.floor(k / 3) % 10, Math.floor(k / 30), 0][k % 3]);
const sorted = (nodes) => [...nodes].sort((a, b) => a - b);

test('boxes, loops and strokes take the nodes within', () => {
  assert.deepEqual(inBox(screen, [4.5, 2.5], [2.5, 0.5]), [13, 14, 23, 24]);
  const where = (inside) => sorted(Array.from({ length: 100 }, (_, n) => n).filter((n) => inside(n % 10, Math.floor(n / 10))));
  // A frame: the hole belongs to the outside.
  const loop = [[0.6, 0.6], [8.4, 0.6], [8.4, 8.4], [0.6, 8.4], [0.6, 0.6], [2.6, 2.6], [6.4, 2.6], [6.4, 6.4], [2.6, 6.4], [2.6, 2.6]];
  const frame = (x, y) => x >= 1 && x <= 8 && y >= 1 && y <= 8 && !(x >= 3 && x <= 6 && y >= 3 && y <= 6);
  assert.deepEqual(inLoop(screen, loop), where(frame));
  assert.deepEqual(inLoop(screen, [[3, 3]]), []);
  const squares = new Squares(screen, 10, 8, 4);
  const inStroke = (...stroke) => sorted(squares.inStroke(...stroke));
  assert.deepEqual(inStroke([2, 5], [6, 5], 1.2), where((x, y) => Math.hypot(x - Math.min(6, Math.max(2, x)), y - 5) <= 1.2));
  assert.deepEqual(inStroke([2, 5], [2, 5], 0.5), [52]);
  assert.deepEqual(inStroke([-3, 4], [20, 4], 100).length, 80, 'two rows are off the screen');
});

test('nodes behind a face are hidden, those on it and beside it are not', () => {
  // A square of two triangles, leaning; one node behind it, one before it, one beside it and one that it has in its own plane.
  const places = Float32Array.of(10, 10, 0, 90, 10, 0.4, 90, 90, 0.4, 10, 90, 0, 50, 50, 0.5, 50, 40, 0.1, 95, 50, 0.9, 30, 60, 0.1);
  const visible = visibleNodes(places, { triangles: Uint32Array.of(0, 1, 2, 0, 2, 3), width: 100, height: 100 });
  assert.deepEqual([...visible], [1, 1, 1, 1, 0, 1, 1, 1]);
});

// Two strips of squares, apart: nodes 0 to 9 and 10 to 15.
function strips() {
  const corners = [];
  for (const [first, squares] of [[0, 4], [10, 2]])
    for (let k = 0; k < squares; ++k) corners.push(first + 2 * k, first + 2 * k + 1, first + 2 * k + 3, first + 2 * k + 2);
  return shapeOf({ positions: Float64Array.from({ length: 48 }, (_, k) => (7 * k) % 11), corners: Int32Array.from(corners),
    faceBegin: Int32Array.from({ length: 7 }, (_, f) => 4 * f), boundary: new Uint8Array(16), warnings: [] });
}

test('rings, connected parts, all and the rest', () => {
  const shape = strips();
  assert.deepEqual(sorted(grown(shape, new Set([4]))), [2, 4, 5, 6]);
  assert.deepEqual(sorted(shrunk(shape, new Set([0, 1, 2, 3, 4]))), [0, 1, 2]);
  assert.deepEqual(sorted(shrunk(shape, new Set(Array(10).keys()))), [...Array(10).keys()], 'what has no outside keeps all');
  assert.deepEqual(sorted(withParts(shape, new Set([12]))), [10, 11, 12, 13, 14, 15]);
  assert.deepEqual(sorted(withParts(shape, new Set([0, 15]))), [...Array(16).keys()]);
  assert.deepEqual(sorted(rim(shape, [0, 1, 2, 3, 10])), [2, 3, 10]);
  assert.equal(all(shape).size, 16);
  assert.deepEqual(sorted(inverted(shape, withParts(shape, new Set([0])))), [10, 11, 12, 13, 14, 15]);
});

test('a region comes after what held already, as rules of a constraints file; another one takes its place and keeps what it moved', () => {
  const held = edited(initial, [3], () => ({ position: [1, 2, 3] }));
  const input = new Float64Array(30);
  const seen = input.slice();
  const rules = (constraints) => JSON.parse(toFile(constraints)).rules;
  const before = [{ nodes: 'boundary', position: 'fixed' }, { nodes: [3], position: [[1, 2, 3]] }];
  const first = restricted(held, [0, 1, 2], { fixed: Int32Array.of(7, 8), rim: Int32Array.of(7), normals: Float64Array.of(0, 0.6, 0.8) }, input, seen);
  assert.deepEqual(rules(first), [...before, { nodes: [7, 8], position: 'fixed' }, { nodes: [7], normal: [[0, 0.6, 0.8]] }]);
  seen.set([4, 5, 6], 3);
  const none = { rim: new Int32Array(), normals: new Float64Array() };
  const second = restricted(first, [8], { ...none, fixed: Int32Array.of(0, 1, 2, 7) }, input, seen);
  assert.deepEqual(rules(second), [...before, { nodes: [0, 2, 7], position: 'fixed' }, { nodes: [1], position: [[4, 5, 6]] }]);
  assert.equal(rules(restricted(initial, [0], { ...none, fixed: new Int32Array() }, input, input)).length, 1);
});

test('nodes have mirror images within a small share of an edge, and moves and turns are mirrored', async () => {
  const { Mirror } = await compiled('shape/mirror');
  // Five by three nodes about x = 0, one of them moved a little, one too far.
  const positions = new Float64Array(45);
  for (let k = 0; k < 15; ++k) positions.set([(k % 5) - 2, Math.floor(k / 5), 7], 3 * k);
  positions[0] -= 0.05;
  positions[3 * 14] += 0.2;
  const shape = { input: positions, scale: 0.25, spacing: 0.25 };
  const mirror = new Mirror(shape, 0);
  assert.deepEqual([0, 1, 2, 5, 14, 10].map((node) => mirror.with([node])), [[0, 4], [1, 3], [2], [5, 9], [14], [10]]);
  assert.equal(mirror.count, 13);
  assert.equal(new Mirror(shape, 1).count, 5, 'of y only those at 0 are their own images: all others lie on one side');
  assert.deepEqual(mirror.with([3, 1, 2]), [3, 1, 2]);
  const way = [1, 2, 3];
  assert.deepEqual([4, 0, 2, 3, 14].map((node) => mirror.mirrored(way, 4, node, false)), [way, [-1, 2, 3], [0, 2, 3], way, way]);
  assert.deepEqual([0, 2].map((node) => mirror.mirrored(way, 4, node, true)), [[1, -2, -3], [1, 0, 0]], 'a turn is mirrored the other way round');
  assert.deepEqual(mirror.mirrored(way, 2, 1, false), [-1, 2, 3], 'from a node on the plane the side of greater coordinates goes as it does');
});
