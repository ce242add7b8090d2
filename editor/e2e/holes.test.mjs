// Holes that are filled: all, or those that are picked; patches are part of the surface that is faired, saved and kept.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { openSphere } from '../../tests/wasm/shapes.mjs';
import { greatestDistance, native, open, page, placesOf, saved, session, settled, useSession } from './support.mjs';

const { nodes, text } = openSphere();

useSession(() => writeFileSync(join(session.folder, 'sphere.ply'), text));

const sized = (what) => page.locator('#size', { hasText: what }).waitFor();
const fill = () => page.getByRole('button', { name: 'Fill holes' });
const rowsOf = (path) => readFileSync(path, 'utf8').split('end_header\n')[1].trim().split('\n');

test('all holes are filled as by the program, the file keeps all it had, and undo, redo and a reload take it back and forth', async () => {
  const [closed, report] = [join(session.folder, 'closed.obj'), join(session.folder, 'fill.json')];
  native('fill', join(session.folder, 'sphere.ply'), '-o', closed, '--report', report, '--quiet');
  const { new_nodes: added, new_faces: faces } = JSON.parse(readFileSync(report, 'utf8'));
  const [open312, filled] = ['312 nodes, 288 faces', `${312 + added} nodes, ${288 + faces} faces`];
  await open('?file=files/sphere.ply', { untouched: true });
  await sized(open312);
  await page.keyboard.press('Shift+H');
  await sized(filled);
  await settled(page);
  await page.locator('#picked', { hasText: `${added} nodes` }).waitFor();
  assert.equal(await page.locator('#status').textContent(), 'As it is in the file, with patches');
  assert.ok(await fill().isDisabled(), 'there is no hole any more');
  assert.ok(greatestDistance(placesOf((await saved(page, 'obj')).path), placesOf(closed)) < 1e-4);
  const { path } = await saved(page, 'ply');
  assert.deepEqual(rowsOf(path).slice(0, 312), nodes);
  assert.equal(rowsOf(path).length, 312 + added + 288 + faces);

  await page.getByRole('button', { name: 'Undo' }).and(page.locator('[title*="Undo: Fill 2 holes"]')).click();
  await sized(open312);
  await settled(page);
  assert.equal(readFileSync((await saved(page, 'ply')).path, 'utf8'), text);
  await page.getByRole('button', { name: 'Redo' }).click();
  await sized(filled);
  await settled(page);
  await page.goto(session.address);
  await page.locator('#restored', { hasText: 'sphere.ply' }).waitFor();
  await sized(filled);
  await settled(page);
  assert.deepEqual(rowsOf((await saved(page, 'ply')).path), rowsOf(path));
});

test('the hole at a picked node is filled, its patch is pulled with what is around, and then the other one is filled', async () => {
  await open('?file=files/sphere.ply', { untouched: true });
  await page.getByLabel('Node number').fill('0');
  await page.getByLabel('Node number').press('Enter');
  await fill().click();
  await page.locator('[title*="Undo: Fill 1 hole"]').waitFor();
  await settled(page);
  const patched = placesOf((await saved(page, 'obj')).path);
  assert.ok(patched.slice(312).length > 10 && patched.slice(312).every(([, , z]) => z < -0.9));

  await page.getByLabel('Node number').fill('320');
  await page.getByLabel('Node number').press('Enter');
  const [x, y, z] = patched[320];
  for (const [axis, value] of [['x', x], ['y', y], ['z', z - 0.1]]) await page.getByLabel(`Position ${axis}`).fill(String(value));
  await page.getByLabel('Position z').press('Enter');
  await page.locator('[title*="node 320"]').waitFor();
  await settled(page);
  const pulled = placesOf((await saved(page, 'obj')).path);
  assert.ok(Math.abs(pulled[320][2] - (z - 0.1)) < 1e-9 && greatestDistance(pulled.slice(312).filter((_, k) => k !== 8), patched.slice(312).filter((_, k) => k !== 8)) > 0.02, 'the patch follows');

  await fill().click();
  await page.locator('[title*="Undo: Fill 1 hole"]').waitFor();
  await settled(page);
  const both = placesOf((await saved(page, 'obj')).path);
  assert.ok(both.length > pulled.length && greatestDistance(both.slice(0, pulled.length), pulled) < 1e-9, 'what was pulled stays');
});

test('a sheet keeps its outer rim unless that is picked, and a message says so', async () => {
  session.generated('sheet.obj', 'saddle', '--columns', '8', '--rows', '8');
  await open('?file=files/sheet.obj', { untouched: true });
  await fill().click();
  await page.getByRole('alert').filter({ hasText: 'Its rim stays open: pick a node of it to fill that' }).waitFor();
  await sized('81 nodes');
  await page.getByRole('button', { name: 'Dismiss' }).first().click();
  await page.getByLabel('Node number').fill('0');
  await page.getByLabel('Node number').press('Enter');
  await fill().click();
  await page.locator('[title*="Undo: Fill 1 hole"]').waitFor();
});
