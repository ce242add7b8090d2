// The library in WebAssembly against the native program: the same files, constraints and results.

import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openSphere } from './shapes.mjs';
import { load, native, root, rules } from './support.mjs';

let core;
let folder;

before(async () => {
  core = await load('vspring_core');
  folder = mkdtempSync(join(tmpdir(), 'vspring-'));
  writeFileSync(join(folder, 'rules.json'), rules);
});

after(() => rmSync(folder, { recursive: true }));

function generated(name, ...options) {
  const path = join(folder, name);
  native('generate', ...options, '-o', path);
  return path;
}

function opened(path, name) {
  const surface = new core.Surface(new Uint8Array(readFileSync(path)), name);
  surface.setRules(rules);
  return surface;
}

function greatestDistance(a, b) {
  assert.equal(a.length, b.length);
  let greatest = 0;
  for (let i = 0; i < a.length; i += 3) greatest = Math.max(greatest, Math.hypot(a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]));
  return greatest;
}

function diagonal(positions) {
  let square = 0;
  for (let axis = 0; axis < 3; ++axis) {
    let [least, most] = [Infinity, -Infinity];
    for (let i = axis; i < positions.length; i += 3) {
      least = Math.min(least, positions[i]);
      most = Math.max(most, positions[i]);
    }
    square += (most - least) ** 2;
  }
  return Math.sqrt(square);
}

function nodeOfBoundary(surface) {
  return surface.boundary().indexOf(1);
}

test('is the version of the native program', () => {
  assert.match(native('--version'), new RegExp(core.version().replaceAll('.', '\\.')));
});

for (const [what, ...options] of [
  ['annulus.obj', 'annulus', '--nodes', '900', '--noise', '0.02'],
  ['saddle.ply', 'saddle', '--columns', '20', '--rows', '20', '--faces', 'mixed', '--jitter', '0.3'],
]) {
  test(`fairs ${what} as the native program does`, () => {
    const path = generated(what, ...options);
    const fair = join(folder, `fair-${what}`);
    native('fair', path, '-o', fair, '--constraints', join(folder, 'rules.json'), '--report', join(folder, 'report.json'), '--quiet');
    const expected = JSON.parse(readFileSync(join(folder, 'report.json'), 'utf8'));
    const surface = opened(path, what);
    const report = surface.fair(null);
    assert.deepEqual([report.outcome, report.usable], ['converged', true]);
    assert.equal(expected.outcome, 'converged');
    assert.equal(report.movingNodes, expected.moving_nodes);
    const result = opened(fair, what);
    const size = diagonal(result.positions());
    const error = 3 * (report.expectedError + expected.expected_error);
    assert.ok(greatestDistance(surface.positions(), result.positions()) < error * size);
    assert.ok(greatestDistance(surface.positions(), opened(path, what).positions()) > 10 * error * size, 'something moved');

    const written = join(folder, `written-${what}`);
    writeFileSync(written, surface.write(what));
    assert.ok(greatestDistance(opened(written, what).positions(), surface.positions()) < 1e-6 * size);
    surface.delete();
    result.delete();
  });
}

test('follows a node that is dragged, and memory does not grow', () => {
  const surface = opened(generated('drag.obj', 'annulus', '--nodes', '2000'), 'drag.obj');
  surface.fair(null);
  const node = nodeOfBoundary(surface);
  const start = surface.positions().slice(3 * node, 3 * node + 3);
  let memory = 0;
  for (let step = 0; step < 60; ++step) {
    const height = start[2] + 0.002 * (step % 2);
    surface.holdPosition(node, start[0], start[1], height);
    const report = surface.update(null);
    assert.equal(report.outcome, 'converged');
    assert.ok(report.iterations < 12, `${report.iterations} iterations`);
    assert.equal(surface.positions()[3 * node + 2], height);
    if (step === 9) memory = core.HEAPU8.length;
  }
  assert.equal(core.HEAPU8.length, memory);
  surface.delete();
});

test('foresees about where a drag leads, and stays where it is', () => {
  const surface = opened(generated('ahead.obj', 'annulus', '--nodes', '2000'), 'ahead.obj');
  assert.equal(surface.predict(), null);
  surface.fair(null);
  const before = surface.positions();
  const rim = [...surface.boundary().keys()].filter((node) => surface.boundary()[node] && Math.hypot(before[3 * node], before[3 * node + 1]) < 0.5);
  for (const node of rim) surface.holdPosition(node, before[3 * node] + 0.01, before[3 * node + 1], before[3 * node + 2] + 0.02);
  const foreseen = surface.predict();
  assert.deepEqual(surface.positions(), before);
  surface.update(null);
  const after = surface.positions();
  assert.ok(greatestDistance(foreseen, after) < 0.3 * greatestDistance(before, after), `${greatestDistance(foreseen, after)}`);
  surface.delete();
});

