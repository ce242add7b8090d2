// The first minutes with a file of one's own: it opens as it is, ways are tried on it, and nothing that was done is lost.

import assert from 'node:assert/strict';
import { readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { choose, drag, drop, find, greatestDistance, keep, native, open, page, placesOf, rulesOf, saved, session, settled, useSession } from './support.mjs';

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

// From the nodes of each of two surfaces to the other one.
function surfaceDistance(path, other) {
  const report = join(session.folder, 'measured.json');
  native('measure', path, '--compare', other, '--report', report);
  const { to_other: there, from_other: back } = JSON.parse(readFileSync(report, 'utf8')).distance;
  return Math.max(there.greatest, back.greatest);
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
  await says(/^Moves [\d,]+ nodes: the shape by at most [\d.]+, nodes along it by up to [\d.]+\. Its noise seems to be [\d.]+\.$/);
  const tolerance = await page.getByLabel('Tolerance', { exact: true }).inputValue();
  const [, noise] = (await page.locator('#start-says').textContent()).match(/be ([\d.]+)\./);
  assert.ok(Math.abs(Number(tolerance) - 3 * Number(noise)) < 0.1 * Number(tolerance), `${tolerance}, ${noise}`);
  assert.equal(await way('Shaded').getAttribute('aria-pressed'), 'true', 'the smooth shape itself is seen');
  await undo().and(page.locator('[title*="Undo: what is tried"]')).click();
  assert.ok(await undo().isDisabled(), 'what was tried was no step');
  await settled(page);
  assert.deepEqual(placesOf((await saved(page)).path), input);

  await page.keyboard.press('s');
  await says('Moves');
  await way('Zebra').click();
  const entry = page.getByLabel('Tolerance', { exact: true });
  const enter = async (text) => {
    await entry.fill(text);
    await entry.press('Enter');
  };
  await entry.press('Control+a');
  assert.equal(await page.locator('#picked').textContent(), 'No node picked');
  for (const [text, told] of [['', /^Give a length above 0/], ['-1', /^Give a length above 0/], ['5 mm', /^Choose the unit of the file below/]]) {
    await enter(text);
    await page.getByRole('alert').filter({ hasText: told }).waitFor();
    assert.ok(await way('Apply').isDisabled());
  }
  await page.getByLabel('Unit').selectOption('m');
  for (const [act, shown] of [[() => enter('0.000562341 m'), '0.000562341 m'], [() => enter('30 mm'), '0.03 m'], [() => entry.press('ArrowUp'), '0.0315 m'], [() => page.locator('#start .less').click(), '0.0299 m'], [() => enter('0,03'), '0.03 m']]) {
    await act();
    assert.equal(await entry.inputValue(), shown);
    assert.ok(await entry.evaluate((one) => one.scrollWidth <= one.clientWidth), `${shown} is seen whole`);
  }
  assert.ok(await page.getByRole('alert').isHidden());
  // What nodes keep of their places: the shape is the same, and so is what is said of it.
  const shape = () => says(/the shape by at most/);
  await shape();
  const free = placesOf((await saved(page)).path);
  const [, slid] = (await page.locator('#start-says').textContent()).match(/nodes along it by up to ([\d.]+) m/);
  const stay = page.getByLabel('Its nodes');
  await stay.selectOption('stay along it');
  await says(/none by more than [\d.]+ m, and none along the shape/);
  const straight = placesOf((await saved(page)).path);
  assert.ok(greatestDistance(straight, input) < 0.03 + 1e-9 && greatestDistance(straight, input) > 0.01);
  const back = greatestDistance(straight, free);
  assert.ok(slid > 0.0005 && Math.abs(back - slid) < 0.05 * slid, `${back} of ${slid}`);
  await stay.selectOption('keep their x');
  await says(/and each keeps its x/);
  assert.deepEqual(placesOf((await saved(page)).path).map(([x]) => x), input.map(([x]) => x));
  await stay.selectOption('may slide along it');
  await shape();
  await settled(page);
  await keep(page);
  assert.equal(await way('Zebra').getAttribute('aria-pressed'), 'true', 'the view that was chosen stays');
  assert.match(await undo().getAttribute('title'), /Undo: Smooth within 0\.03/);
  const smooth = placesOf((await saved(page)).path);
  assert.equal(await page.locator('#status').textContent(), 'Saved as patch-fair.obj');
  await way('Mean').click();
  await page.locator('#legend .marks').filter({ hasText: '−' }).waitFor();
  assert.doesNotMatch(await page.locator('#legend .marks').textContent(), /-/);
  assert.ok(greatestDistance(smooth, nativelyFair(file, '--within', '0.03', '--distribution', 'keep')) < 6e-4);
  await undo().click();
  await settled(page);
  assert.deepEqual(placesOf((await saved(page)).path), input);
});

