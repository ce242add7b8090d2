// Scattered points of surfaces and curves: loaded, fitted to in every way, dragged along, undone, and saved as the native program fits them.

import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { choose, drag, drop, find, follows, greatestDistance, native, open, page, placesOf, rulesOf, saved, session, settled, useSession } from './support.mjs';

useSession();

const figures = () => page.locator('#fit-figures');
const legend = () => page.locator('#points-legend');
const lastStep = (text) => page.locator(`[title^="Undo: ${text}"]`).waitFor();
const sizeOf = (places) => Math.hypot(...[0, 1, 2].map((axis) => Math.max(...places.map((place) => place[axis])) - Math.min(...places.map((place) => place[axis]))));

// What is saved is what the program makes of the same file and constraints, to a share of its size. Returns its places.
async function sameAsNative(tolerance, [command, input, ...options]) {
  const [rules, fitted] = ['rules.json', `fitted-${input}`].map((name) => join(session.folder, name));
  writeFileSync(rules, await rulesOf(page));
  native(command, join(session.folder, input), '-o', fitted, '--constraints', rules, ...options, '--quiet');
  const [ours, theirs] = [(await saved(page)).path, fitted].map(placesOf);
  assert.ok(greatestDistance(ours, theirs) < tolerance * sizeOf(theirs), `${command} ${options}: ${greatestDistance(ours, theirs) / sizeOf(theirs)}`);
  return ours;
}

async function fitBy(kind, title, value) {
  await page.getByLabel('Fit by').selectOption(kind);
  await lastStep(title);
  await page.locator('#fit-value').fill(value);
  await page.locator('#fit-value').press('Enter');
  await lastStep(`${title} ${value}`);
  await page.evaluate(() => document.activeElement.blur());
  await page.locator('#progress').waitFor({ state: 'hidden' });
}

test('a surface is drawn towards points, by every kind of fit, as the native program does', async () => {
  const patch = session.generated('patch.obj', 'saddle', '--columns', '14', '--rows', '14');
  const nodes = placesOf(patch);
  const size = sizeOf(nodes);
  const off = [50, 112, 160];
  const cloud = nodes.map(([x, y, z], k) => `${x} ${y} ${z + size * (0.04 + 0.01 * (((k * 7) % 5) / 4 - 0.5) + (off.includes(k) ? 0.1 : 0))}`).join('\n');
  const points = join(session.folder, 'cloud.xyz');
  writeFileSync(points, cloud);

  await open('?file=files/patch.obj');
  const undo = page.getByRole('button', { name: 'Undo' });
  const plain = placesOf((await saved(page)).path);
  await choose(page, 'Points…', points);
  await lastStep('Load points cloud.xyz');
  await settled(page);
  await figures().filter({ hasText: `${nodes.length} points · at most` }).waitFor();
  const [, greatest] = (await figures().textContent()).match(/at most (\S+) away/);
  assert.equal(await legend().locator('figcaption').textContent(), 'Distance of the points');
  const [first, , last] = (await legend().locator('.marks span').allTextContents()).map(Number);
  assert.ok(first === 0 && Math.abs(last - Number(greatest)) < 0.01 * last, `${last} is not ${greatest}`);

  const compare = (...options) => sameAsNative(6e-5, ['fit', 'patch.obj', '--points', points, ...options]);
  const length = await page.locator('#fit-value').inputValue();
  const smooth = await compare('--smoothing-length', length);
  assert.ok(greatestDistance(smooth, plain) > 0.01 * size, 'it is drawn towards them');

  await page.locator('#fit-slider').focus();
  await page.keyboard.press('ArrowLeft');
  await lastStep('Smoothing length');
  await settled(page);
  assert.ok(Number(await page.locator('#fit-value').inputValue()) < Number(length));
  await compare('--smoothing-length', await page.locator('#fit-value').inputValue());

  await fitBy('weight', 'Weight', '0.05');
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
  await figures().filter({ hasText: `${off.length} left out` }).waitFor();
  await settled(page);
  await compare('--weight', '0.05', '--outliers', '0.1');

  await page.locator('#fit-value').fill('-1');
  await page.locator('#fit-value').press('Enter');
  await page.getByRole('alert').filter({ hasText: 'Give a number above 0' }).waitFor();
  await page.evaluate(() => document.activeElement.blur());

  const [redo, remove] = [page.getByRole('button', { name: 'Redo' }), page.getByRole('button', { name: 'Remove', exact: true })];
  await remove.click();
  await settled(page);
  assert.ok(greatestDistance(placesOf((await saved(page)).path), plain) < 1e-9, 'without points as before');
  await undo.click();
  await settled(page);
  await figures().filter({ hasText: `${off.length} left out` }).waitFor();
  await redo.click();
  await settled(page);
  assert.ok(await figures().isHidden());
  assert.ok(await legend().isHidden());
});

