// Nodes that keep their place along a shape, and edges that are told from noise.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { compiled } from './support.mjs';

const { shapeOf } = await compiled('shape/shape');
const { stayed, slid, strayed } = await compiled('shape/stays');
const { sharpNodes } = await compiled('shape/sharp');

// A sheet over a grid of so many cells a side.
function sheet(cells, height) {
  const places = [];
  for (let i = 0; i <= cells; ++i) for (let j = 0; j <= cells; ++j) places.push([i / cells, j / cells, height(i / cells, j / cells)]);
  const at = (i, j) => i * (cells + 1) + j;
  const corners = [];
  for (let i = 0; i < cells; ++i) for (let j = 0; j < cells; ++j) corners.push(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  const faceBegin = Int32Array.from({ length: cells * cells + 1 }, (_, f) => 4 * f);
  return shapeOf({ positions: Float64Array.from(places.flat()), boundary: new Uint8Array(places.length), warnings: [], faceBegin, corners: Int32Array.from(corners) });
}

const random = (() => {
  let state = 7;
  return () => (state = (state * 16807) % 2147483647) / 2147483647 - 0.5;
})();

const [middle, radius] = [[0.5, 0.5, -1.5], 2];
const dome = (x, y) => middle[2] + Math.sqrt(radius ** 2 - (x - middle[0]) ** 2 - (y - middle[1]) ** 2);
const distance = (places, node) => Math.hypot(...middle.map((part, i) => places[3 * node + i] - part)) - radius;

test('nodes that have slid over a sphere go back along it, straight across or to their x', () => {
  const [cells, far] = [20, 0.01];
  const noisy = sheet(cells, (x, y) => dome(x, y) + 2 * far * random());
  // The smooth shape, whose nodes have slid by up to half an edge.
  const smooth = Float64Array.from(noisy.input);
  for (let node = 0; node < smooth.length / 3; ++node) {
    const [x, y] = [0, 1].map((i) => noisy.input[3 * node + i] + (0.5 / cells) * random());
    smooth.set([x, y, dome(x, y)], 3 * node);
  }
  const inside = Array.from({ length: smooth.length / 3 }, (_, node) => node).filter((node) => [Math.floor(node / (cells + 1)), node % (cells + 1)].every((k) => k > 0 && k < cells));
  const greatest = (of) => Math.max(...inside.map((node) => Math.abs(of(node))));
  assert.ok(slid(noisy, noisy.input, smooth) > 0.3 / cells, 'they have slid');
  const across = stayed(noisy, noisy.input, smooth, 'normal', 1);
  assert.ok(slid(noisy, noisy.input, across.positions) < 2e-3, `${slid(noisy, noisy.input, across.positions)}`);
  // Of the second order: half the curvature times the square of the way back.
  assert.ok(greatest((node) => distance(across.positions, node)) < 0.5 / radius * (0.5 / cells) ** 2);
  const limited = stayed(noisy, noisy.input, smooth, 'normal', far / 2).positions;
  assert.ok(greatest((node) => Math.hypot(...[0, 1, 2].map((i) => limited[3 * node + i] - noisy.input[3 * node + i]))) <= far / 2 * (1 + 1e-12), 'no node goes further');
  for (const [axis, stay] of ['x', 'y'].entries()) {
    const { positions, steep } = stayed(noisy, noisy.input, smooth, stay, 1);
    assert.equal(steep, 0);
    assert.equal(greatest((node) => positions[3 * node + axis] - noisy.input[3 * node + axis]), 0);
    assert.ok(greatest((node) => distance(positions, node)) < 1 / radius * (0.5 / cells) ** 2);
  }
});

test('nodes of a circle keep their x but where it is steep', () => {
  const count = 80;
  const circle = (turn) => Float64Array.from(Array.from({ length: count }, (_, k) => [Math.cos((2 * Math.PI * (k + turn)) / count), Math.sin((2 * Math.PI * (k + turn)) / count), 0]).flat());
  const [before, after] = [circle(0), circle(0.3)];
  const curve = shapeOf({ positions: before, boundary: new Uint8Array(count), warnings: [], chainBegin: Int32Array.of(0, count), chainNodes: Int32Array.from({ length: count }, (_, k) => k), closed: Uint8Array.of(1), planar: true });
  const { positions, steep } = stayed(curve, before, after, 'x', 1);
  assert.ok(steep > 4 && steep < count / 4, `${steep}`);
  let kept = 0;
  for (let k = 0; k < count; ++k) {
    if (positions[3 * k] === before[3 * k]) ++kept;
    assert.ok(Math.abs(Math.hypot(positions[3 * k], positions[3 * k + 1]) - 1) < 2e-3, `${k}`);
    assert.equal(positions[3 * k + 2], 0);
  }
  assert.ok(kept >= count - steep);
});

test('an edge is sharp by its angle, but not where noise turns most edges as much; of a curve a corner is', () => {
  const cells = 24;
  const roof = (noise) => sheet(cells, (x) => 1.2 * Math.min(x, 1 - x) + noise * random());
  const ridge = Array.from({ length: cells + 1 }, (_, j) => (cells / 2) * (cells + 1) + j);
  for (const noise of [0, 0.002]) {
    const shape = roof(noise);
    assert.deepEqual(sharpNodes(shape, shape.input, 40), ridge, `noise ${noise}`);
  }
  const bare = roof(0);
  assert.deepEqual(sharpNodes(bare, bare.input, 110), [], 'it turns by 100 degrees');
  const rough = sheet(cells, () => 0.05 * random());
  const many = sharpNodes(rough, rough.input, 40).length;
  assert.equal(many, 0, 'nodes of noise');
  const pimple = sheet(cells, (x, y) => (x === 0.5 && y === 0.5 ? 0.1 : 0));
  assert.deepEqual(sharpNodes(pimple, pimple.input, 40), [], 'a fold is no edge of the shape');
  const nose = Array.from({ length: 13 }, (_, k) => [Math.cos((k - 6) / 2.5), Math.sin((k - 6) / 2.5), 0]).map(([x, y, z]) => [2 * x, 0.8 * y, z]);
  const tip = shapeOf({ positions: Float64Array.from(nose.flat()), boundary: new Uint8Array(13), warnings: [], chainBegin: Int32Array.of(0, 13), chainNodes: Int32Array.from(nose.keys()), closed: Uint8Array.of(0), planar: true });
  assert.deepEqual(sharpNodes(tip, tip.input, 40), [], 'nor is a nose with few nodes a corner');
  const square = [[0, 0], [1, 0], [2, 0], [2, 1], [2, 2], [1, 2], [0, 2], [0, 1]];
  const curve = (closed) => shapeOf({ positions: Float64Array.from(square.flatMap((place) => [...place, 0])), boundary: new Uint8Array(8), warnings: [], chainBegin: Int32Array.of(0, 8), chainNodes: Int32Array.from({ length: 8 }, (_, k) => k), closed: Uint8Array.of(closed), planar: true });
  assert.deepEqual([1, 0].map((closed) => sharpNodes(curve(closed), curve(closed).input, 40)), [[0, 2, 4, 6], [2, 4, 6]]);
});

test('nodes of a curve that slide along it have left it by nothing, those that go across by their way, closed and open', () => {
  const count = 40;
  for (const closed of [true, false]) {
    const curve = { runs: { begin: Int32Array.from([0, count]), nodes: Int32Array.from({ length: count }, (_, k) => k) }, closed: [closed], planar: true, plane: [0, 0, 1] };
    const at = (k, radius) => [radius * Math.cos((2 * Math.PI * k) / count), radius * Math.sin((2 * Math.PI * k) / count), 0];
    const start = Float64Array.from(Array.from({ length: count }, (_, k) => at(k, 1)).flat());
    // On edges, two and a half further; an open one ends in its last node.
    const along = Float64Array.from(Array.from({ length: count }, (_, k) => {
      const [before, after] = [2, 3].map((n) => at(closed ? k + n : Math.min(k + n, count - 1), 1));
      return before.map((part, i) => (part + after[i]) / 2);
    }).flat());
    assert.ok(strayed(curve, start, along) < 1e-14);
    const across = start.slice();
    across.set(at(7, 1.1), 21);
    assert.ok(Math.abs(strayed(curve, start, across) - 0.1) < 1e-12);
  }
});