test('what holds a region is what --region holds, and curvatures are those of --scalars', () => {
  const path = generated('saddle.ply', 'saddle', '--columns', '14', '--rows', '14', '--noise', '0.01');
  const surface = opened(path, 'saddle.ply');
  const nodes = Int32Array.of(80, 81, 82, 94, 95, 96, 108, 109, 110, 111);
  const { fixed, rim } = surface.region(nodes, surface.positions());
  // With faces all round, normals of the rim follow from these.
  assert.equal(rim.length, 0);
  native('measure', path, '--report', join(folder, 'measured.json'));
  const { noise: deviation } = JSON.parse(readFileSync(join(folder, 'measured.json'), 'utf8')).figures;
  assert.ok(Math.abs(surface.noise() - deviation) < 1e-6 * deviation, `${surface.noise()}`);
  surface.setRules(JSON.stringify({ rules: [...JSON.parse(rules).rules, { nodes: [...fixed], position: 'fixed' }] }));
  surface.fair(null);
  writeFileSync(join(folder, 'region.json'), JSON.stringify([...nodes]));
  const fair = join(folder, 'region.ply');
  native('fair', path, '-o', fair, '--constraints', join(folder, 'rules.json'), '--region', join(folder, 'region.json'), '--quiet');
  const expected = opened(fair, 'saddle.ply');
  assert.ok(greatestDistance(surface.positions(), expected.positions()) < 1e-6);
  assert.ok(greatestDistance(surface.positions(), opened(path, 'saddle.ply').positions()) > 1e-3);
  assert.throws(() => surface.region(Int32Array.of(-1), surface.positions()), /node -1 does not exist/);

  const scalars = join(folder, 'scalars.vtp');
  native('measure', fair, '--scalars', scalars);
  const text = readFileSync(scalars, 'utf8');
  const { k1, k2 } = surface.curvatures(expected.positions());
  for (const [name, values] of [['principal_curvature_1', k1], ['principal_curvature_2', k2]]) {
    const theirs = text.match(new RegExp(`Name="${name}"[^>]*>([^<]*)<`))[1].trim().split(/\s+/).map(Number);
    assert.equal(theirs.length, values.length);
    theirs.forEach((value, k) => assert.ok(Math.abs(value - values[k]) < 1e-6, `${name} of node ${k}: ${value}, ${values[k]}`));
  }
  for (const one of [surface, expected]) one.delete();
});

test('says which normals are held, estimated ones too', () => {
  const surface = opened(generated('held.obj', 'annulus', '--nodes', '400'), 'held.obj');
  const rim = [...surface.boundary().keys()].filter((node) => surface.boundary()[node]);
  surface.holdNormal(rim[1], 3, 0, 4);
  const { nodes, normals } = surface.heldNormals();
  assert.deepEqual([...nodes], rim);
  const normal = (node) => normals.subarray(3 * nodes.indexOf(node), 3 * nodes.indexOf(node) + 3);
  [0.6, 0, 0.8].forEach((part, i) => assert.ok(Math.abs(normal(rim[1])[i] - part) < 1e-15));
  assert.ok(Math.abs(Math.hypot(...normal(rim[0])) - 1) < 1e-12);
  surface.freeNormal(rim[1]);
  assert.equal(surface.heldNormals().nodes.length, rim.length - 1);
  surface.delete();
});

// Two planes, which meet at y = 0.5, with bumps inside and a line along the edge.
function roof(cells) {
  const at = (x, y) => (cells + 1) * y + x + 1;
  const grid = (count, one) => Array.from({ length: count * count }, (_, k) => one(k % count, Math.floor(k / count)));
  const bump = (x, y) => 0.005 * (x % cells && y % cells && 2 * y !== cells ? ((x * 7 + y * 3) % 5) - 2 : 0);
  const nodes = grid(cells + 1, (x, y) => `v ${x / cells} ${y / cells} ${-Math.abs(y / cells - 0.5) + bump(x, y)}`);
  const faces = grid(cells, (x, y) => `f ${at(x, y)} ${at(x + 1, y)} ${at(x + 1, y + 1)} ${at(x, y + 1)}`);
  return [...nodes, ...faces, `l ${Array.from({ length: cells + 1 }, (_, x) => at(x, cells / 2)).join(' ')}`].join('\n') + '\n';
}

test('sharp edges are found, marked, named by rules and kept, as by the native program', () => {
  const path = join(folder, 'roof.obj');
  writeFileSync(path, roof(12));
  const fair = join(folder, 'fair-roof.obj');
  native('fair', path, '-o', fair, '--sharp', '50', '--quiet');
  const expected = opened(fair, 'roof.obj');
  const held = { nodes: 'boundary', position: 'fixed' };
  const surface = opened(path, 'roof.obj');
  surface.setRules(JSON.stringify({ rules: [held] }));
  const { edges, ...found } = surface.findSharpEdges(50, 0);
  assert.equal(edges.length, 24);
  assert.deepEqual([[...found.chainBegin], [...found.closed], [...found.corners]], [[0, 13], [0], []]);
  assert.deepEqual(new Set(found.chainNodes), new Set(edges));
  assert.deepEqual(surface.markedEdges(), edges);
  assert.equal(surface.findSharpEdges(100, 0).edges.length, 0);
  assert.equal(surface.sharpEdges().length, 0);
  surface.fair(null);
  const off = () => greatestDistance(surface.positions(), expected.positions());
  assert.ok(off() > 0.01);
  surface.setSharpEdges(edges);
  assert.equal(surface.fair(null).outcome, 'converged');
  assert.ok(off() < 1e-4, `${off()}`);
  const node = edges[1] + 30;
  surface.holdPosition(node, ...surface.positions().slice(3 * node, 3 * node + 3).map((part) => part + 0.01));
  assert.equal(surface.update(null).outcome, 'converged');
  assert.equal(surface.predict(), null);
  const ridge = surface.positions().slice(3 * edges[1], 3 * edges[1] + 3);
  assert.deepEqual(ridge, opened(path, 'roof.obj').positions().slice(3 * edges[1], 3 * edges[1] + 3));

  surface.setSharpEdges([]);
  surface.setRules(JSON.stringify({ rules: [held, { nodes: [...found.chainNodes], sharp: 'path' }] }));
  assert.deepEqual(surface.sharpEdges(), edges);
  surface.fair(null);
  assert.ok(off() < 1e-4, `${off()}`);
  surface.setRules(JSON.stringify({ rules: [held] }));
  assert.equal(surface.sharpEdges().length, 0);

  surface.setSharpEdges(edges);
  const points = core.Points.at(opened(path, 'roof.obj').positions().map((part, k) => part + (k % 3 === 2 ? 0.02 : 0)));
  surface.fit(points, { smoothingLength: 0.1 }, null);
  assert.deepEqual(surface.positions().slice(3 * edges[1], 3 * edges[1] + 3), ridge);
  assert.throws(() => surface.setSharpEdges([0, 1]), /sharp edge from node 0 to node 1: it is part of the boundary/);
  assert.throws(() => surface.setSharpEdges([0]), /two nodes each/);
  assert.throws(() => surface.findSharpEdges(200, 0), /less than 180 degrees/);
  assert.deepEqual(surface.sharpEdges(), edges, 'nothing is lost');
  for (const one of [surface, expected, points]) one.delete();
});

