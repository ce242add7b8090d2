// Scattered points: loaded, fitted to in every way, dragged along, undone, and saved as the native program fits them.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { drag, find, greatestDistance, native, nodesOf, rulesOf, saved, Session, settled } from './support.mjs';

let session;
before(async () => { session = await Session.start(); });
after(() => session.stop());

test('a surface is drawn towards points, by every kind of fit, as the native program does', async () => {
  const patch = session.generated('patch.obj', 'saddle', '--columns', '14', '--rows', '14');
  const nodes = nodesOf(readFileSync(patch, 'utf8'));
  const size = Math.hypot(...[0, 1, 2].map((axis) => Math.max(...nodes.map((node) => node[axis])) - Math.min(...nodes.map((node) => node[axis]))));
  const cloud = nodes.map(([x, y, z], k) => `${x} ${y} ${z + size * (0.04 + 0.01 * (((k * 7) % 5) / 4 - 0.5))}`).join('\n');
  const points = join(session.folder, 'cloud.xyz');
  writeFileSync(points, cloud);

  const { page, faults } = await session.open('?file=files/patch.obj');
  await settled(page);
  const undo = page.getByRole('button', { name: 'Undo' });
  const label = (text) => page.locator(`[title^="Undo: ${text}"]`).waitFor();
  const plain = nodesOf(readFileSync((await saved(page)).path, 'utf8'));
  const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.getByRole('button', { name: 'Points…' }).click()]);
  await chooser.setFiles(points);
  await label('Load points cloud.xyz');
  await settled(page);
  const figures = page.locator('#fit-figures');
  await figures.filter({ hasText: `${nodes.length} points · at most` }).waitFor();

  const compare = async (...options) => {
    const [rules, fitted] = ['rules.json', 'fitted.obj'].map((name) => join(session.folder, name));
    writeFileSync(rules, await rulesOf(page));
    native('fit', patch, '--points', points, '-o', fitted, '--constraints', rules, ...options, '--quiet');
    const [ours, theirs] = [(await saved(page)).path, fitted].map((path) => nodesOf(readFileSync(path, 'utf8')));
    assert.ok(greatestDistance(ours, theirs) < 6e-5 * size, `${options}: ${greatestDistance(ours, theirs) / size}`);
    return ours;
  };
  const length = await page.locator('#fit-value').inputValue();
  const smooth = await compare('--smoothing-length', length);
  assert.ok(greatestDistance(smooth, plain) > 0.01 * size, 'it is drawn towards them');

  await page.locator('#fit-slider').focus();
  await page.keyboard.press('ArrowLeft');
  await label('Smoothing length');
  await settled(page);
  assert.ok(Number(await page.locator('#fit-value').inputValue()) < Number(length));
  await compare('--smoothing-length', await page.locator('#fit-value').inputValue());

  const by = async (kind, title, value) => {
    await page.getByLabel('Fit by').selectOption(kind);
    await label(title);
    await page.locator('#fit-value').fill(value);
    await page.locator('#fit-value').press('Enter');
    await page.locator(`[title^="Undo: ${title} ${value}"]`).waitFor();
    await page.evaluate(() => document.activeElement.blur());
    await page.locator('#progress').waitFor({ state: 'hidden' });
  };
  await by('weight', 'Weight', '0.05');
  await settled(page);
  const weighted = await compare('--weight', '0.05');

  // Held nodes are dragged along with the fit.
  const held = await find(page, /position fixed/, [0.02, 0.5], [0.6, 0.5]);
  await drag(page, held, 0, -20);
  const pulled = await compare('--weight', '0.05');
  assert.ok(greatestDistance(pulled, weighted) > 0.005 * size);
  await page.keyboard.press('Control+z');
  await settled(page);

  await page.getByLabel('Outliers, %').fill('10');
  await page.getByLabel('Outliers, %').press('Enter');
  await figures.filter({ hasText: `${Math.floor(nodes.length / 10)} left out` }).waitFor();
  await settled(page);
  await compare('--weight', '0.05', '--outliers', '0.1');

  await page.locator('#fit-value').fill('-1');
  await page.locator('#fit-value').press('Enter');
  assert.equal(await page.locator('#fit-value').inputValue(), '0.05', 'what is no weight is not taken');
  await page.evaluate(() => document.activeElement.blur());

  const [redo, remove] = [page.getByRole('button', { name: 'Redo' }), page.getByRole('button', { name: 'Remove', exact: true })];
  await remove.click();
  await settled(page);
  assert.ok(greatestDistance(nodesOf(readFileSync((await saved(page)).path, 'utf8')), plain) < 1e-9, 'without points as before');
  await undo.click();
  await settled(page);
  await figures.filter({ hasText: `${Math.floor(nodes.length / 10)} left out` }).waitFor();
  await redo.click();
  await settled(page);
  assert.ok(await figures.isHidden());
  assert.deepEqual(faults, []);
  await page.close();
});

test('points are dropped on a surface; within a tolerance the panel says how many are outside', async () => {
  const { page, faults } = await session.open();
  await settled(page);
  const data = await page.evaluateHandle(() => {
    const transfer = new DataTransfer();
    transfer.items.add(new File(['x,y,z\n0.7,0,0.3\n0,0.7,0.3\n-0.7,0,0.3\n0,-0.7,0.3\n'], 'four.csv'));
    return transfer;
  });
  await page.dispatchEvent('body', 'drop', { dataTransfer: data });
  await page.locator('#fit-figures').filter({ hasText: 'four.csv: 4 points' }).waitFor();
  await settled(page);
  assert.match(await page.locator('#name').textContent(), /annulus/);
  await page.getByLabel('Fit by').selectOption('within');
  await page.locator('#fit-figures').filter({ hasText: /\d % outside/ }).waitFor({ timeout: 120_000 });
  assert.deepEqual(faults, []);
  await page.close();
});