test('sharp edges stay where they are as the faces between are smoothed, unless the slider says that none do', async () => {
  const cells = 8;
  let state = 7;
  const random = () => (state = (state * 16807) % 2147483647) / 2147483647 - 0.5;
  const [numbers, lines, faces] = [new Map(), [], []];
  const node = (...at) => {
    if (!numbers.has(String(at))) lines.push(`v ${at.map((part) => part / cells + 0.02 * random()).join(' ')}`);
    if (!numbers.has(String(at))) numbers.set(String(at), lines.length);
    return numbers.get(String(at));
  };
  for (const [end, sense] of [[0, -1], [cells, 1]]) for (let axis = 0; axis < 3; ++axis) for (let i = 0; i < cells; ++i) for (let j = 0; j < cells; ++j) {
    const corner = (u, v) => node(...[[end, u, v], [v, end, u], [u, v, end]][axis]);
    const face = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
    faces.push(`f ${(sense > 0 ? face : face.reverse()).join(' ')}`);
  }
  await open('', { untouched: true });
  await drop(page, 'box.obj', `${lines.join('\n')}\n${faces.join('\n')}\n`);
  await page.locator('#name', { hasText: 'box.obj' }).waitFor();
  await settled(page);
  const input = lines.map((line) => line.split(' ').slice(1).map(Number));
  const onEdge = [...numbers.keys()].map((at) => at.split(',').filter((part) => part === '0' || part === String(cells)).length > 1);
  const moved = async () => placesOf((await saved(page)).path).map((place, n) => greatestDistance([place], [input[n]]));
  await way('Smooth it').click();
  await says(`Keeps ${onEdge.filter(Boolean).length} nodes at sharp edges`);
  await settled(page);
  const held = await moved();
  assert.equal(Math.max(...held.filter((_, n) => onEdge[n])), 0);
  assert.ok(held.filter((far, n) => !onEdge[n] && far > 1e-4).length > 0.9 * onEdge.filter((is) => !is).length);
  await page.getByLabel('Edges stay over').fill('180');
  await page.locator('#start-says', { hasText: /^Moves (?!.*Keeps)/ }).waitFor();
  await settled(page);
  assert.ok((await moved()).filter((far, n) => onEdge[n] && far > 1e-4).length > 0.9 * onEdge.filter(Boolean).length);
});