test('half a surface or curve is faired and fitted as the native program does', () => {
  const path = join(folder, 'half.obj');
  const lines = roof(8).split('\n').filter((line) => !line.startsWith('l'));
  writeFileSync(path, lines.join('\n'));
  const surface = opened(path, 'half.obj');
  const found = surface.setSymmetry('x');
  assert.deepEqual([found.isHalf, found.onPlane, found.pairs, found.partner.length], [true, 9, 72, 153]);
  surface.setRules(rules);
  for (const [settings, ...options] of [[null], [{ within: 0.01 }, '--within', '0.01']]) {
    const fair = join(folder, 'fair-half.obj');
    native('fair', path, '-o', fair, '--symmetry', 'x', '--constraints', join(folder, 'rules.json'), '--quiet', ...options);
    const expected = opened(fair, 'half.obj');
    const points = core.Points.at(opened(path, 'half.obj').positions());
    const report = settings ? surface.fit(points, { ...settings, keep: true }, null) : surface.fair(null);
    assert.equal(report.outcome, 'converged');
    assert.ok(greatestDistance(surface.positions(), expected.positions()) < 1e-3, `${greatestDistance(surface.positions(), expected.positions())}`);
    for (let node = 0; node < 81; ++node) if (node % 9 === 0) assert.equal(surface.positions()[3 * node], 0);
    for (const one of [expected, points]) one.delete();
  }
  assert.equal(surface.update(null).outcome, 'converged');
  assert.throws(() => surface.setSymmetry('x=0.2'), /node 0 lies 0.2 beyond the plane/);
  assert.throws(() => surface.setSymmetry('w'), /plane/);
  assert.equal(surface.setSymmetry(''), null);
  surface.delete();

  const arc = join(folder, 'arc.csv');
  writeFileSync(arc, `x,y\n${Array.from({ length: 21 }, (_, k) => `${Math.cos(k * Math.PI / 20)},${k % 20 ? Math.sin(k * Math.PI / 20) + 0.02 * (k % 3) : 0}`).join('\n')}\n`);
  const held = JSON.stringify({ rules: [{ nodes: [5, 15], position: 'fixed' }] });
  writeFileSync(join(folder, 'two.json'), held);
  native('curve', arc, '-o', join(folder, 'fair-arc.csv'), '--symmetry', 'y', '--constraints', join(folder, 'two.json'), '--quiet');
  const curve = new core.Curve(new Uint8Array(readFileSync(arc)), 'arc.csv');
  assert.deepEqual([curve.setSymmetry('y').isHalf, curve.setSymmetry('y').onPlane], [true, 2]);
  curve.setRules(held);
  assert.equal(curve.fair(null).outcome, 'converged');
  const expected = new core.Curve(new Uint8Array(readFileSync(join(folder, 'fair-arc.csv'))), 'fair.csv');
  assert.ok(greatestDistance(curve.positions(), expected.positions()) < 3e-4);
  assert.throws(() => curve.resample(40), /symmetry keeps the nodes/);
  for (const one of [curve, expected]) one.delete();
});

test('fits to points as the native program does', () => {
  const path = generated('fit.obj', 'saddle', '--columns', '12', '--rows', '12');
  const plain = opened(path, 'fit.obj');
  const size = diagonal(plain.positions());
  const at = plain.positions();
  const cloud = join(folder, 'cloud.xyz');
  // off: how far two of the points are off, too.
  const cloudOf = (off) => {
    const height = (k) => at[3 * k + 2] + 0.02 * size * (((k * 7) % 5) / 4 - 0.5) + (k === 30 || k === 110 ? off : 0);
    writeFileSync(cloud, Array.from({ length: at.length / 3 }, (_, k) => `${at[3 * k]} ${at[3 * k + 1]} ${height(k)}`).join('\n'));
    return new core.Points(new Uint8Array(readFileSync(cloud)), 'cloud.xyz');
  };
  for (const [option, settings, value] of [
    ['--smoothing-length', { smoothingLength: 0.1 * size }, 0.1 * size], ['--within', { within: 0.02 * size, outliers: 0.05 }, 0.02 * size],
    ['--rms', { rms: 0.006 * size }, 0.006 * size], ['--weight', { weight: 0.05 }, 0.05],
  ]) {
    const fitted = join(folder, 'fitted.obj');
    const report = join(folder, 'fit.json');
    const points = cloudOf(settings.outliers ? 0.2 * size : 0);
    assert.deepEqual([points.positions().length, points.weighted()], [at.length, false]);
    native('fit', path, '--points', cloud, '-o', fitted, '--constraints', join(folder, 'rules.json'), option, String(value), '--report', report, '--quiet',
      ...(settings.outliers ? ['--outliers', String(settings.outliers)] : []));
    const expected = JSON.parse(readFileSync(report, 'utf8'));
    const result = plain.fit(points, settings, null);
    assert.equal(result.outcome, 'converged');
    const theirs = opened(fitted, 'fitted.obj');
    assert.ok(greatestDistance(plain.positions(), theirs.positions()) < 3e-4 * size, `${option}: ${greatestDistance(plain.positions(), theirs.positions()) / size}`);
    assert.equal(result.fit.outliers, settings.outliers ? 2 : 0);
    assert.equal(result.distances.length, points.positions().length / 3);
    if (!settings.outliers) assert.equal(Math.max(...result.distances), result.fit.greatest);
    assert.ok(expected.outcome === 'converged');
    theirs.delete();
    points.delete();
  }
  const points = cloudOf(0);
  assert.throws(() => plain.fit(points, { smoothingLength: 0 }, null), /smoothing/);
  assert.throws(() => new core.Points(new TextEncoder().encode('0 0 0\n1 2 zero\n'), 'bad.xyz'), /bad\.xyz:2/);
  points.delete();
  plain.delete();
});

