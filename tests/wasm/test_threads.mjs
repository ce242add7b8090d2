// The library in WebAssembly with threads: the same bits as without them.

import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { load, native, rules } from './support.mjs';

const numbers = [1, 2, 3];
let plain;
let cores;
let folder;

before(async () => {
  plain = await load('vspring_core');
  cores = await Promise.all(numbers.map((threads) => load('vspring_core_threads', { threads })));
  folder = mkdtempSync(join(tmpdir(), 'vspring-'));
});

after(() => {
  for (const core of cores) core.PThread.terminateAllThreads();
  rmSync(folder, { recursive: true });
});

function bytesOf(...options) {
  const path = join(folder, 'generated.ply');
  native('generate', ...options, '-o', path);
  return new Uint8Array(readFileSync(path));
}

function opened(core, bytes) {
  const surface = new core.Surface(bytes, 'shape.ply');
  surface.setRules(rules);
  return surface;
}

// All that a session computes, one call after the other without returning to the event loop in between.
function session(core, bytes) {
  const surface = opened(core, bytes);
  const results = [];
  const solved = (report) => {
    assert.equal(report.outcome, 'converged');
    results.push(surface.positions());
    return report;
  };
  const { threads } = solved(surface.fair(null));
  const node = surface.boundary().indexOf(1);
  const place = surface.positions().slice(3 * node, 3 * node + 3);
  for (let step = 1; step <= 3; ++step) {
    surface.holdPosition(node, place[0], place[1], place[2] + 0.001 * step);
    solved(surface.update(null));
  }
  for (let again = 0; again < 3; ++again) solved(surface.fair(null));
  const { k1, k2 } = surface.curvatures(surface.positions());
  results.push(k1, k2, surface.write('fair.ply'));
  const points = new core.Points(new TextEncoder().encode('0.5 0.5 0.1\n0.6 0.4 0.1\n0.4 0.6 0.12\n'), 'points.xyz');
  const fitted = surface.fit(points, { weight: 0.05 }, null);
  results.push(surface.positions(), fitted.distances);
  points.delete();
  surface.delete();
  return { threads, results };
}

test('gives the same bits on any number of threads, and without', () => {
  const bytes = bytesOf('annulus', '--nodes', '9000', '--noise', '0.01');
  const expected = session(plain, bytes);
  assert.equal(expected.threads, 1);
  cores.forEach((core, k) => {
    const { threads, results } = session(core, bytes);
    assert.equal(threads, numbers[k]);
    assert.equal(core.PThread.runningWorkers.length, numbers[k] - 1, 'all are at work, and none has been started twice');
    results.forEach((result, part) => assert.deepEqual(result, expected.results[part], `part ${part} on ${threads} threads`));
  });
});

test('arrays are copies that may be handed to others, where memory has grown too', () => {
  const core = cores[1];
  const before = core.HEAPU8.length;
  const surface = opened(core, bytesOf('annulus', '--nodes', '60000'));
  assert.equal(surface.fair(null).outcome, 'converged');
  const positions = surface.positions();
  assert.ok(core.HEAPU8.length > before);
  for (const array of [positions, surface.boundary(), surface.corners(), surface.curvatures(positions).k1, surface.write('fair.ply')])
    assert.ok(array.buffer instanceof ArrayBuffer);
  assert.deepEqual(structuredClone(positions, { transfer: [positions.buffer] }).length, 180_000);
  surface.delete();
});

test('ends soon when asked to, refuses in the words of the program, and goes on', () => {
  const core = cores[1];
  const surface = opened(core, bytesOf('annulus', '--nodes', '6000', '--noise', '0.02'));
  assert.equal(surface.fair((fraction) => fraction > 0).outcome, 'cancelled');
  assert.throws(() => new core.Surface(new TextEncoder().encode('v 0 0 0\nv 1 0 zero\n'), 'bad.obj'), /bad\.obj:2: .*zero/);
  surface.setRules('{"rules": []}');
  assert.throws(() => surface.fair(null), /nothing holds the component/);
  surface.setRules(rules);
  assert.equal(surface.fair(null).outcome, 'converged');
  surface.delete();
});

test('more threads than there are do no harm', () => {
  const core = cores[1];
  const surface = opened(core, bytesOf('annulus', '--nodes', '6000'));
  surface.fair(null);
  const expected = surface.positions();
  core.threads = 5;
  surface.fair(null);
  core.threads = 2;
  assert.deepEqual(surface.positions(), expected);
  surface.delete();
});
