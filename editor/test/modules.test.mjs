// What needs no browser: constraints, history, the one job that waits, picking, sharp edges, frames.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { compiled } from './support.mjs';

const constraints = await compiled('constraints/constraints');
const history = await compiled('edit/history');
const { merged, Solver } = await compiled('library/client');
const { pick } = await compiled('pick/picking');
const { verticesOf, setNormals, partOf } = await compiled('shape/vertices');
const { shapeOf, placesOf } = await compiled('shape/shape');
const { withLoops } = await compiled('shape/loops');
const { Pull } = await compiled('pull/pull');
const { FrameCounter } = await compiled('edit/frames');

test('constraints come out of the file that they are written to', () => {
  const { initial, edited, placed, toFile, fromFile, heldNodes, withBoundary } = constraints;
  const third = 1 / 3;
  let state = placed(initial, [4, 2], Float64Array.of(third, 1e-30, -2, 1, 2, 3));
  state = edited(state, [1], () => ({ position: 'free', normal: 'fixed' }));
  const boundary = Uint8Array.of(1, 1, 0, 0, 0);
  const rules = JSON.parse(toFile(state)).rules;
  assert.deepEqual(rules, [
    { nodes: 'boundary', position: 'fixed' },
    { nodes: [1], position: 'free' },
    { nodes: [2, 4], position: [[1, 2, 3], [third, 1e-30, -2]] },
    { nodes: [1], normal: 'fixed' },
  ]);
  const again = fromFile(toFile(state));
  assert.equal(toFile(again), toFile(state));
  for (const same of [state, again]) assert.deepEqual([...heldNodes(same, boundary).nodes], [1, 2, 1, 0, 1]);
  const without = withBoundary(withBoundary(state, 'normal', true), 'position', false);
  assert.deepEqual(JSON.parse(toFile(without)).rules[0], { nodes: 'boundary', normal: 'fixed' });
  assert.deepEqual(initial.edits, {}, 'states are never changed');
});

test('sharp edges are rules of paths along their chains, and mark no node', () => {
  const rules = constraints.sharpRules({ chainBegin: Int32Array.of(0, 3, 6), chainNodes: Int32Array.of(4, 0, 2, 1, 3, 5), closed: Uint8Array.of(0, 1) });
  assert.deepEqual(rules, [{ nodes: [4, 0, 2], sharp: 'path' }, { nodes: [1, 3, 5], sharp: 'path' }, { nodes: [5, 1], sharp: 'path' }]);
  const state = { ...constraints.initial, sharp: { angle: 40, rules } };
  const boundary = Uint8Array.of(1, 0, 0, 0, 0, 0);
  assert.deepEqual([...constraints.heldNodes(state, boundary).nodes], [1, 0, 0, 0, 0, 0]);
  assert.deepEqual(JSON.parse(constraints.toFile(state)).rules, [...constraints.initial.rules, ...rules]);
  const baked = constraints.baked(state, new Float64Array(18));
  assert.deepEqual(constraints.byInput(baked, { input: new Float64Array(18), boundary }, new Map()).rules.slice(-3), rules, 'they stay where another shape is the start');
});

test('rules about groups and regions are kept, and counted as not marked', () => {
  const file = '{"rules": [\n  {"nodes":{"group":"rim"},"position":"fixed","note":1},\n  {"nodes":"interior","normal":"file"}\n]}\n';
  const state = constraints.fromFile(file);
  assert.equal(constraints.toFile(state), file);
  const held = constraints.heldNodes(state, Uint8Array.of(1, 0));
  assert.deepEqual([[...held.nodes], held.unmarked], [[0, 2], 1]);
  const corners = [{ nodes: [1], corner: true }, { nodes: [0], tangent_out: [1, 0] }];
  assert.deepEqual(constraints.withBoundary({ rules: corners, edits: {} }, 'position', false).rules, corners);
  assert.throws(() => constraints.fromFile('{"rule": []}'), /a list "rules"/);
  assert.throws(() => constraints.fromFile('{'), SyntaxError);
});

test('what is undone can be redone, until something else is done', () => {
  const { begun, done, undone, redone } = history;
  const two = done(done(begun(0), 'one', 1), 'two', 2);
  assert.equal(undone(two).now.state, 1);
  assert.deepEqual(redone(undone(two)), two);
  const other = done(undone(two), 'three', 3);
  assert.deepEqual([other.now.state, other.past.length, other.future.length], [3, 2, 0]);
});