// Where there is room for a large block moves up with all that is left behind.
function room() {
  const block = core._malloc(1 << 20);
  core._free(block);
  return [block, core.HEAPU8.length];
}

test('hundreds of shapes that are opened, faired, dragged and deleted leave no memory behind', () => {
  const bytes = new Uint8Array(readFileSync(generated('many.obj', 'annulus', '--nodes', '400', '--noise', '0.02')));
  const once = () => {
    const surface = new core.Surface(bytes, 'many.obj');
    surface.setRules(rules);
    surface.fair(() => false);
    const node = nodeOfBoundary(surface);
    surface.holdPosition(node, ...surface.positions().slice(3 * node, 3 * node + 3).map((part) => part + 0.001));
    surface.update(null);
    surface.write('many.ply');
    surface.delete();
  };
  for (let k = 0; k < 20; ++k) once();
  const before = room();
  for (let k = 0; k < 300; ++k) once();
  assert.deepEqual(room(), before);
});

test('ends soon when asked to, with a shape', () => {
  const surface = opened(generated('cancel.obj', 'annulus', '--nodes', '6000', '--noise', '0.02'), 'cancel.obj');
  const report = surface.fair((fraction) => fraction > 0);
  assert.deepEqual([report.outcome, report.usable], ['cancelled', false]);
  assert.ok(surface.positions().every(Number.isFinite));
  assert.equal(surface.fair(null).outcome, 'converged');
  surface.delete();
});

test('what a call works on is not changed from its progress function', () => {
  const surface = opened(generated('busy.obj', 'annulus', '--nodes', '6000', '--noise', '0.02'), 'busy.obj');
  const free = opened(generated('free.obj', 'annulus', '--nodes', '300'), 'free.obj');
  const points = core.Points.at(surface.positions());
  const settings = { smoothingLength: 0.1 };
  const solvers = [(tell) => surface.fair(tell), (tell) => surface.update(tell), (tell) => surface.fit(points, settings, tell), (tell) => surface.fill({ outerRims: true }, tell)];
  const changes = [() => surface.delete(), () => surface.setRules(rules), () => surface.holdPosition(3000, 0, 0, 0), () => surface.fair(null), () => surface.predict(), () => surface.setPatches(null)];
  for (const solve of solvers) {
    let told = 0;
    solve(() => {
      ++told;
      for (const change of changes) assert.throws(change, /^Error: busy: /);
      assert.equal(surface.positions().length, 18000);
      assert.equal(free.fair(null).outcome, 'converged');
      return told > 3;
    });
    assert.ok(told > 0);
  }
  surface.setPatches(null);
  surface.setRules(rules);
  assert.throws(() => surface.fit(points, settings, () => points.delete()), /^Error: busy: delete/);
  assert.equal(surface.fair(null).outcome, 'converged', 'it is free again');
  for (const shape of [surface, free, points]) shape.delete();
});

test('an error from a progress function ends the call, and leaves nothing behind', () => {
  const surface = opened(generated('throwing.obj', 'annulus', '--nodes', '300', '--noise', '0.02'), 'throwing.obj');
  const once = () => assert.throws(() => surface.fair(() => { throw new RangeError('enough'); }), /^RangeError: enough/);
  for (let k = 0; k < 50; ++k) once();
  const before = room();
  for (let k = 0; k < 500; ++k) once();
  assert.deepEqual(room(), before);
  assert.equal(surface.fair(null).outcome, 'converged');
  surface.delete();
});

test('refuses settings that nothing would hear', () => {
  const surface = opened(generated('settings.obj', 'annulus', '--nodes', '300'), 'settings.obj');
  const curve = core.Curve.through(Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0), true);
  const points = core.Points.at(surface.positions());
  assert.throws(() => surface.fit(points, {}, null), /^Error: one of weight, smoothingLength, within and rms has to be given/);
  assert.throws(() => surface.fit(points, { weight: 1, rms: 1 }, null), /^Error: only one of weight/);
  assert.throws(() => surface.fit(points, { smoothing_length: 0.1 }, null), /settings have no smoothing_length; they have weight, smoothingLength/);
  assert.throws(() => curve.fit(points, { within: 0.1, outlier: 0.1 }, null), /settings have no outlier;/);
  assert.throws(() => surface.fill({ maxsize: 1 }, null), /settings have no maxsize; they have at, outerRims, maxSize/);
  assert.throws(() => curve.span({ lenght: 1 }, null), /settings have no lenght; they have length/);
  assert.throws(() => surface.fill(null, null), /settings are an object/);
  for (const shape of [surface, curve, points]) shape.delete();
});