test('points are dropped on a surface of one\'s own, as is asked; within a tolerance the panel says how many are outside', async () => {
  session.generated('ring.obj', 'annulus', '--nodes', '400');
  await open('?file=files/ring.obj');
  await drop(page, 'four.csv', 'x,y,z\n0.7,0,0.3\n0,0.7,0.3\n-0.7,0,0.3\n0,-0.7,0.3\n');
  await page.getByRole('dialog', { name: 'What is four.csv?' }).getByRole('button', { name: 'Points for ring.obj' }).click();
  await figures().filter({ hasText: 'four.csv: 4 points' }).waitFor();
  await settled(page);
  assert.equal(await page.locator('#name').textContent(), 'ring.obj');
  await page.getByLabel('Fit by').selectOption('within');
  await figures().filter({ hasText: /\d % outside/ }).waitFor();
  await legend().filter({ hasText: 'in red beyond the tolerance' }).waitFor();
  assert.equal(Number(await legend().locator('.marks span').last().textContent()), Number(await page.locator('#fit-value').inputValue()));
});

// A noisy wave of two columns, and points half a unit above it.
function wave() {
  const rows = (count, at) => `x,y\n${Array.from({ length: count }, (_, k) => at(k).join(',')).join('\n')}\n`;
  writeFileSync(join(session.folder, 'wave.csv'), rows(61, (k) => [k / 10, Math.sin(k / 9) + 0.03 * (((k * 7) % 5) / 4 - 0.5)]));
  const cloud = join(session.folder, 'above.csv');
  writeFileSync(cloud, rows(150, (k) => [0.3 + 0.036 * k, 0.5 + Math.sin((0.3 + 0.036 * k) / 0.9) + 0.04 * (((k * 13) % 7) / 6 - 0.5)]));
  return cloud;
}

test('a curve is drawn towards points, in its plane, and follows with them in a drag', async () => {
  const cloud = wave();
  await open('?file=files/wave.csv');
  const compare = (...options) => sameAsNative(6e-5, ['fit', 'wave.csv', '--points', cloud, ...options]);
  const plain = placesOf((await saved(page)).path);
  const picture = async () => (await page.locator('#canvas').screenshot()).toString('base64');
  const bare = await picture();
  await choose(page, 'Points…', cloud);
  await lastStep('Load points above.csv');
  await figures().filter({ hasText: '150 points · at most' }).waitFor();
  await settled(page);
  assert.notEqual(await picture(), bare);
  const smooth = await compare('--smoothing-length', await page.locator('#fit-value').inputValue());
  assert.ok(greatestDistance(smooth, plain) > 0.3, 'it is drawn towards them');
  assert.ok(smooth.every(([, , z]) => z === 0));

  for (const [kind, title, value] of [['within', 'Tolerance', '0.1'], ['rms', 'Root mean square', '0.06'], ['weight', 'Weight', '0.05']]) {
    await fitBy(kind, title, value);
    await settled(page);
    await compare(`--${kind}`, value);
  }
  await fitBy('within', 'Tolerance', '0.1');
  await settled(page);
  const before = await compare('--within', '0.1');

  const end = await find(page, /position fixed/, [0.02, 0.5], [0.7, 0.5]);
  const said = await figures().textContent();
  await drag(page, end, 0, -30, async () => {
    await follows(page);
    await figures().filter({ hasNotText: said }).waitFor();
  });
  const pulled = await compare('--within', '0.1');
  assert.ok(greatestDistance(pulled, before) > 0.05);
  await page.keyboard.press('Control+z');
  await settled(page);
  assert.deepEqual(await compare('--within', '0.1'), before);
});