test('newer jobs stand for those that wait, and constraints are not lost', async () => {
  const drag = (time) => ({ drag: { nodes: Int32Array.of(0), places: new Float64Array(3), time } });
  assert.deepEqual(merged({ rules: 'a' }, drag(1)), { rules: 'a', ...drag(1) });
  assert.deepEqual(merged(drag(1), { rules: 'b' }), { rules: 'b' });
  const asked = [];
  const ends = [];
  const busy = [];
  const client = { ask: (_, job) => new Promise((done) => asked.push({ job, done })), endSolutions: () => ends.push(asked.length) };
  const solver = new Solver(client, { solved() {}, failed() {}, progress() {}, busy: (on) => busy.push(on) });
  for (let time = 0; time < 50; ++time) solver.push(drag(time));
  assert.equal(asked.length, 1);
  asked[0].done({});
  await new Promise(setImmediate);
  assert.deepEqual(asked.map(({ job }) => job.drag.time), [0, 49]);
  solver.push({ rules: 'c' });
  assert.deepEqual(ends, [], 'a frame is shown');
  asked[1].done({});
  await new Promise(setImmediate);
  solver.push(drag(60));
  assert.deepEqual(ends, [3], 'what takes long is not waited for');
  asked[2].done({});
  await new Promise(setImmediate);
  asked[3].done({});
  await new Promise(setImmediate);
  assert.deepEqual([asked.length, busy.at(-1)], [4, false]);

  solver.push(drag(70));
  await new Promise((done) => setTimeout(done, 110));
  solver.push(drag(71));
  assert.deepEqual(ends, [3], 'the drag goes on');
  solver.push({ rules: 'd' });
  assert.deepEqual(ends, [3, 5], 'a slow step of a drag that has ended is not waited for');
});

test('what waits is given up with what is solved, and what it was to hold is told with the next one', async () => {
  const asked = [];
  const told = [];
  const client = { ask: (_, job) => new Promise((done) => asked.push({ job, done })), endSolutions() {}, endNow: () => told.push('end now') };
  const solver = new Solver(client, { solved: () => told.push('solved'), failed() {}, ended: () => told.push('ended'), progress() {}, busy: (on) => told.push(on) });
  solver.push({ rules: 'a' });
  solver.push({ rules: 'b', fairBoundary: true });
  solver.cancel();
  asked[0].done({});
  await new Promise(setImmediate);
  assert.deepEqual(told, [true, 'end now', 'solved', 'ended', false], 'nothing more is solved');
  solver.push({ drag: 1 });
  assert.deepEqual(asked.map(({ job }) => job), [{ rules: 'a' }, { rules: 'b', fairBoundary: true, drag: 1 }]);
  asked[1].done({});
  await new Promise(setImmediate);
  solver.push({ drag: 2 });
  assert.deepEqual(asked[2].job, { drag: 2 }, 'it is told once');
});

test('another worker is told what opened the shape, its points, its newest nodes and where it starts last', async () => {
  const { CoreClient } = await compiled('library/client');
  const workers = [];
  globalThis.self = globalThis;
  globalThis.document = { baseURI: 'http://here/' };
  globalThis.Worker = class {
    posted = [];
    constructor() { workers.push(this); }
    addEventListener(type, call) { this[type] = call; }
    postMessage(message) { this.posted.push(message); }
    terminate() {}
  };
  const client = new CoreClient(assert.fail);
  const answered = async (kind, ask) => {
    const answer = client.ask(kind, ask);
    workers[0].message({ data: { number: workers[0].posted.at(-1).number, answer: {} } });
    await answer;
  };
  await answered('open', 'an older file');
  await answered('open', 'file');
  await answered('patches', 'older');
  await answered('fill', 'all holes');
  await answered('start', 'of the older patches');
  await answered('patches', 'newest');
  await answered('nodes', 'older');
  await answered('points', 'cloud');
  await answered('start', 'of the older nodes');
  await answered('nodes', 'newest');
  await answered('start', 'older');
  await answered('start', 'newest');
  const given = client.ask('solve', {});
  client.endNow();
  await assert.rejects(given);
  assert.deepEqual(workers[1].posted.slice(1).map(({ kind, ask }) => [kind, ask]), [['open', 'file'], ['patches', 'newest'], ['points', 'cloud'], ['nodes', 'newest'], ['start', 'newest']]);
});

