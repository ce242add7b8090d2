// The first minutes with a file of one's own: it opens as it is, ways are tried on it, and nothing that was done is lost.

import assert from 'node:assert/strict';
import { statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { choose, drop, find, greatestDistance, keep, native, open, page, placesOf, rulesOf, saved, session, settled, useSession } from './support.mjs';

useSession();

const says = (text) => page.locator('#start-says', { hasText: text }).waitFor();
const way = (name) => page.getByRole('button', { name });
const undo = () => page.getByRole('button', { name: 'Undo' });

// With the brush, from a place to another one, as shares of the view.
async function paint(from, to) {
  const box = await page.locator('#canvas').boundingBox();
  const at = ([x, y]) => [box.x + x * box.width, box.y + y * box.height];
  await page.mouse.move(...at(from));
  await page.mouse.down();
  await page.mouse.move(...at(to), { steps: 6 });
  await page.mouse.up();
}

function nativelyFair(input, ...options) {
  const out = join(session.folder, 'fair.obj');
  native('fair', input, '-o', out, '--quiet', ...options);
  return placesOf(out);
}

async function until(holds) {
  while (!holds()) await new Promise((done) => setTimeout(done, 20));
}

test('a file opens as it is; smoothing is suggested from its noise, tried, given up, kept and undone', async () => {
  const file = session.generated('patch.obj', 'saddle', '--columns', '24', '--rows', '24', '--noise', '0.01');
  const input = placesOf(file);
  await open('?file=files/patch.obj', { untouched: true });
  assert.equal(await page.locator('#status').textContent(), 'As it is in the file');
  assert.deepEqual(placesOf((await saved(page)).path), input);

  await way('Smooth it').click();
  await says(/^Moves [\d,]+ nodes, within [\d.]+\. Its noise seems to be [\d.]+\.$/);
  const tolerance = await page.getByLabel('Tolerance', { exact: true }).inputValue();
  const [, noise] = (await page.locator('#start-says').textContent()).match(/be ([\d.]+)\./);
  assert.ok(Math.abs(Number(tolerance) - 3 * Number(noise)) < 0.1 * Number(tolerance), `${tolerance}, ${noise}`);
  await page.locator('#legend', { hasText: 'Deviation from the input' }).waitFor();
  assert.ok(await undo().isDisabled(), 'what is tried is no step yet');
  await way('Not this').click();
  await settled(page);
  assert.deepEqual(placesOf((await saved(page)).path), input);

  await way('Smooth it').click();
  await page.getByLabel('Tolerance', { exact: true }).fill('0.03');
  await page.getByLabel('Tolerance', { exact: true }).press('Enter');
  await keep(page);
  assert.match(await undo().getAttribute('title'), /Undo: Smooth within 0\.03/);
  const smooth = placesOf((await saved(page)).path);
  assert.ok(greatestDistance(smooth, nativelyFair(file, '--within', '0.03', '--distribution', 'keep')) < 6e-4);
  await undo().click();
  await settled(page);
  assert.deepEqual(placesOf((await saved(page)).path), input);
});

test('regions accumulate, each with its own undo; what moves nothing says so', async () => {
  const file = session.generated('plate.obj', 'saddle', '--columns', '30', '--rows', '30', '--noise', '0.01');
  const input = placesOf(file);
  await open('?file=files/plate.obj', { untouched: true });
  await way('Repair a part').click();
  await says('Paint over what is to be repaired');
  await paint([0.3, 0.5], [0.34, 0.5]);
  await says(/^Moves [1-9]\d* nodes, at most by/);
  await way('Apply').click();
  await undo().and(page.locator('[title*="Repair"]')).waitFor();
  const one = placesOf((await saved(page)).path);
  const moved = (a, b) => a.flatMap((place, n) => (greatestDistance([place], [b[n]]) > 1e-12 ? [n] : []));
  const first = moved(one, input);
  assert.ok(first.length > 3);

  await says('Paint over what is to be repaired');
  await paint([0.46, 0.5], [0.5, 0.5]);
  await says(/^Moves [1-9]\d* nodes, at most by/);
  await way('Apply').click();
  await undo().and(page.locator('[title*="Repair"]')).waitFor();
  await way('Done').click();
  await settled(page);
  const two = placesOf((await saved(page)).path);
  for (const n of first) assert.deepEqual(two[n], one[n], 'the first region stays as it was repaired');
  assert.ok(moved(two, one).length > 3, 'the second one has moved');
  const rules = join(session.folder, 'rules.json');
  writeFileSync(rules, await rulesOf(page));
  assert.ok(greatestDistance(two, nativelyFair(file, '--constraints', rules)) < 6e-5);

  // As by the button that fairs what is picked.
  await page.keyboard.press('w');
  await paint([0.36, 0.6], [0.42, 0.66]);
  await way('Fair only these nodes').click();
  await undo().and(page.locator('[title*="Fair only"]')).waitFor();
  await settled(page);
  const three = placesOf((await saved(page)).path);
  assert.ok(moved(three, two).length > 3);
  for (const n of first) assert.deepEqual(three[n], one[n]);
  for (const expected of [two, one, input]) {
    await undo().click();
    await settled(page);
    assert.ok(greatestDistance(placesOf((await saved(page)).path), expected) < 1e-12);
  }

  await page.keyboard.press('Control+a');
  await page.keyboard.press('f');
  await way('Fair only these nodes').click();
  await page.locator('#status', { hasText: 'Nothing moves: all of it is held' }).waitFor();
});

test('what was open is brought back by undo: by a file, an example and a new curve over it', async () => {
  session.generated('mine.obj', 'saddle', '--columns', '10', '--rows', '10', '--noise', '0.01');
  await open('?file=files/mine.obj');
  const mine = placesOf((await saved(page)).path);
  const back = async () => {
    await undo().click();
    await page.locator('#name', { hasText: 'mine.obj' }).waitFor();
    await settled(page);
    assert.deepEqual(placesOf((await saved(page, 'obj')).path), mine);
  };
  await drop(page, 'tent.obj', 'v 0 0 0\nv 2 0 0\nv 0 2 0\nv 1 1 1\nf 1 2 4\nf 2 3 4\nf 3 1 4\n');
  await page.locator('#name', { hasText: 'tent.obj' }).waitFor();
  assert.match(await undo().getAttribute('title'), /Undo: Open tent\.obj/);
  await back();
  assert.match(await page.getByRole('button', { name: 'Redo' }).getAttribute('title'), /Redo: Open tent\.obj/);
  await page.getByLabel('Example').selectOption({ label: 'Annulus' });
  await page.locator('#name', { hasText: 'annulus.obj' }).waitFor();
  await back();
  await page.getByRole('button', { name: 'New curve' }).click();
  await page.keyboard.press('Escape');
  await back();
});

test('a closed shape opens without a fault; only what can be done is offered', async () => {
  session.generated('ring.ply', 'torus', '--columns', '30', '--rows', '16', '--noise', '0.01');
  await open('?file=files/ring.ply', { untouched: true });
  assert.ok(await page.getByRole('alert').isHidden());
  assert.match(await way('Free form').textContent(), /needs a boundary or fixed nodes/);
  assert.ok(await way('Free form').isDisabled());
  await way('Smooth it').click();
  await keep(page);
  assert.ok(await page.getByRole('alert').isHidden());
});

test('what is opened is named at once, with its size and how far it is', async () => {
  const file = session.generated('large.ply', 'annulus', '--nodes', '90000');
  await open('', { untouched: true });
  let answer;
  await page.route('**/files/large.ply', (route) => { answer = () => route.fulfill({ path: file, headers: { 'Content-Length': String(statSync(file).size) } }); });
  await page.goto(`${session.address}?file=files/large.ply`);
  const card = page.locator('#loading');
  await card.filter({ hasText: /^large\.ply reading$/ }).waitFor();
  await page.evaluate(() => {
    const card = document.getElementById('loading');
    window.told = [];
    new MutationObserver(() => window.told.push(card.textContent.trim())).observe(card, { subtree: true, childList: true, characterData: true });
  });
  await until(() => answer);
  await answer();
  await page.locator('#size', { hasText: '90,000 nodes' }).waitFor();
  await card.waitFor({ state: 'hidden' });
  const told = await page.evaluate(() => window.told);
  for (const text of [/^large\.ply [\d.]+ MB · reading its nodes and faces$/, /^large\.ply [\d.]+ MB · 90,000 nodes, drawing$/]) assert.ok(told.some((line) => text.test(line)), `${text} in ${told}`);
});
