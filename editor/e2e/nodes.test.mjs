// Nodes of a curve that are inserted and deleted: by double click, keys and buttons; what holds follows their numbers.

import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { drag, drop, find, follows, freeForm, greatestDistance, native, open, page, placesOf, rulesOf, saved, session, settled, useSession } from './support.mjs';

const wave = `x,y\n${Array.from({ length: 41 }, (_, k) => `${k / 6},${Math.sin(k / 6) + 0.02 * ((k * 7) % 5)}`).join('\n')}\n`;

useSession();

const sized = (text) => page.locator('#size', { hasText: text }).waitFor();
const undo = async (text) => {
  await page.keyboard.press('z');
  await sized(text);
  await settled(page);
};

test('a double click on a drawn curve inserts a node, which is pulled; undo takes both back', async () => {
  await open();
  await page.getByLabel('Nodes a span').fill('4');
  await page.getByRole('button', { name: 'New curve' }).click();
  const box = await page.locator('#canvas').boundingBox();
  const at = (x, y) => ({ x: box.x + box.width * x, y: box.y + box.height * y });
  for (const { x, y } of [at(0.1, 0.5), at(0.6, 0.5)]) await page.mouse.click(x, y);
  await page.keyboard.press('Enter');
  await sized('5 nodes, open curve');
  await settled(page);
  const before = await rulesOf(page);
  const ends = placesOf((await saved(page, 'csv')).path);

  const { x, y } = at(0.15, 0.5);  // a little before the middle between nodes 0 and 1
  await page.mouse.dblclick(x, y);
  await sized('6 nodes, open curve');
  await page.locator('#picked', { hasText: /^Node 1$/ }).waitFor();
  await settled(page);
  const even = placesOf((await saved(page, 'csv')).path);
  assert.ok(even.every(([x], k) => Math.abs(x - ends[0][0] - (k * (ends[4][0] - ends[0][0])) / 5) < 1e-6), 'on the line, and evenly spread as ever');
  await page.getByLabel('Strength').fill('0');
  const input = placesOf((await saved(page, 'csv')).path);
  assert.ok(greatestDistance([input[0], ...input.slice(2)], ends) < 1e-6);
  const share = (input[1][0] - ends[0][0]) / (ends[1][0] - ends[0][0]);
  assert.ok(Math.abs(share - 0.4) < 0.02, `${share} of the way to the next node`);
  await page.getByLabel('Strength').fill('100');
  await page.mouse.dblclick(at(0.15, 0.7).x, at(0.15, 0.7).y);
  assert.equal(await page.locator('#size').textContent(), '6 nodes, open curve', 'beside the curve nothing is inserted');

  await drag(page, at(0.2, 0.5), 20, 60, () => follows(page));
  const [, hold] = JSON.parse(await rulesOf(page)).rules.filter((rule) => rule.position);
  assert.deepEqual(hold.nodes, [0, 1, 5]);
  await undo('6 nodes');
  await undo('5 nodes');
  assert.equal(await rulesOf(page), before);
  assert.ok(greatestDistance(placesOf((await saved(page, 'csv')).path), ends) < 1e-9);
});

test('keys insert beside a picked node and delete it; the saved curve is the native one, and comes back after a reload', async () => {
  await open();
  await drop(page, 'wave.csv', wave);
  await sized('41 nodes, open curve');
  await freeForm(page);
  const held = await find(page, /free/, [0.4, 0.02], [0.4, 0.98]);
  await page.mouse.click(held.x, held.y);
  await page.keyboard.press('f');
  await settled(page);
  const rules = await rulesOf(page);
  const { position } = JSON.parse(rules).rules.at(-1);
  const holds = async (node) => assert.deepEqual(JSON.parse(await rulesOf(page)).rules.at(-1), { nodes: [node], position });
  await page.keyboard.press('a');
  await sized('42 nodes');
  await page.locator('#picked', { hasText: `Node ${held.node + 1}` }).waitFor();
  await settled(page);
  await holds(held.node);

  await page.mouse.move(3, 3);
  const before = await find(page, /free/, [0.25, 0.02], [0.25, 0.98]);
  assert.ok(before.node < held.node);
  await page.mouse.click(before.x, before.y);
  await page.getByRole('button', { name: 'Insert node' }).click();
  await sized('43 nodes');
  await settled(page);
  await holds(held.node + 1);

  await page.mouse.click(before.x, before.y);
  await page.keyboard.down('Shift');
  const other = await find(page, /free/, [0.15, 0.02], [0.15, 0.98]);
  await page.mouse.click(other.x, other.y);
  await page.keyboard.up('Shift');
  await page.locator('#picked', { hasText: '2 nodes' }).waitFor();
  await page.keyboard.press('Delete');
  await sized('41 nodes');
  await settled(page);
  await holds(held.node - 1);

  const ours = placesOf((await saved(page, 'csv')).path);
  await page.getByLabel('Strength').fill('0');
  const [input, constraints, out] = ['input.csv', 'rules.json', 'fair.csv'].map((name) => join(session.folder, name));
  writeFileSync(input, placesOf((await saved(page, 'csv')).path).map(([x, y]) => `${x},${y}\n`).join(''));
  writeFileSync(constraints, await rulesOf(page));
  native('curve', input, '-o', out, '--constraints', constraints, '--quiet');
  assert.ok(greatestDistance(ours, placesOf(out)) < 1e-4);
  await page.getByLabel('Strength').fill('100');

  await page.waitForTimeout(500);  // until it is kept
  await page.goto(session.address);
  await sized('41 nodes');
  await settled(page);
  assert.ok(greatestDistance(placesOf((await saved(page, 'csv')).path), ours) < 1e-9);
  await undo('43 nodes');
  await undo('42 nodes');
  await undo('41 nodes');
  assert.equal(await rulesOf(page), rules);
});

test('a curve keeps two nodes, and surfaces keep theirs', async () => {
  await open();
  assert.ok(await page.getByRole('button', { name: 'Insert node' }).isHidden());
  await page.keyboard.press('Control+a');
  await page.keyboard.press('Delete');
  await page.getByLabel('Example').selectOption({ label: 'Noisy wave' });
  await page.locator('#size', { hasText: 'curve' }).waitFor();
  await settled(page);
  const size = await page.locator('#size').textContent();
  await page.keyboard.press('Control+a');
  await page.keyboard.press('Delete');
  await page.getByRole('alert').filter({ hasText: 'keeps at least two nodes' }).waitFor();
  assert.equal(await page.locator('#size').textContent(), size);
});