test('smooth, repair and pull go in any order, each from what came before and with its own undo; what moves nothing says so', async () => {
  const file = session.generated('plate.obj', 'saddle', '--columns', '30', '--rows', '30', '--noise', '0.01');
  await open('?file=files/plate.obj', { untouched: true });
  const shapes = [placesOf(file)];
  const moved = () => shapes.at(-1).flatMap((place, n) => (greatestDistance([place], [shapes.at(-2)[n]]) > 1e-12 ? [n] : []));
  const done = async (title) => {
    await undo().and(page.locator(`[title*="${title}"]`)).waitFor();
    await settled(page);
    shapes.push(placesOf((await saved(page)).path));
  };
  const tried = () => says(/^Moves [1-9]\d* nodes[:,]/);
  const byItsRules = async () => {
    const rules = join(session.folder, 'rules.json');
    writeFileSync(rules, await rulesOf(page));
    return nativelyFair(file, '--constraints', rules);
  };
  const all = shapes[0].length;

  await way('Smooth it').click();
  await tried();
  await way('Apply').click();
  await done('Smooth');
  assert.ok(moved().length > all / 2);

  await way('Repair a part').click();
  await says('Paint over what is to be repaired');
  const painted = [];
  for (const x of [0.3, 0.46]) {
    await paint([x, 0.5], [x + 0.04, 0.5]);
    await tried();
    await way('Apply').click();
    await done('Repair');
    painted.push(moved());
    await says('Paint over what is to be repaired');
  }
  for (const nodes of painted) assert.ok(nodes.length > 3 && nodes.length < all / 10, `${nodes}`);
  assert.ok(!painted[0].some((n) => painted[1].includes(n)), 'the second repair leaves the first one as it is');
  assert.ok(greatestDistance(shapes.at(-1), await byItsRules()) < 1e-12);

  // What is tried is kept as a node is pulled.
  await way('Smooth it').click();
  await page.getByLabel('Tolerance', { exact: true }).fill('0.002');
  await page.getByLabel('Tolerance', { exact: true }).press('Enter');
  await tried();
  const { x, y, node } = await find(page, /Node \d+ /, [0.36, 0.62], [0.42, 0.66]);
  await page.mouse.click(x, y);
  await drag(page, { x, y }, 0, -30);
  await done('Move node');
  const far = (n) => Math.hypot(...shapes.at(-1)[n].map((part, i) => part - shapes[3][n][i]));
  const near = [...shapes[0].keys()].filter((n) => Math.hypot(...shapes[0][n].map((part, i) => part - shapes[0][node][i])) < 0.15);
  assert.ok(near.length > 4 && near.every((n) => far(n) > 0.4 * far(node)), 'what is next to the node goes along');
  // The program starts from the noise, the session from the smooth shape: free nodes lie elsewhere along the same surface.
  const edge = 2 / 30;
  const faired = await byItsRules();
  assert.ok(greatestDistance(shapes.at(-1), faired) < 0.1 * edge);
  assert.ok(surfaceDistance((await saved(page)).path, join(session.folder, 'fair.obj')) < 0.01 * edge);
  await undo().click();
  await undo().and(page.locator('[title*="Smooth within 0.002"]')).waitFor();
  await undo().click();
  shapes.pop();

  await page.keyboard.press('w');
  await paint([0.36, 0.6], [0.42, 0.66]);
  await way('Fair only these nodes').click();
  await done('Fair only');
  assert.ok(moved().length > 3 && moved().length < all / 10);
  for (const expected of shapes.slice(0, -1).reverse()) {
    await undo().click();
    await settled(page);
    assert.ok(greatestDistance(placesOf((await saved(page)).path), expected) < 1e-12);
  }

  await page.keyboard.press('Control+a');
  await page.keyboard.press('f');
  await way('Fair only these nodes').click();
  await page.locator('#status', { hasText: 'Nothing moves: all of it is held' }).waitFor();
});

test('undo in a repair takes back its strokes, and only then what was applied', async () => {
  const input = placesOf(session.generated('plate.obj', 'saddle', '--columns', '30', '--rows', '30', '--noise', '0.01'));
  await open('?file=files/plate.obj', { untouched: true });
  const picked = () => page.locator('#picked').textContent();
  const stroke = async (x) => {
    await paint([x, 0.5], [x + 0.04, 0.5]);
    await undo().and(page.locator('[title*="Undo: stroke"]')).waitFor();
    await says(/^Moves [1-9]\d* nodes, at most by/);
  };
  await way('Repair a part').click();
  await stroke(0.3);
  await way('Apply').click();
  await undo().and(page.locator('[title*="Undo: Repair"]')).waitFor();
  await stroke(0.4);
  const one = await picked();
  await stroke(0.5);
  const both = await picked();
  assert.notEqual(one, both);
  await undo().click();
  assert.equal(await picked(), one);
  await page.getByRole('button', { name: 'Redo' }).click();
  assert.equal(await picked(), both);
  await says(/^Moves [1-9]\d* nodes, at most by/);
  for (let k = 0; k < 2; ++k) await undo().click();
  assert.equal(await picked(), 'No node picked');
  await undo().and(page.locator('[title*="Undo: Repair"]')).click();
  await says('Paint over what is to be repaired');
  await page.locator('#status', { hasText: 'As it is in the file' }).waitFor();
  assert.deepEqual(placesOf((await saved(page)).path), input);
  await stroke(0.4);
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