test('a file that is dropped on a curve has points where Alt is held; else that is asked, and on an untouched example it is opened', async () => {
  wave();
  await open('?file=files/wave.csv');
  await drop(page, 'four.xyz', '1 2\n2 2\n3 2\n4 2\n', true);
  await figures().filter({ hasText: 'four.xyz: 4 points · at most' }).waitFor();
  await settled(page);
  assert.equal(await page.locator('#name').textContent(), 'wave.csv');
  const dialog = page.getByRole('dialog', { name: 'What is four.xyz?' });
  await drop(page, 'four.xyz', '1 2\n2 3\n3 2\n4 2\n');
  await dialog.getByRole('button', { name: 'Cancel' }).click();
  assert.equal(await page.locator('#name').textContent(), 'wave.csv');
  await drop(page, 'four.xyz', '1 2\n2 3\n3 2\n4 2\n');
  await dialog.waitFor();
  // On a busy machine it says so late that it was closed before.
  await dialog.evaluate((element) => element.dispatchEvent(new Event('close')));
  await dialog.getByRole('button', { name: 'A curve through its 4 rows' }).click();
  await page.locator('#name', { hasText: 'four.xyz' }).waitFor();
  await settled(page);
  assert.ok(await figures().isHidden(), 'another shape has no points');

  await page.getByLabel('Example').selectOption({ label: 'Annulus' });
  await page.locator('#name', { hasText: 'annulus.obj' }).waitFor();
  await drop(page, 'five.csv', 'x,y\n1,2\n2,3\n3,2\n4,2\n5,2\n');
  await page.locator('#size', { hasText: '5 nodes, open curve' }).waitFor();

  // Scattered points are no curve.
  await page.getByLabel('Example').selectOption({ label: 'Annulus' });
  await page.locator('#name', { hasText: 'annulus.obj' }).waitFor();
  await drop(page, 'cloud.xyz', Array.from({ length: 300 }, (_, k) => `${(k * 0.618) % 1} ${(k * 0.7548) % 1} 0\n`).join(''));
  await page.getByRole('dialog', { name: 'What is cloud.xyz?' }).getByRole('button', { name: 'Points for annulus.obj' }).click();
  await figures().filter({ hasText: 'cloud.xyz: 300 points' }).waitFor();
});

for (const [kind, file, command, count] of [['curve', 'wave.csv', 'curve', 61], ['surface', 'patch.obj', 'fair', 225]]) {
  test(`a ${kind} is fitted to its own nodes, as the native program does`, async () => {
    wave();
    session.generated('patch.obj', 'saddle', '--columns', '14', '--rows', '14', '--noise', '0.02');
    await open(`?file=files/${file}`);
    const plain = placesOf((await saved(page)).path);
    const own = page.getByRole('button', { name: 'Its own nodes' });
    await own.click();
    await lastStep('Fit to its own nodes');
    await figures().filter({ hasText: `Its own ${count} nodes · at most` }).waitFor();
    await settled(page);
    assert.ok(await own.isDisabled());
    const compare = (...options) => sameAsNative(6e-5, [command, file, ...options]);
    const length = await page.locator('#fit-value').inputValue();
    const smooth = await compare('--smoothing-length', length);
    assert.ok(greatestDistance(smooth, plain) > 1e-3 * sizeOf(plain));

    const tolerance = String(Number((0.02 * sizeOf(plain)).toPrecision(2)));
    await fitBy('within', 'Tolerance', tolerance);
    await settled(page);
    await compare('--within', tolerance);
    for (let k = 0; k < 2; ++k) await page.keyboard.press('Control+z');
    await settled(page);
    assert.deepEqual(await compare('--smoothing-length', length), smooth);
  });
}
