// What colours show, without a browser: which shapes the library is asked about, and whose range the colours have.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { compiled } from './support.mjs';

const { Fields } = await compiled('view/fields');
const { between } = await compiled('shape/between');
const { shapeOf } = await compiled('shape/shape');

let clock = 0;
performance.now = () => clock;

const rest = () => new Promise(setImmediate);

// A square whose library says that every node of a shape is curved as its first coordinate says.
function fields() {
  const asked = [];
  const shown = [];
  const input = Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0);
  const shape = shapeOf({ positions: input, corners: Int32Array.of(0, 1, 2, 3), faceBegin: Int32Array.of(0, 4), boundary: new Uint8Array(4).fill(1), warnings: [] });
  const made = new Fields({
    ask: (positions) => new Promise((done) => {
      asked.push({ positions, answer: () => done({ k1: Float64Array.from({ length: 4 }, (_, n) => positions[3 * n]), k2: new Float64Array(4) }) });
    }),
    show: (field) => shown.push(field),
    failed: (message) => assert.fail(message),
  });
  made.open(shape);
  return { made, asked, shown, input };
}

test('colours have the range of the result, also where the input is seen', async () => {
  const { made, asked, shown, input } = fields();
  const result = input.map((part) => 4 * part);
  made.choose('mean');
  asked.shift().answer();
  await rest();
  made.move(result, result, true);
  asked.shift().answer();
  await rest();
  assert.deepEqual(shown.at(-1).range, [0, 2]);
  assert.deepEqual([...shown.at(-1).values], [0, 2, 2, 0]);
  made.move(input, result, true);
  for (let k = 0; k < 2; ++k) {
    asked.shift().answer();
    await rest();
  }
  assert.deepEqual(shown.at(-1).range, [0, 2]);
  assert.deepEqual([...shown.at(-1).values], [0, 0.5, 0.5, 0]);
  made.choose(null);
  assert.equal(shown.at(-1), null);
  made.move(result, result, true);
  assert.equal(asked.length, 0);
});

test('one question at a time, and the newest shape is asked about next; during a drag only where answers are quick', async () => {
  const { made, asked, shown, input } = fields();
  const shapes = [1, 2, 3].map((factor) => input.map((part) => factor * part));
  made.choose('mean');
  for (const shape of shapes) made.move(shape, shape, true);
  assert.equal(asked.length, 1);
  asked.shift().answer();
  await rest();
  assert.deepEqual(asked.map(({ positions }) => positions), [shapes[2]]);
  clock += 20;
  asked.shift().answer();
  await rest();
  made.move(shapes[0], shapes[0], false);
  assert.equal(asked.length, 0, 'that answer took long');
  made.move(shapes[0], shapes[0], true);
  asked.shift().answer();
  await rest();
  made.move(shapes[1], shapes[1], false);
  assert.equal(asked.length, 1);
  asked.shift().answer();
  await rest();
  assert.deepEqual([shown.at(-1).range, [...shown.at(-1).values]], [[0, 0.5], [0, 1, 1, 0]], 'the range stays while it is dragged');
});

test('deviation is along the normal of the input, without the library', async () => {
  const { made, asked, shown, input } = fields();
  made.choose('deviation');
  const up = input.map((part, k) => (k % 3 === 2 ? 0.25 : part + 1));
  made.move(up, up, true);
  await rest();
  await rest();
  assert.deepEqual([...shown.at(-1).values], [0.25, 0.25, 0.25, 0.25]);
  assert.equal(asked.length, 0);
});

test('deviation is from what is said: its title tells, and its values are those from there', async () => {
  const { made, shown, input } = fields();
  const lifted = (by) => input.map((part, k) => (k % 3 === 2 ? part + by : part));
  made.choose('deviation');
  made.move(lifted(3), lifted(3), true);
  await rest();
  assert.deepEqual([shown.at(-1).title, Math.abs(shown.at(-1).values[0])], ['Deviation from the input, units of the file', 3]);
  made.compareWith(lifted(2));
  await rest();
  assert.deepEqual([shown.at(-1).title, Math.abs(shown.at(-1).values[0])], ['Deviation from what was applied last, units of the file', 1]);
});

test('between input and result the ends are those themselves', () => {
  const [input, result] = [Float64Array.of(0.1, 1 / 3), Float64Array.of(0.7, 5)];
  assert.equal(between(input, result, 0), input);
  assert.equal(between(input, result, 1), result);
  assert.deepEqual(between(input, result, 0.5), Float64Array.of(0.1 + 0.5 * (0.7 - 0.1), 1 / 3 + 0.5 * (5 - 1 / 3)));
});