test('holes that take too long are given up with the library that fills them', async () => {
  const { CoreClient, Ended } = await compiled('library/client');
  const workers = [];
  globalThis.self = globalThis;
  globalThis.document = { baseURI: 'http://here/' };
  globalThis.Worker = class {
    posted = [];
    constructor() { workers.push(this); }
    addEventListener() {}
    postMessage(message) { this.posted.push(message); }
    terminate() { this.gone = true; }
  };
  const client = new CoreClient(assert.fail);
  const filled = client.ask('fill', {});
  client.endNow();
  await assert.rejects(filled, Ended);
  assert.deepEqual([workers.length, workers[0].gone], [2, true]);
});

test('newer patches are numbered on from older ones, and keep what was said of them', async () => {
  const { withMore } = await compiled('constraints/patches');
  const older = { patches: { positions: Float64Array.of(1, 2, 3), corners: Int32Array.of(0, 1, 9), nodeLike: Int32Array.of(4), faceLike: Int32Array.of(2), groupBegin: Int32Array.of(7), groupNames: ['hole_0'] }, warnings: ['crosses'] };
  const newer = { patches: { positions: Float64Array.of(4, 5, 6), corners: Int32Array.of(3, 4, 10), nodeLike: Int32Array.of(5), faceLike: Int32Array.of(3), groupBegin: Int32Array.of(8), groupNames: ['hole_3'] }, warnings: [] };
  assert.deepEqual(withMore(undefined, older), older);
  const { patches, warnings } = withMore(older, newer);
  assert.deepEqual(warnings, ['crosses']);
  assert.deepEqual(patches, { positions: Float64Array.of(1, 2, 3, 4, 5, 6), corners: Int32Array.of(0, 1, 9, 3, 4, 10), nodeLike: Int32Array.of(4, 5), faceLike: Int32Array.of(2, 3), groupBegin: Int32Array.of(7, 8), groupNames: ['hole_0', 'hole_3'] });
});

// A cube of six quads about the origin, its sides all facing outwards.
function cube() {
  const positions = Float64Array.from({ length: 24 }, (_, k) => ((Math.floor(k / 3) >> (k % 3)) & 1 ? 3 : 1));
  const corners = Int32Array.of(0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5);
  return shapeOf({ positions, corners, faceBegin: Int32Array.from({ length: 7 }, (_, f) => 4 * f), boundary: new Uint8Array(8), warnings: [] });
}

test('a cube is drawn with a vertex for each of its 24 corners, and with true normals', () => {
  const shape = cube();
  const places = placesOf(shape, shape.input);
  const vertices = verticesOf(shape.faces, places, shape.edges);
  assert.equal(shape.triangles.length, 36);
  assert.equal(vertices.nodes.length, 24);
  assert.equal(vertices.features.length, 24);
  const normals = new Float32Array(72);
  setNormals(normals, shape.faces.nodes, shape.sides, vertices, places);
  for (let v = 0; v < 24; ++v) {
    const normal = [...normals.subarray(3 * v, 3 * v + 3)];
    assert.equal(normal.filter((part) => part !== 0).length, 1);
    const axis = normal.findIndex((part) => part !== 0);
    assert.equal(Math.sign(normal[axis]), Math.sign(places[3 * vertices.nodes[v] + axis]));
  }
  assert.equal(verticesOf(shape.faces, places, shape.edges, 100).nodes.length, 8, 'one for each node where nothing is sharp');
});

test('picks the nearest node that nothing hides', () => {
  const shape = cube();
  const matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0.1, 0, -1, 0, 0, 0, 0, 1];  // from above, a little from the side
  const seen = { places: placesOf(shape, shape.input), triangles: shape.triangles, matrix, width: 200, height: 200 };
  const [x, y, z] = seen.places.subarray(12, 15);
  const at = [100 * (1 + x + 0.1 * z), 100 * (1 - y)];
  assert.ok(z > 0);
  assert.equal(pick(seen, ...at, 3, () => false), 4);
  const [hx, hy, hz] = seen.places.subarray(0, 3);
  assert.ok(hz < 0);
  const below = [100 * (1 + hx + 0.1 * hz), 100 * (1 - hy)];
  assert.equal(pick(seen, ...below, 3, () => false), 0, 'seen beside the upper side');
  assert.equal(pick(seen, below[0] + 11.6, below[1], 12, (node) => node === 4), 4);
  const [fx, fy, fz] = seen.places.subarray(3, 6);
  assert.equal(pick(seen, 100 * (1 + fx + 0.1 * fz), 100 * (1 - fy), 3, () => false), -1, 'under the upper side');
  assert.equal(pick(seen, 100, 100, 3, () => false), -1);
});