test('refuses what the native program refuses, in its words', () => {
  const bytes = new TextEncoder().encode('v 0 0 0\nv 1 0 zero\n');
  assert.throws(() => new core.Surface(bytes, 'bad.obj'), /^Error: bad\.obj:2: .*zero/);
  const surface = opened(generated('open.obj', 'annulus', '--nodes', '300'), 'open.obj');
  assert.throws(() => surface.setRules('{"rules": [{"nodes": [5000], "position": "fixed"}]}'), /rule 1.*5000/);
  assert.throws(() => surface.holdPosition(-1, 0, 0, 0), /node -1 does not exist/);
  assert.throws(() => surface.setPositions(new Float64Array(6)), /2 positions given for 300 nodes/);
  assert.throws(() => surface.setPositions(new Float64Array(899)), /899 coordinates/);
  assert.throws(() => core.Curve.through(new Float64Array(7), false), /7 coordinates/);
  assert.throws(() => core.Points.at(new Float64Array(7)), /7 coordinates/);
  assert.equal(surface.fair(null).outcome, 'converged', 'nothing is lost');
  surface.setRules('{"rules": []}');
  assert.throws(() => surface.fair(null), /nothing holds the component/);
  surface.delete();
  assert.throws(() => new core.Points(bytes, 'bad.obj'), /^Error: bad\.obj:2: .*zero/);
  assert.throws(() => new core.Curve(bytes, 'bad.csv'), /^Error: bad\.csv/);
});

test('what is refused leaves nothing behind', () => {
  const bytes = new TextEncoder().encode('v 0 0 0\nv 1 0 zero\n');
  const surface = opened(generated('refusing.obj', 'annulus', '--nodes', '300'), 'refusing.obj');
  const once = () => {
    assert.throws(() => new core.Surface(bytes, 'bad.obj'));
    assert.throws(() => new core.Curve(bytes, 'bad.csv'));
    assert.throws(() => new core.Points(bytes, 'bad.obj'));
    surface.setRules('{"rules": []}');
    assert.throws(() => surface.setRules('{"rules": [{"nodes": [5000], "position": "fixed"}]}'));
    assert.throws(() => surface.holdPosition(-1, 0, 0, 0));
    assert.throws(() => surface.fair(null));
    assert.throws(() => surface.write('part.xyz'));
  };
  for (let k = 0; k < 50; ++k) once();
  const before = room();
  for (let k = 0; k < 2000; ++k) once();
  assert.deepEqual(room(), before);
  surface.delete();
});

function placesOf(curve) {
  const numbers = curve.positions();
  return Array.from({ length: numbers.length / 3 }, (_, node) => [...numbers.subarray(3 * node, 3 * node + 3)]);
}

test('curves: fairs and writes as the native program does, in every format', () => {
  const wave = Array.from({ length: 41 }, (_, k) => `${k / 10},${Math.sin(k / 6) + 0.02 * ((k * 7) % 5)}`).join('\n');
  const path = join(folder, 'wave.csv');
  writeFileSync(path, `x,y\n${wave}\n`);
  const held = JSON.stringify({ rules: [{ nodes: 'boundary', position: 'fixed', tangent: 'fixed' }, { nodes: [20], position: [[2, 1, 0]] }] });
  writeFileSync(join(folder, 'held.json'), held);
  native('curve', path, '-o', join(folder, 'fair.csv'), '--constraints', join(folder, 'held.json'), '--quiet');
  const curve = new core.Curve(new Uint8Array(readFileSync(path)), 'wave.csv');
  assert.deepEqual([curve.nodeCount(), curve.planar(), [...curve.chainBegin()], [...curve.closed()]], [41, true, [0, 41], [0]]);
  assert.deepEqual([...curve.chainNodes()], [...Array(41).keys()]);
  assert.deepEqual([...curve.boundary().keys()].filter((node) => curve.boundary()[node]), [0, 40]);
  curve.setRules(held);
  assert.equal(curve.fair(null).outcome, 'converged');
  const expected = new core.Curve(new Uint8Array(readFileSync(join(folder, 'fair.csv'))), 'fair.csv');
  assert.ok(greatestDistance(curve.positions(), expected.positions()) < 3e-4);
  assert.deepEqual(placesOf(curve)[20], [2, 1, 0]);
  for (const format of ['csv', 'dat', 'obj', 'xyz']) {
    const again = new core.Curve(curve.write(`out.${format}`), `out.${format}`);
    assert.deepEqual(again.positions(), curve.positions());
    again.delete();
  }
  assert.match(new TextDecoder().decode(curve.write('out.svg')), /<svg/);

  const { nodes, tangents } = curve.heldTangents();
  assert.deepEqual([...nodes], [0, 40]);
  assert.ok(Math.abs(Math.hypot(...tangents.subarray(0, 3)) - 1) < 1e-12 && tangents[0] > 0);

  curve.freeTangent(0);
  curve.holdTangent(40, 0, 1, 0);
  curve.holdPosition(20, 2, 2, 0);
  curve.update(null);
  assert.deepEqual(placesOf(curve)[20], [2, 2, 0]);
  const [before, last] = placesOf(curve).slice(-2);
  assert.ok(Math.abs(last[0] - before[0]) < 0.5 * (last[1] - before[1]), `it ends upwards: ${before} to ${last}`);
  curve.freePosition(20);
  assert.throws(() => curve.holdPosition(41, 0, 0, 0), /node 41 does not exist/);
  assert.throws(() => new core.Curve(new TextEncoder().encode('x,y\n1,zero\n'), 'bad.csv'), /bad\.csv:2/);
  curve.delete();
  expected.delete();
});

