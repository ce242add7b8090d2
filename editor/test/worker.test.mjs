// The editor's worker under random sequences of messages, good ones and wrong ones: each is answered once, in order, and
// what has been refused leaves the open shape as it was. SEQUENCES=N tries so many, from SEED.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { test } from 'node:test';
import { drawFrom } from '../../tests/wasm/draw.mjs';
import { compiled } from './support.mjs';

const sequences = Number(process.env.SEQUENCES ?? 60);
const firstSeed = Number(process.env.SEED ?? 1);
const library = new URL('../../build/wasm/', import.meta.url);

/** The worker in this thread: what it would hear as messages, and what it answers. */
async function startWorker() {
  const listeners = [];
  const replies = [];
  globalThis.self = { addEventListener: (_, listener, options) => listeners.push({ listener, once: options?.once }) };
  globalThis.postMessage = (reply) => replies.push(reply);
  globalThis.importScripts = () => {
    const core = createRequire(import.meta.url)(new URL('vspring_core.js', library).pathname);
    globalThis.vspringCore = () => core({ wasmBinary: readFileSync(new URL('vspring_core.wasm', library)), print: () => {}, printErr: () => {} });
  };
  await compiled('library/worker');
  const post = (data) => {
    for (const entry of [...listeners]) {
      if (entry.once) listeners.splice(listeners.indexOf(entry), 1);
      entry.listener({ data });
    }
  };
  const ended = new Int32Array(2);
  post({ folder: library.href, ended });
  return {
    ended,
    /** The last reply to a request; others before it only tell how far it has come. */
    async ask(number, kind, ask) {
      replies.length = 0;
      post({ number, kind, ask });
      while (!replies.some((reply) => !('fraction' in reply))) await new Promise((done) => setTimeout(done));
      await new Promise((done) => setTimeout(done));
      assert.ok(replies.every((reply) => reply.number === number), kind);
      assert.equal(replies.filter((reply) => !('fraction' in reply)).length, 1, kind);
      return replies.at(-1);
    },
  };
}

const bytesOf = (text) => new TextEncoder().encode(text);
const held = '{"rules": [{"nodes": "boundary", "position": "fixed"}]}';

function grid(draw) {
  const size = 2 + draw.below(5);
  const lines = [];
  for (let row = 0; row <= size; ++row) for (let column = 0; column <= size; ++column) lines.push(`v ${column} ${row} ${0.3 * draw.share()}`);
  for (let row = 0; row < size; ++row) {
    for (let column = 0; column < size; ++column) {
      const a = row * (size + 1) + column + 1;
      lines.push(`f ${a} ${a + 1} ${a + size + 2} ${a + size + 1}`);
    }
  }
  return lines.join('\n');
}

// patches: as they were made last.
function request(draw, nodes, patches) {
  const wrongly = draw.below(8) === 0;
  const node = wrongly ? draw.one(-1, nodes, 1e9) : draw.below(Math.max(1, nodes));
  const places = (count) => Float64Array.from({ length: 3 * count }, () => (draw.below(20) === 0 ? draw.one(NaN, Infinity, 1e200) : 2 * draw.share()));
  const rules = () => (wrongly ? draw.one('', '[', '{"rules": [{"nodes": [99999], "position": "fixed"}]}', held.replace('fixed', 'loose')) : draw.one(held, '{"rules": [{"nodes": "all", "position": "fixed"}]}', '{"rules": []}'));
  const drag = () => ({ part: draw.one('position', 'normal', 'tangent'), nodes: Int32Array.of(node), vectors: places(1), way: [0, 0, 0.1], time: 0, rough: draw.one(true, false, undefined) });
  const fit = () => draw.one(null, undefined, { points: draw.below(3), kind: draw.one('within', 'rms', 'weight', 'smoothingLength'), value: draw.one(0.1, 1, 0, -1), outliers: 0 });
  switch (draw.one('open', 'draw', 'hold', 'points', 'start', 'region', 'noise', 'fill', 'patches', 'solve', 'solve', 'solve', 'curvatures', 'write')) {
    case 'open':
      return ['open', { name: draw.one('a.obj', 'a.obj', 'a.csv', 'a.ply', 'a', ''), bytes: bytesOf(wrongly ? 'v 0 0 zero' : draw.one(grid(draw), '0,0\n1,1\n2,0\n3,1\n4,0')), rules: rules() }];
    case 'draw':
      return ['draw', { places: places(draw.below(5)), closed: draw.one(true, false), nodes: draw.one(-1, 0, 2, 9, 40) }];
    case 'hold':
      return ['hold', { rules: rules() }];
    case 'points':
      return ['points', { number: draw.below(3), from: draw.one(places(3), { name: 'p.xyz', bytes: draw.one(bytesOf('0 0 0\n1 1 0.2\n'), bytesOf('no points')) }) }];
    case 'start':
      return ['start', draw.one(null, places(wrongly ? nodes + 1 : nodes))];
    case 'region':
      return ['region', { rules: rules(), nodes: Int32Array.of(node), positions: places(wrongly ? nodes + 1 : nodes) }];
    case 'fill':
      return ['fill', { at: draw.one(null, Int32Array.of(node)), positions: places(wrongly ? nodes + 1 : nodes) }];
    case 'patches':
      return ['patches', draw.one(null, patches)];
    case 'noise':
      return ['noise', null];
    case 'solve':
      return ['solve', { rules: draw.one(undefined, rules()), fairBoundary: draw.one(undefined, false, true), fit: fit(), drag: draw.one(undefined, drag()) }];
    case 'curvatures':
      return ['curvatures', { positions: places(nodes) }];
    default:
      return ['write', { name: draw.one('a.obj', 'a.ply', 'a.csv', 'a.stl', '', '/'), positions: places(wrongly ? 1 : nodes) }];
  }
}