test('a boundary loop is picked from one of its nodes', () => {
  // A square with a triangle beside it.
  const shape = shapeOf({ positions: new Float64Array(21), corners: Int32Array.of(0, 1, 2, 3, 4, 5, 6), faceBegin: Int32Array.of(0, 4, 7),
    boundary: new Uint8Array(7).fill(1), warnings: [] });
  assert.deepEqual([...withLoops(shape, [5])].sort(), [4, 5, 6]);
  assert.deepEqual([...withLoops(shape, [0, 4])].length, 7);
});

test('a long way is made in steps, shorter ones where they take many iterations, and ends where the pointer is', () => {
  const pull = new Pull('position', [7], (way) => Float64Array.of(0.1, 0.2, 0.3).map((place, k) => place + way[k % 3]), 1);
  pull.aim([1 / 3, 0, 0], 5);
  const lengths = [];
  for (let from = 0.1, steps = 0; !pull.arrived && steps < 100; ++steps) {
    const drag = pull.step();
    lengths.push(drag.vectors[0] - from);
    from = drag.vectors[0];
    pull.solved(drag, steps < 3 ? 20 : 5);
    assert.equal(drag.time, pull.arrived ? 5 : -Infinity);
  }
  assert.ok(Math.abs(lengths[0] - 0.02) < 1e-12);
  assert.ok(Math.abs(lengths[2] - 0.005) < 1e-12);
  assert.ok(lengths.length < 12, 'steps grow again');
  assert.deepEqual([...pull.step().vectors], [0.1 + 1 / 3, 0.2, 0.3]);
  assert.deepEqual([...pull.vectors], [0.1 + 1 / 3, 0.2, 0.3]);
});

test('a picture is ahead of the library as its last shapes went, and not too far', async () => {
  const { Ahead } = await compiled('pull/ahead');
  // Two nodes: one is dragged, the other goes half as far, turned by a right angle, and a little up.
  const shape = ([x, y, z]) => Float64Array.of(x, y, z, -y / 2, x / 2, z + 0.1 * (x * x + y * y));
  const near = (a, b, within) => a.forEach((part, k) => assert.ok(Math.abs(part - b[k]) < within, `${[...a]} is not ${[...b]}`));
  assert.equal(new Ahead(null).at([1, 0, 0]), null);
  const ahead = new Ahead(shape([0, 0, 0]));
  near(ahead.at([0.1, 0, 0]), shape([0, 0, 0]), 1e-12);
  ahead.add([0.1, 0, 0], Float64Array.of(0.1, 0, 0, 0, 0, 0), true);
  near(ahead.at([0.2, 0, 0]), [0.2, 0, 0, 0, 0, 0], 1e-12);
  ahead.add([0.1, 0, 0], shape([0.1, 0, 0]), false);
  near(ahead.at([0.2, 0, 0]), shape([0.2, 0, 0]), 0.003);
  near(ahead.at([0.1, 0.1, 0]), shape([0.1, 0, 0]), 1e-12);  // nothing is known of that direction
  ahead.add([0.2, 0.1, 0], shape([0.2, 0.1, 0]), false);
  near(ahead.at([0.25, 0.2, 0]), shape([0.25, 0.2, 0]), 0.01);
  const far = ahead.at([100, 50, 0]);
  assert.ok(Math.hypot(far[0], far[1]) < 3, 'no further than what is known allows');
});