test('curves: fits to points and to its own nodes as the native program does', () => {
  const [path, cloud, fitted, report] = ['noisy.csv', 'cloud.csv', 'fitted.csv', 'fitted.json'].map((name) => join(folder, name));
  const rows = (count, at) => `x,y\n${Array.from({ length: count }, (_, k) => at(k).join(',')).join('\n')}\n`;
  writeFileSync(path, rows(61, (k) => [k / 10, Math.sin(k / 9) + 0.03 * (((k * 7) % 5) / 4 - 0.5)]));
  writeFileSync(cloud, rows(200, (k) => [0.2 + 0.028 * k, 0.2 + Math.sin((0.2 + 0.028 * k) / 0.9) + 0.05 * (((k * 13) % 7) / 6 - 0.5)]));
  const curve = new core.Curve(new Uint8Array(readFileSync(path)), 'noisy.csv');
  curve.setRules(rules.replaceAll('normal', 'tangent'));
  writeFileSync(join(folder, 'ends.json'), rules.replaceAll('normal', 'tangent'));
  const size = diagonal(curve.positions());
  const points = new core.Points(new Uint8Array(readFileSync(cloud)), 'cloud.csv');
  const own = core.Points.at(curve.positions());
  assert.deepEqual(own.positions(), curve.positions());
  for (const [pull, settings, command] of [
    [points, { smoothingLength: 0.3 }, ['fit', path, '--points', cloud, '--smoothing-length', '0.3']],
    [points, { within: 0.1, outliers: 0.02 }, ['fit', path, '--points', cloud, '--within', '0.1', '--outliers', '0.02']],
    [points, { rms: 0.03 }, ['fit', path, '--points', cloud, '--rms', '0.03']],
    [points, { weight: 0.05 }, ['fit', path, '--points', cloud, '--weight', '0.05']],
    [own, { within: 0.02, keep: true }, ['curve', path, '--within', '0.02']],
    [own, { smoothingLength: 0.2, keep: true }, ['curve', path, '--smoothing-length', '0.2']],
  ]) {
    native(...command, '-o', fitted, '--constraints', join(folder, 'ends.json'), '--report', report, '--quiet');
    const result = curve.fit(pull, settings, null);
    const expected = JSON.parse(readFileSync(report, 'utf8'));
    assert.deepEqual([result.outcome, expected.outcome], ['converged', 'converged'], command.join(' '));
    const theirs = new core.Curve(new Uint8Array(readFileSync(fitted)), 'fitted.csv');
    const error = greatestDistance(curve.positions(), theirs.positions()) / size;
    assert.ok(error < 3e-4, `${command}: ${error}`);
    assert.equal(result.distances.length, pull.positions().length / 3);
    assert.equal(result.fit.outliers, expected.points.outliers);
    assert.ok(settings.outliers ? result.fit.outliers > 0 && result.fit.outliers <= 4 : result.fit.outliers === 0, `${result.fit.outliers}`);
    theirs.delete();
  }
  assert.equal(curve.fit(points, { within: 0.1 }, (fraction) => fraction >= 0).outcome, 'cancelled');
  assert.throws(() => curve.fit(points, { within: 0 }, null), /within/);
  for (const one of [curve, points, own]) one.delete();
});

test('surfaces: fits to its own nodes as the native program does', () => {
  const path = generated('own.obj', 'saddle', '--columns', '12', '--rows', '12', '--noise', '0.02');
  const fitted = join(folder, 'own-fitted.obj');
  native('fair', path, '-o', fitted, '--constraints', join(folder, 'rules.json'), '--smoothing-length', '0.2', '--quiet');
  const [surface, theirs] = [opened(path, 'own.obj'), opened(fitted, 'own.obj')];
  const [own, size] = [core.Points.at(surface.positions()), diagonal(surface.positions())];
  const plain = surface.fair(null) && surface.positions();
  surface.fit(own, { smoothingLength: 0.2, keep: true }, null);
  assert.ok(greatestDistance(surface.positions(), theirs.positions()) < 3e-4 * size);
  assert.ok(greatestDistance(surface.positions(), plain) > 3e-3 * size);
  for (const one of [surface, theirs, own]) one.delete();
});

test('curves: through places that were drawn, with even nodes in between', () => {
  const curve = core.Curve.through(Float64Array.of(0, 0, 0, 4, 0, 0, 4, 4, 0), true);
  assert.ok(curve.planar());
  curve.setRules('{"rules": [{"nodes": "all", "position": "fixed"}]}');
  const from = curve.resample(60);
  assert.deepEqual([...from].filter((node) => node >= 0), [0, 1, 2]);
  assert.equal(curve.nodeCount(), 60);
  const report = curve.fair(null);
  assert.deepEqual([report.outcome, report.movingNodes], ['converged', 57]);
  assert.deepEqual(placesOf(curve)[from.indexOf(1)], [4, 0, 0]);
  assert.throws(() => curve.resample(2), /too few|2 nodes|number of nodes/);
  assert.ok(!core.Curve.through(Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 1), false).planar());
  curve.delete();
});

test('curves: other nodes in place of their own; groups keep what stays', () => {
  const text = 'g rim\nv 0 0 0\nv 1 1 0\nv 2 0 0\nv 3 0 0\nl 1 2 3\ng tail\nl 3 4\n';
  const curve = new core.Curve(new TextEncoder().encode(text), 'line.obj');
  curve.setNodes(Float64Array.of(0, 0, 0, 0.5, 0.6, 0, 2, 0, 0, 3, 0, 0), Int32Array.of(0, 4), Int32Array.of(0, 1, 2, 3), Uint8Array.of(0), Int32Array.of(0, -1, 2, 3));
  assert.deepEqual([curve.nodeCount(), ...curve.chainBegin(), ...curve.boundary()], [4, 0, 4, 1, 0, 0, 1]);
  curve.setRules('{"rules": [{"nodes": {"group": "rim"}, "position": "fixed"}, {"nodes": "boundary", "position": "fixed"}]}');
  const report = curve.fair(null);
  assert.deepEqual([report.outcome, report.movingNodes], ['converged', 1], 'of the group node 1 is gone');
  assert.match(new TextDecoder().decode(curve.write('out.csv')), /^x,y,z\n0,0,0\n.*\n2,0,0\n3,0,0\n$/);
  assert.throws(() => curve.setNodes(Float64Array.of(0, 0, 0), Int32Array.of(0, 2), Int32Array.of(0, 7), Uint8Array.of(0), Int32Array.of(0)), /7/);
  assert.equal(curve.nodeCount(), 4, 'it is as it was');
  curve.delete();
});

