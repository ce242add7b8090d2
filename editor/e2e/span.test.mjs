// A surface through curves that are open: as by the program, held on the curves, faired and pulled; undone like any step.

import assert from 'node:assert/strict';
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { greatestDistance, native, open, page, placesOf, root, saved, session, settled, useSession } from './support.mjs';

useSession(() => {
  for (const name of ['hull-lines.obj', 'bonnet-lines.obj']) copyFileSync(join(root, 'examples', name), join(session.folder, name));
  writeFileSync(join(session.folder, 'line.csv'), '0,0,0\n1,0,0\n2,1,0\n');
});

const span = () => page.getByRole('button', { name: 'Span with a surface' });
const placesBy = (...options) => {
  const path = join(session.folder, 'native.obj');
  native('span', ...options, '-o', path, '--quiet');
  return placesOf(path);
};

test('curves are spanned as by the program; what is drawn then follows, and undo goes back to the curves', async () => {
  const expected = placesBy(join(session.folder, 'hull-lines.obj'));
  await open('?file=files/hull-lines.obj', { untouched: true });
  const curves = await page.locator('#size').textContent();
  await span().click();
  await page.locator('#name', { hasText: 'hull-lines-surface.obj' }).waitFor();
  await settled(page);
  const surface = await page.locator('#size').textContent();
  assert.match(surface, new RegExp(`^${expected.length.toLocaleString('en')} nodes, `));
  assert.ok(greatestDistance(placesOf((await saved(page, 'obj')).path), expected) < 1e-4);

  // All but its curves may move, and it is as fair as it can be already.
  await page.getByRole('button', { name: 'Free form' }).click();
  await settled(page);
  const { path } = await saved(page, 'obj');
  const report = join(session.folder, 'moved.json');
  native('measure', path, '--compare', join(session.folder, 'native.obj'), '--report', report, '--quiet');
  assert.ok(JSON.parse(readFileSync(report, 'utf8')).distance.to_other.greatest < 0.01, 'nodes go along a hull of ten metres');

  await page.getByRole('button', { name: 'Undo' }).click();
  await page.getByRole('button', { name: 'Undo' }).and(page.locator('[title*="Open hull-lines-surface.obj"]')).click();
  await page.locator('#name', { hasText: 'hull-lines.obj' }).waitFor();
  assert.equal(await page.locator('#size').textContent(), curves);
  await page.getByRole('button', { name: 'Redo' }).click();
  await page.locator('#name', { hasText: 'hull-lines-surface.obj' }).waitFor();
  assert.equal(await page.locator('#size').textContent(), surface);
});

test('a picked curve may be an edge of the surface, which it then keeps', async () => {
  const expected = placesBy(join(session.folder, 'bonnet-lines.obj'), '--sharp', 'feature');
  await open('?file=files/bonnet-lines.obj', { untouched: true });
  await page.getByLabel('Node number').fill('76');
  await page.getByLabel('Node number').press('Enter');
  await page.getByRole('button', { name: 'Connected part' }).click();
  await span().click();
  await page.locator('#name', { hasText: 'bonnet-lines-surface.obj' }).waitFor();
  await settled(page);
  const { path } = await saved(page, 'obj');
  assert.ok(greatestDistance(placesOf(path), expected) < 1e-4);
  assert.match(readFileSync(path, 'utf8'), /^l /m, 'the file marks its edges');
});

test('curves that bound nothing are told, and stay open', async () => {
  await open('?file=files/line.csv', { untouched: true });
  await span().click();
  await page.getByRole('alert').filter({ hasText: 'no curves make a loop' }).waitFor();
  await page.locator('#name', { hasText: 'line.csv' }).waitFor();
});
