// The library in WebAssembly under random sequences of calls, good ones and wrong ones: each returns or throws an Error
// with one line, and nothing that is held or open is lost by one that throws. SEQUENCES=N tries so many, from SEED.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { drawFrom } from './draw.mjs';
import { load } from './support.mjs';

const sequences = Number(process.env.SEQUENCES ?? 150);
const firstSeed = Number(process.env.SEED ?? 1);

const odd = [NaN, Infinity, -Infinity, 1e300, -1e-300, 0, -0, 1e150];

function number(draw) {
  return draw.below(12) === 0 ? draw.one(...odd) : 2 * draw.share() - 1;
}

const numbers = (draw, count) => Array.from({ length: count }, () => number(draw));

function surfaceText(draw) {
  const [columns, rows] = [1 + draw.below(6), 1 + draw.below(6)];
  const lines = [];
  for (let row = 0; row <= rows; ++row) for (let column = 0; column <= columns; ++column) lines.push(`v ${column} ${row} ${0.3 * draw.share()}`);
  const at = (row, column) => row * (columns + 1) + column + 1;
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      if (draw.below(12) === 0) continue;
      lines.push(`f ${at(row, column)} ${at(row, column + 1)} ${at(row + 1, column + 1)} ${at(row + 1, column)}`);
    }
  }
  if (draw.below(6) === 0) lines.push(`f 1 2 ${draw.one(1, 3, 900, 'x')}`);
  return lines.join('\n');
}

function curveText(draw) {
  return Array.from({ length: 1 + draw.below(30) }, (_, k) => `${k},${draw.share()}${draw.below(60) === 0 ? ',zero' : ''}`).join('\n');
}

function rulesText(draw) {
  const nodes = () => draw.one('"boundary"', '"all"', '"interior"', `[${draw.below(20)}]`, `[${draw.below(20)}, ${draw.below(60)}]`, '{"region": "sphere:1,1,0,1.5"}', '["x"]');
  const place = () => draw.one('"fixed"', '"free"', `[${numbers(draw, 3).map((part) => (Number.isFinite(part) ? part : 0))}]`, '[1]', '7');
  const sharp = () => draw.one('true', '"path"', '"path"', '1');
  const rule = () => (draw.below(5) === 0 ? `{"nodes": ${nodes()}, "sharp": ${sharp()}}` : placed());
  const placed = () => `{"nodes": ${nodes()}, "${draw.one('position', 'position', 'normal', 'tangent')}": ${place()}}`;
  const usual = '{"nodes": "boundary", "position": "fixed"}';
  if (draw.below(10) === 0) return draw.one('', '{', '[]', '{"rules": 3}', '['.repeat(2000));
  return `{"rules": [${[usual, ...Array.from({ length: draw.below(4) }, rule)].join(', ')}]}`;
}

const bytesOf = (text) => new TextEncoder().encode(text);