test('spans curves as the native program does', () => {
  const path = join(root, 'examples/hull-lines.obj');
  native('span', path, '-o', join(folder, 'hull.obj'), '--symmetry', 'y', '--report', join(folder, 'span.json'), '--quiet');
  const expected = JSON.parse(readFileSync(join(folder, 'span.json'), 'utf8'));
  const curve = new core.Curve(new Uint8Array(readFileSync(path)), 'hull-lines.obj');
  const before = curve.positions();
  const report = curve.span({ symmetry: 'y' }, null);
  assert.deepEqual([report.outcome, report.usable, report.warnings], ['converged', true, []]);
  assert.deepEqual(report.loops.map(({ state, grid, firstFace, faceCount }) => [state, grid, firstFace, faceCount]),
    expected.loops.map((loop) => [loop.state, loop.grid ?? false, loop.first_face ?? -1, loop.faces ?? 0]));
  assert.deepEqual(report.curves.map(({ nodes }) => [...nodes]), expected.curves.map(({ nodes }) => nodes));
  assert.deepEqual(curve.positions(), before);
  const surface = new core.Surface(report.surface, 'span.obj');
  const theirs = opened(join(folder, 'hull.obj'), 'hull.obj');
  assert.deepEqual(surface.corners(), theirs.corners());
  assert.ok(greatestDistance(surface.positions(), theirs.positions()) < 1e-4);
  assert.equal(report.held.length, expected.fixed_positions);
  assert.equal(report.heldNormals.nodes.length, expected.fixed_normals);
  const outer = report.loops.findIndex(({ state }) => state === 'outer');
  assert.equal(curve.span({ without: [1], flat: true }, null).loops[1].state, 'left-out');
  assert.equal(curve.span({ loops: [2], flat: true }, null).loops.filter(({ state }) => state === 'spanned').length, 1);
  assert.throws(() => curve.span({ also: [outer + 100] }, null), /is no loop/);
  assert.throws(() => curve.span({ symmetry: 'w' }, null), /plane "w"/);
  for (const one of [curve, surface, theirs]) one.delete();
});

test('fills holes as the native program does; nodes and faces of the file stay, and it is written with all that it had', () => {
  const { nodes, text } = openSphere();
  const path = join(folder, 'open-sphere.ply');
  writeFileSync(path, text);
  native('fill', path, '-o', join(folder, 'closed.ply'), '--report', join(folder, 'fill.json'), '--quiet');
  const expected = JSON.parse(readFileSync(join(folder, 'fill.json'), 'utf8'));
  const surface = opened(path, 'open-sphere.ply');
  const [before, corners] = [surface.positions(), surface.corners()];
  const report = surface.fill({}, null);
  assert.deepEqual([report.outcome, report.usable, report.warnings], ['converged', true, []]);
  assert.deepEqual(report.holes.map(({ rim, state, firstNode, nodeCount, firstFace, faceCount, outcome, fault }) => [rim.length, state, firstNode, nodeCount, firstFace, faceCount, outcome, fault]),
    expected.holes.map((hole) => [hole.edges, 'filled', hole.first_node, hole.new_nodes, hole.first_face, hole.new_faces, 'converged', '']));
  assert.ok(Math.abs(report.holes[0].length - expected.holes[0].length) < 1e-12);
  assert.deepEqual(surface.positions().subarray(0, before.length), before);
  assert.deepEqual(surface.corners().subarray(0, corners.length), corners);
  assert.equal(surface.boundary().indexOf(1), -1);
  const theirs = opened(join(folder, 'closed.ply'), 'closed.ply');
  assert.ok(greatestDistance(surface.positions(), theirs.positions()) < 1e-4);
  assert.ok(placesOf(surface).every((place) => Math.abs(Math.hypot(...place) - 1) < 1e-4));
  const rows = new TextDecoder().decode(surface.write('closed.ply')).split('end_header\n')[1].split('\n');
  assert.deepEqual(rows.slice(0, nodes.length), nodes);
  const { nodeLike } = surface.patches();
  rows.slice(nodes.length, surface.nodeCount()).forEach((row, k) => assert.equal(row.split(' ')[3], nodes[nodeLike[k]].split(' ')[3]));

  // It goes on as any surface does: the patches alone become fair again.
  const { fixed } = surface.region(Int32Array.from({ length: report.holes[0].nodeCount }, (_, k) => report.holes[0].firstNode + k), surface.positions());
  surface.setRules(JSON.stringify({ rules: [{ nodes: [...fixed], position: 'fixed' }] }));
  const again = surface.fair(null);
  assert.deepEqual([again.outcome, again.movingNodes], ['converged', report.holes[0].nodeCount]);
  for (const one of [surface, theirs]) one.delete();
});