// One for all tests: its module runs but once.
const worker = await startWorker();
let number = 0;

test('any sequence of messages is answered, each once, and the shape stays usable', async () => {
  let messages = 0;
  let nodes = 0;
  let patches = null;
  for (let seed = firstSeed; seed < firstSeed + sequences; ++seed) {
    const what = `SEED=${seed} SEQUENCES=1`;
    const draw = drawFrom(seed);
    for (let left = 2 + draw.below(12); left > 0; --left) {
      const [kind, ask] = request(draw, nodes, patches);
      // Now and then the page wants it to end at once.
      worker.ended[draw.below(2)] = draw.below(6) === 0 ? number + 1 : 0;
      const reply = await worker.ask(++number, kind, ask);
      ++messages;
      if ('error' in reply) {
        assert.doesNotMatch(reply.error, /\n|memory access|out of bounds|unreachable|abort|null function|bad_alloc|^\d+$/i, `${what} ${kind}`);
      } else if (['open', 'draw', 'patches'].includes(kind)) {
        nodes = reply.answer.positions.length / 3;
      } else if (kind === 'fill') {
        ({ patches } = reply.answer);
      } else if (kind === 'solve') {
        assert.equal(reply.answer.positions.length, 3 * nodes, what);
      }
    }
    worker.ended.fill(0);
    // What was done before leaves no trace in a shape that is opened afterwards.
    const bytes = bytesOf(grid(draw));
    const results = [];
    for (let times = 0; times < 2; ++times) {
      const opened = await worker.ask(++number, 'open', { name: 'last.obj', bytes: bytes.slice(), rules: held });
      const solved = await worker.ask(++number, 'solve', { rules: held });
      assert.equal(opened.error ?? solved.error, undefined, what);
      nodes = opened.answer.positions.length / 3;
      results.push(solved.answer.positions);
    }
    assert.deepEqual(results[0], results[1], what);
    messages += 4;
  }
  if (sequences > 1000) console.log(`${sequences} sequences, ${messages} messages`);
});

test('what starts elsewhere is solved from there to the last digit, whatever the file is, and is written as the file', async () => {
  const all = '{"rules": [{"nodes": "all", "position": "fixed"}]}';
  const stl = 'solid mine\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid mine\n';
  const gpx = '<gpx version="1.1"><trk><trkseg>' + [0, 1, 2, 3].map((k) => `<trkpt lat="47.${k}" lon="8.${k * k}"><time>2020-01-01T00:00:0${k}Z</time></trkpt>`).join('') + '</trkseg></trk></gpx>';
  for (const [name, text, kept] of [['a.stl', stl, 'solid mine'], ['a.obj', `# mine\n${grid(drawFrom(3))}`, '# mine'], ['a.gpx', gpx, '2020-01-01T00:00:03Z']]) {
    const { answer: { positions } } = await worker.ask(++number, 'open', { name, bytes: bytesOf(text), rules: all });
    // Some nodes nearly at one place.
    const start = positions.map((part, k) => 1 / 3 + 1e-9 * part + 1e-12 * k);
    await worker.ask(++number, 'start', start);
    const { answer: solved } = await worker.ask(++number, 'solve', { rules: all });
    assert.deepEqual(solved.positions, start, name);
    const { answer: bytes } = await worker.ask(++number, 'write', { name, positions });
    assert.ok(new TextDecoder().decode(bytes).includes(kept), name);
    await worker.ask(++number, 'start', null);
    assert.deepEqual((await worker.ask(++number, 'solve', { rules: all })).answer.positions, positions, name);
  }
});