test('a drag of many nodes shows what is foreseen, then what is solved, both moved on to the pointer; one of few waits', async () => {
  const { Drags } = await compiled('pull/drags');
  globalThis.requestAnimationFrame ??= (call) => setTimeout(call);
  const start = Float64Array.of(0, 0, 0, 5, 0, 0);
  const at = (x) => Float64Array.of(x, 0, 0, 5 + x / 2, 0, 0);
  for (const movingNodes of [50_000, 2000]) {
    const asked = [];
    let shown = 0;
    const editor = {
      picked: new Set([0]), busy: false, result: start, report: { movingNodes }, shape: { curve: null, scale: 0.01 }, isDraggable: () => true,
      placeOf: () => [0, 0, 0], leaveTrial() {}, dragBegun() {}, nearby: () => null, showDrag() { ++shown; },
    };
    const drags = new Drags(editor, { push: ({ drag }) => asked.push(drag) });
    drags.begin('position', 0, 0);
    drags.by([0.1, 0, 0], 1);
    if (movingNodes === 2000) {
      assert.deepEqual([asked.length, drags.shape, shown], [1, null, 0]);
      continue;
    }
    assert.deepEqual(asked.map(({ rough, way }) => [rough ?? false, way[0]]), [[true, 0.1], [false, 0.1]]);
    assert.deepEqual(drags.shape, start, 'nothing is known yet');
    drags.solved(asked[0], { positions: Float64Array.of(0.1, 0, 0, 5.04, 0, 0), report: { outcome: 'foreseen' } });
    drags.by([0.2, 0, 0], 2);
    assert.ok(Math.abs(drags.shape[0] - 0.2) < 1e-12 && Math.abs(drags.shape[3] - 5.08) < 1e-12, `${drags.shape}`);
    drags.solved(asked[1], { positions: at(0.1), report: { outcome: 'converged', iterations: 3, seconds: 0.4 } });
    assert.ok(Math.abs(drags.shape[3] - 5.1) < 1e-12, `${drags.shape}`);
    assert.ok(shown > 0);
    drags.drop();
    assert.equal(drags.shape, null);
  }
});

test('a frame counts if its shape is of a place at most 100 ms old', () => {
  const frames = new FrameCounter();
  frames.start(1000);
  frames.solved(1000);
  frames.drawn(1050);
  frames.drawn(1060);
  frames.solved(1000);
  frames.drawn(1200);
  frames.solved(1400);
  frames.drawn(1500);
  assert.deepEqual(frames.perSecond(1500), [4, 8]);
});

// A grid of so many squares along each side, in the plane, as two triangles each.
function grid(side) {
  const node = (i, j) => i * (side + 1) + j;
  const positions = new Float64Array(3 * (side + 1) ** 2);
  const corners = [];
  for (let i = 0; i <= side; ++i) for (let j = 0; j <= side; ++j) positions.set([i / side, j / side, 0], 3 * node(i, j));
  for (let i = 0; i < side; ++i) for (let j = 0; j < side; ++j) corners.push(node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j), node(i + 1, j + 1), node(i, j + 1));
  const faceBegin = Int32Array.from({ length: corners.length / 3 + 1 }, (_, f) => 3 * f);
  return shapeOf({ positions, corners: Int32Array.from(corners), faceBegin, boundary: new Uint8Array(positions.length / 3), warnings: [] });
}

test('a picture of a drag has fewer triangles, even ones though the surface is flat, the same boundary and the same normals', async () => {
  const { loadSimplifier, simplified } = await compiled('view/simplify');
  const shape = grid(60);
  const places = placesOf(shape, shape.input);
  const vertices = verticesOf(shape.faces, places, shape.edges);
  const triangles = shape.triangleCorners.map((corner) => vertices.corners[corner]);
  assert.equal(simplified(triangles, places, 1800), null, 'not loaded yet');
  await loadSimplifier();
  const fewer = simplified(triangles, places, 1800);
  assert.ok(fewer.length <= 3 * 1800 && fewer.length > 3 * 1500, `${fewer.length / 3} triangles`);
  let area = 0;
  for (let t = 0; t < fewer.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => [...places.subarray(3 * fewer[t + k], 3 * fewer[t + k] + 2)]);
    const twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    assert.ok(twice > 0, 'none is turned over');
    assert.ok(Math.hypot(a[0] - b[0], a[1] - b[1]) < 0.15, 'none is long');
    area += twice / 2;
  }
  assert.ok(Math.abs(area - 0.5) < 1e-5, 'of a square whose diagonal is one');
  const part = partOf(fewer, vertices);
  assert.ok(part.vertices.length < vertices.nodes.length / 2);
  for (let k = 2; k < places.length; k += 3) places[k] = 0.2 * Math.sin(7 * places[k - 1]);
  const [all, some] = [new Float32Array(places.length), new Float32Array(places.length).fill(9)];
  setNormals(all, shape.faces.nodes, shape.sides, vertices, places);
  setNormals(some, shape.faces.nodes, shape.sides, vertices, places, part);
  for (const vertex of part.vertices) assert.deepEqual(some.subarray(3 * vertex, 3 * vertex + 3), all.subarray(3 * vertex, 3 * vertex + 3));
});