test('fills the holes that are asked for; patches are taken away and given back', () => {
  const { text } = openSphere();
  const open = () => new core.Surface(new TextEncoder().encode(text), 'open-sphere.ply');
  const [surface, other] = [open(), open()];
  const states = (settings) => surface.fill(settings, null).holes.map(({ state }) => state);
  assert.deepEqual(states({ maxEdges: 23 }), ['too-large', 'too-large']);
  assert.deepEqual(states({ maxSize: 1 }), ['too-large', 'too-large']);
  assert.throws(() => surface.fill({ at: [30] }, null), /node 30 is at no hole/);
  assert.throws(() => surface.fill({ at: [] }, null), /no node is named/);
  assert.throws(() => surface.fill({ maxEdges: 2 }, null), /has to be 3 or more/);
  assert.equal(surface.nodeCount(), 13 * 24);
  assert.deepEqual(states({ at: [0] }), ['filled', 'elsewhere']);
  const first = surface.patches();
  assert.deepEqual(states({ flat: true }), ['filled'], 'the other one is left');
  const both = surface.patches();
  assert.ok(both.nodeLike.length > first.nodeLike.length);
  assert.deepEqual(both.groupNames, ['hole_0', 'hole_288']);

  other.setPatches(both);
  assert.deepEqual([other.positions(), other.corners()], [surface.positions(), surface.corners()]);
  assert.deepEqual(other.write('a.obj'), surface.write('a.obj'));
  other.setPatches(null);
  assert.deepEqual(other.write('a.ply'), new TextEncoder().encode(text));
  assert.throws(() => other.setPatches({ ...both, nodeLike: both.nodeLike.map(() => 312) }), /like node 312/);
  assert.throws(() => other.setPatches({ ...both, positions: both.positions.slice(3) }), /positions/);
  assert.throws(() => other.setPatches({ ...both, groupBegin: Int32Array.of(0, 1) }), /begins at face 0/);
  assert.equal(other.nodeCount(), 13 * 24);
  assert.equal(other.fill({}, () => true).outcome, 'cancelled');
  for (const one of [surface, other]) one.delete();
});

test('meets the curvature around a region, as the native program does', () => {
  const path = generated('bent.obj', 'saddle', '--columns', '24', '--rows', '24', '--noise', '0.005');
  const region = [];
  for (let row = 8; row <= 16; ++row) for (let column = 8; column <= 16; ++column) region.push(25 * row + column);
  const free = JSON.stringify({ rules: [{ nodes: 'all', position: 'fixed' }, { nodes: region, position: 'free' }] });
  writeFileSync(join(folder, 'bent.json'), free);
  native('fair', path, '-o', join(folder, 'joined.obj'), '--continuity', 'curvature', '--constraints', join(folder, 'bent.json'), '--quiet');
  const surface = opened(path, 'bent.obj');
  surface.setRules(free);
  surface.fair(null);
  const expected = opened(join(folder, 'joined.obj'), 'joined.obj');
  assert.ok(greatestDistance(surface.positions(), expected.positions()) > 1e-4, 'with tangent planes it is another');
  surface.setContinuity(true);
  assert.equal(surface.fair(null).outcome, 'converged');
  assert.ok(greatestDistance(surface.positions(), expected.positions()) < 1e-6);
  surface.delete();
  expected.delete();
});

test('a region of a curve meets the curvature beside it, as with the native program', () => {
  const path = join(folder, 'waves.csv');
  const bump = (k) => (k > 30 && k < 70 ? 0.02 * Math.sin(k) : 0);
  writeFileSync(path, `x,y\n${Array.from({ length: 101 }, (_, k) => `${0.1 * k},${Math.sin(0.1 * k) + bump(k)}`).join('\n')}\n`);
  const region = Array.from({ length: 39 }, (_, k) => 31 + k);
  const free = JSON.stringify({ rules: [{ nodes: 'all', position: 'fixed' }, { nodes: region, position: 'free' }] });
  writeFileSync(join(folder, 'waves.json'), free);
  native('curve', path, '-o', join(folder, 'met.csv'), '--continuity', 'curvature', '--constraints', join(folder, 'waves.json'), '--quiet');
  const curve = new core.Curve(new Uint8Array(readFileSync(path)), 'waves.csv');
  const expected = new core.Curve(new Uint8Array(readFileSync(join(folder, 'met.csv'))), 'met.csv');
  curve.setRules(free);
  curve.fair(null);
  assert.ok(greatestDistance(curve.positions(), expected.positions()) > 1e-2, 'with tangents it is another');
  curve.setContinuity(true);
  assert.equal(curve.fair(null).outcome, 'converged');
  assert.ok(greatestDistance(curve.positions(), expected.positions()) < 1e-6);
  for (const one of [curve, expected]) one.delete();
});

test('fairs boundary loops first, as the native program does', () => {
  const path = generated('loops.obj', 'saddle', '--columns', '12', '--rows', '12', '--noise', '0.02');
  const held = JSON.stringify({ rules: [{ nodes: [0, 6, 12, 84, 168, 162, 156, 78], position: 'fixed' }] });
  writeFileSync(join(folder, 'loops.json'), held);
  native('fair', path, '-o', join(folder, 'fair-loops.obj'), '--fair-boundary', '--constraints', join(folder, 'loops.json'), '--quiet');
  const surface = opened(path, 'loops.obj');
  surface.setRules(held);
  surface.setFairBoundary(true);
  assert.equal(surface.fair(null).outcome, 'converged');
  const expected = opened(join(folder, 'fair-loops.obj'), 'fair-loops.obj');
  assert.ok(greatestDistance(surface.positions(), expected.positions()) < 2e-4);
  surface.setFairBoundary(false);
  surface.fair(null);
  assert.ok(greatestDistance(surface.positions(), expected.positions()) > 0.01, 'else the boundary is drawn in');
  surface.delete();
  expected.delete();
});
