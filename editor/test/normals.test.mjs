// Turns of normals, ways along lines, numbers in fields, words of the library.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { compiled } from './support.mjs';

const { tilted, turnBetween, turned } = await compiled('base/turning');
const { along } = await compiled('pick/ways');
const { vectorOf } = await compiled('panels/numbers');
const { inEditorWords } = await compiled('base/words');

const frame = [[1, 0, 0], [0, 0, 1], [0, -1, 0]];  // seen along y
const near = (a, b) => assert.ok(a.every((part, i) => Math.abs(part - b[i]) < 1e-12), `${a} and ${b}`);

test('the head of an arrow stays under the pointer, on its side of the node, and at the rim beyond', () => {
  near(tilted([0, 0, 1], frame, 0.6, -0.2), [0.6, 0, 0.8]);
  near(tilted([0, -1, 0], frame, 0.6, 0), [0.6, -0.8, 0]);
  near(tilted([0, 1, 0], frame, 0.6, 0), [0.6, 0.8, 0]);
  near(tilted([0, -1, 0], frame, 3, 4), [0.6, 0, 0.8]);
});

test('all normals turn by the turn of the one that is dragged', () => {
  const turn = turnBetween([0, 0, 1], [0.6, 0, 0.8]);
  near([...turned(Float64Array.of(0, 0, 1, 0, 1, 0, 1, 0, 0), turn)], [0.6, 0, 0.8, 0, 1, 0, 0.8, 0, -0.6]);
  assert.deepEqual(turnBetween([0, 0, 1], [0, 0, 1]), [0, 0, 0]);
  assert.deepEqual([...turned(Float64Array.of(0.1, 0.2, 0.3), [0, 0, 0])], [0.1, 0.2, 0.3]);
});

test('a way along an axis is the one that is seen nearest to the pointer', () => {
  const [right, down] = [[0.01, 0, 0], [0, 0, -0.01]];
  near(along([0, 0, 1], right, down, 50, -30), [0, 0, 0.3]);
  near(along([1, 0, 0], right, down, 50, -30), [0.5, 0, 0]);
  near(along([0.6, 0.8, 0], right, down, 30, 9), [0.3, 0.4, 0]);
  near(along([0, 1, 0], right, down, 50, -30), [0, 0, 0]);
});

test('numbers are read as people type them; of what is none it is said what to do', () => {
  const any = { words: 'numbers', takes: Number.isFinite };
  assert.deepEqual(vectorOf(['1', '−2.5', ''], any), [1, -2.5, 0]);
  assert.deepEqual(vectorOf(['0,5', '1e-3', '0'], any), [0.5, 0.001, 0]);
  for (const wrong of [['', '', ''], ['1', 'x', '2'], ['1', '', 'Infinity'], ['1', '5 mm', '0']]) assert.equal(vectorOf(wrong, any), 'Give numbers');
});

test('what the library advises is said in words of the editor', () => {
  assert.equal(inEditorWords('fix the ends, hold it by a rule, or let only a region move'),
    'fix the ends (“Positions fixed”), hold it by a rule, or let only a region move (“Fair only these nodes”)');
  assert.equal(inEditorWords('fix the boundary to hold them'), 'fix the boundary (“Positions fixed”) to hold them');
});
