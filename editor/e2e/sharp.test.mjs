// Sharp edges: those that turn by more than an angle are drawn, stay sharp, and are named by the constraints file.

import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { expectSameAsNative, greatestDistance, keep, native, open, page, picture, placesOf, rulesOf, saved, session, settled, useSession } from './support.mjs';

const cells = 12;
const ridge = cells / 2;

// Two planes that meet along x = 0 at a right angle, with bumps inside.
useSession(() => {
  const lines = [];
  const bump = (row, column) => (row % cells && column % cells && column !== ridge ? 0.02 * (((7 * row + 3 * column) % 5) / 4 - 0.5) : 0);
  for (let row = 0; row <= cells; ++row) for (let column = 0; column <= cells; ++column) {
    const [x, y] = [column, row].map((k) => (2 * k) / cells - 1);
    lines.push(`v ${x} ${y} ${-Math.abs(x) + bump(row, column)}`);
  }
  const node = (row, column) => row * (cells + 1) + column + 1;
  for (let row = 0; row < cells; ++row) for (let column = 0; column < cells; ++column) lines.push(`f ${node(row, column)} ${node(row, column + 1)} ${node(row + 1, column + 1)} ${node(row + 1, column)}`);
  writeFileSync(join(session.folder, 'roof.obj'), `${lines.join('\n')}\n`);
});

const keeps = () => page.getByRole('button', { name: 'Keep edges sharp' });
const says = (text) => page.locator('#sharp-says', { hasText: text }).waitFor();
const off = (places) => Math.max(...places.map(([x, , z]) => Math.abs(z + Math.abs(x))));

test('edges over an angle stay sharp, are drawn and saved with the constraints; the angle, undo and a node that is pulled go on from there', async () => {
  await open('?file=files/roof.obj');
  assert.ok(off(placesOf((await saved(page)).path)) > 0.05, 'the ridge is rounded');
  const rounded = await picture(page);
  await keeps().click();
  await says(`${cells} edges stay sharp.`);
  await settled(page);
  assert.equal(await keeps().getAttribute('aria-pressed'), 'true');
  assert.ok(off(placesOf((await saved(page)).path)) < 1e-4);
  assert.notEqual(await picture(page), rounded);
  const path = JSON.parse(await rulesOf(page)).rules.find((rule) => rule.sharp);
  assert.equal(path.sharp, 'path');
  assert.deepEqual([...path.nodes].sort((a, b) => a - b), Array.from({ length: cells + 1 }, (_, row) => row * (cells + 1) + ridge));
  await expectSameAsNative(session, page, join(session.folder, 'roof.obj'));
  const fair = join(session.folder, 'by-angle.obj');
  native('fair', join(session.folder, 'roof.obj'), '-o', fair, '--sharp', '40', '--quiet');
  assert.ok(greatestDistance(placesOf((await saved(page)).path), placesOf(fair)) < 6e-5);

  await page.getByLabel('That turn by over').fill('100');
  await says('No edge turns by more than that.');
  await settled(page);
  assert.ok(off(placesOf((await saved(page)).path)) > 0.05);
  await page.getByRole('button', { name: 'Undo' }).click();
  await says(`${cells} edges stay sharp.`);
  assert.equal(await page.getByLabel('That turn by over').inputValue(), '40');
  await page.getByLabel('Node number').fill('42');
  await page.keyboard.press('Enter');
  await page.getByLabel('Position z').fill('0.2');
  await page.keyboard.press('Enter');
  await settled(page);
  const pulled = placesOf((await saved(page)).path);
  assert.equal(pulled[42][2], 0.2);
  // The other side stays as it is.
  assert.ok(off(pulled.filter((_, node) => node % (cells + 1) >= ridge)) < 1e-4);
  await keeps().click();
  await page.locator('#sharp-says').waitFor({ state: 'hidden' });
});

test('edges stay sharp in a file that is as it came, and in what is then smoothed', async () => {
  await open('?file=files/roof.obj', { untouched: true });
  const input = placesOf(join(session.folder, 'roof.obj'));
  await keeps().click();
  await says(`${cells} edges stay sharp.`);
  await settled(page);
  assert.deepEqual(placesOf((await saved(page)).path), input);
  await page.getByRole('button', { name: 'Smooth it' }).click();
  await page.getByLabel('Edges stay over').fill('180');
  await page.getByRole('textbox', { name: 'Tolerance' }).fill('0.03');
  await page.keyboard.press('Enter');
  await page.locator('#start-says', { hasText: /^Moves / }).waitFor();
  await keep(page);
  await says(`${cells} edges stay sharp.`);
  const smooth = placesOf((await saved(page)).path);
  assert.ok(off(smooth) < 0.01 && off(input) > 0.009, `${off(smooth)}, before ${off(input)}`);
});