// One call on a shape, or on what it is drawn towards.
function call(draw, core, shape, isSurface) {
  const count = shape.nodeCount();
  const node = draw.below(20) === 0 ? draw.one(-1, count, 2 ** 31 - 1) : draw.below(Math.max(1, count));
  const positions = () => Float64Array.from(draw.below(4) === 0 ? numbers(draw, draw.below(3 * count + 2)) : shape.positions());
  const progress = () => draw.one(null, undefined, () => false, (fraction) => fraction > 0.3, () => true);
  const points = (use) => {
    const cloud = draw.below(3) === 0 ? core.Points.at(positions()) : new core.Points(bytesOf(`0 0 0\n1 ${draw.share()} ${draw.one('0', '1', 'x')}\n`), 'p.xyz');
    try {
      return use(cloud);
    } finally {
      cloud.delete();
    }
  };
  const settings = () => ({ [draw.one('within', 'rms', 'weight', 'smoothingLength', 'nothing')]: draw.one(0, -1, NaN, 0.01, 0.1, 1), outliers: draw.one(undefined, 0, 0.1, 2), keep: draw.one(true, false) });
  const common = [
    () => shape.setRules(rulesText(draw)), () => shape.holdPosition(node, ...numbers(draw, 3)), () => shape.freePosition(node),
    () => shape.fair(progress()), () => shape.fair(null), () => shape.update(progress()), () => shape.update(null), () => points((cloud) => shape.fit(cloud, settings(), progress())),
    () => shape.setSymmetry(draw.one('', 'x', 'y', 'z=0.5', 'x=1', 'w', 'plane:1,1,0,1,0,0')),
    () => shape.region(Int32Array.of(node, draw.below(count + 1)), positions()), () => shape.noise(), () => shape.setPositions(positions()),
    () => shape.write(draw.one('out.obj', 'out.ply', 'out.off', 'out.stl', 'out.csv', 'out.svg', 'out.xyz', 'out', '', '-', '/', '..', 'no/such.obj', '\0.obj')),
  ];
  const others = isSurface
    ? [() => shape.holdNormal(node, ...numbers(draw, 3)), () => shape.freeNormal(node), () => shape.setFairBoundary(draw.one(true, false)), () => shape.heldNormals(),
      () => shape.setSharpEdges([node, draw.below(count + 1), ...draw.one([], [0, 1], [1, 2, 3])]), () => shape.setSharpEdges(shape.findSharpEdges(draw.one(-1, 10, 30, 400), draw.one(0, 0.01, NaN)).edges),
      () => shape.sharpEdges(), () => shape.markedEdges(),
      () => shape.fill({ at: draw.one(undefined, undefined, [node]), outerRims: draw.one(true, false), maxEdges: draw.one(undefined, 0, 4, 30), flat: draw.one(true, false) }, progress()),
      () => shape.setPatches(draw.one(null, shape.patches())), () => shape.predict(), () => shape.curvatures(positions())]
    : [() => shape.holdTangent(node, ...numbers(draw, 3)), () => shape.freeTangent(node), () => shape.heldTangents(), () => shape.resample(draw.one(-1, 0, 1, 2, 5, 40)),
      () => core.Curve.through(positions(), draw.one(true, false)).delete()];
  draw.one(...common, ...others)();
}

// What the call refuses has to be an Error of the library's own or a TypeError of the wrong kind of argument, not one of a broken program.
function attempt(what, action) {
  try {
    return action();
  } catch (error) {
    const told = error instanceof Error && typeof error.message === 'string' && !(error instanceof WebAssembly.RuntimeError);
    assert.ok(told, `${what}: ${error?.stack ?? error}`);
    assert.doesNotMatch(error.message, /\n|abort|out of bounds|unreachable|null function|bad_alloc/i, what);
    return null;
  }
}

function sequence(core, seed) {
  const draw = drawFrom(seed);
  const isSurface = draw.below(2) === 0;
  const what = `SEED=${seed} SEQUENCES=1`;
  const shape = attempt(what, () => (isSurface ? new core.Surface(bytesOf(surfaceText(draw)), 'a.obj') : new core.Curve(bytesOf(curveText(draw)), 'a.csv')));
  if (!shape) return 0;
  let calls = 0;
  for (let left = 1 + draw.below(10); left > 0; --left) {
    attempt(what, () => call(draw, core, shape, isSurface));
    ++calls;
    assert.equal(shape.positions().length, 3 * shape.nodeCount(), what);
  }
  // Whatever has been done, a shape of sound places can still be held and faired.
  attempt(what, () => {
    shape.setRules('{"rules": [{"nodes": "all", "position": "fixed"}]}');
    shape.fair(null);
  });
  shape.delete();
  return calls;
}

test('any sequence of calls returns or is refused in a line', async () => {
  const core = await load('vspring_core', { print: () => {}, printErr: () => {} });
  let calls = 0;
  for (let seed = firstSeed; seed < firstSeed + sequences; ++seed) calls += sequence(core, seed);
  assert.ok(sequences < 100 || calls > 2 * sequences, `${calls} calls`);
  if (sequences > 1000) console.log(`${sequences} sequences, ${calls} calls`);
});
