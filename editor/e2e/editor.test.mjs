// The editor as somebody uses it: real pointer and keys, files in and out, and the native program's result to compare with.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { beforeEach, test } from 'node:test';
import { choose, drag, drop, faults, find, follows, greatestDistance, native, open, page, placesOf, root, rulesOf, saved, session, settled, solving, useSession, visit } from './support.mjs';

useSession();
beforeEach(() => open());

const leftRim = [[0.02, 0.55], [0.5, 0.55]];
const inside = [[0.5, 0.7], [0.5, 0.6]];

async function loadConstraints(rules) {
  await choose(page, 'Load…', { name: 'rules.json', text: rules });
  // The file is read, and then what it says is held: undo is for that.
  await page.locator('[title^="Undo: Load constraints"]').waitFor();
  await settled(page);
}

test('a node is dragged, undone and redone; the file is what the native program makes of the same constraints', async () => {
  await page.getByLabel('Example').selectOption({ label: 'Annulus' });
  await settled(page);
  const untouched = await rulesOf(page);
  const held = await find(page, /position fixed/, ...leftRim);
  await drag(page, held, -20, -60);
  const dragged = await rulesOf(page);
  const rule = JSON.parse(dragged).rules.at(-1);
  assert.deepEqual(rule.nodes, [held.node]);

  assert.match(await page.getByRole('button', { name: 'Undo' }).getAttribute('title'), new RegExp(`Move node ${held.node}`));
  await page.keyboard.press('Control+z');
  await settled(page);
  assert.equal(await rulesOf(page), untouched);
  assert.ok(await page.getByRole('button', { name: 'Undo' }).isDisabled());
  const before = placesOf((await saved(page, 'obj')).path);
  await page.getByRole('button', { name: 'Redo' }).click();
  await settled(page);
  assert.equal(await rulesOf(page), dragged);

  const { name, path } = await saved(page, 'obj');
  assert.equal(name, 'annulus-fair.obj');
  const rules = join(session.folder, 'rules.json');
  const fair = join(session.folder, 'fair.obj');
  writeFileSync(rules, dragged);
  native('fair', join(root, 'examples/annulus.obj'), '-o', fair, '--constraints', rules, '--quiet');
  const [ours, theirs] = [path, fair].map(placesOf);
  assert.ok(greatestDistance(ours, theirs) < 6e-5, `${greatestDistance(ours, theirs)}`);  // six times the tolerance of 1e-5, on a size of some 2.4
  assert.deepEqual(ours[held.node], rule.position[0]);
  assert.ok(greatestDistance(ours, before) > 0.05, 'the surface has followed');

  await page.reload();
  await settled(page);
  await loadConstraints(dragged);
  assert.deepEqual(readFileSync((await saved(page, 'obj')).path), readFileSync(path), 'the same bits without the drag');
});

test('a node inside is picked and fixed by key, dragged, freed again; constraints are loaded from a file', async () => {
  const free = await find(page, /free/, ...inside);
  await page.mouse.click(free.x, free.y);
  assert.equal(await page.locator('#picked').textContent(), `Node ${free.node}`);
  await page.keyboard.press('f');
  await settled(page);
  await drag(page, free, 0, -12);
  const rules = await rulesOf(page);
  assert.deepEqual(JSON.parse(rules).rules.at(-1).nodes, [free.node]);

  await page.keyboard.press('Shift+F');
  await settled(page);
  assert.equal(JSON.parse(await rulesOf(page)).rules.at(-1).position, 'free');

  await loadConstraints(rules);
  assert.equal(await rulesOf(page), rules);
});

test('a drag that is given up leaves nothing behind, and dragging elsewhere turns the view', async () => {
  const rules = await rulesOf(page);
  const held = await find(page, /position fixed/, ...leftRim);
  await page.mouse.move(held.x, held.y);
  await page.mouse.down();
  await page.mouse.move(held.x - 30, held.y - 30);
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await settled(page);
  assert.equal(await rulesOf(page), rules);
  await page.mouse.move(300, 600);
  await page.mouse.down();
  await page.mouse.move(400, 560);
  await page.mouse.up();
  assert.equal(await rulesOf(page), rules);
  await page.mouse.move(held.x, held.y);
  const there = await page.locator('#node').textContent();
  assert.notEqual(there, `Node ${held.node} · position fixed`);
});

test('the shape follows while the button is down', async () => {
  const held = await find(page, /position fixed/, ...leftRim);
  await page.mouse.down();
  for (let k = 1; k <= 5; ++k) await page.mouse.move(held.x - 8 * k, held.y - 8 * k);
  await follows(page);
  await page.locator('#status', { hasText: /Following · nodes moved at most/ }).waitFor();
  await page.mouse.up();
  await page.locator('#status', { hasText: /^Done · nodes moved at most [\d.]+ \([\d.]+ % of the size\)$/ }).waitFor();
});

test('a long solution is cancelled: the last shape stays, and that is what is saved', async () => {
  const file = session.generated('large.obj', 'annulus', '--nodes', '120000', '--noise', '0.02');
  await page.goto(`${session.address}?file=files/large.obj`);
  await page.locator('#size', { hasText: '120,000 nodes' }).waitFor();
  await solving(page);
  await page.getByRole('button', { name: 'Cancel' }).click();
  await settled(page, 'cancelled');
  assert.doesNotMatch(await page.locator('#status').textContent(), /Infinity/);
  assert.match(await page.locator('#status').textContent(), /Stopped, the last shape stays · moved nothing/);
  assert.deepEqual(placesOf((await saved(page)).path), placesOf(file));
});

test('boundary normals change the shape; the boundary set free is refused in the words of the library, and undone', async () => {
  const before = placesOf((await saved(page, 'obj')).path);
  const normals = page.getByRole('button', { name: 'Normals fixed' });
  await normals.click();
  await settled(page);
  assert.equal(await normals.getAttribute('aria-pressed'), 'true');
  const shape = placesOf((await saved(page, 'obj')).path);
  assert.ok(greatestDistance(before, shape) > 0.05);
  await page.getByRole('button', { name: 'Positions fixed' }).click();
  await page.getByRole('alert').filter({ hasText: 'nothing holds the component' }).waitFor();
  await page.keyboard.press('z');
  await settled(page);
  await page.getByRole('alert').waitFor({ state: 'hidden' });
});

test('files: every format comes out; a malformed one is named and leaves the surface open', async () => {
  for (const [format, begin] of [['off', /^OFF/], ['ply', /^ply/], ['stl', /./s]]) {
    const { name, path } = await saved(page, format);
    assert.equal(name, `annulus-fair.${format}`);
    assert.match(readFileSync(path, 'latin1'), begin);
  }
  await choose(page, 'Open…', { name: 'bad.obj', text: 'v 0 0 0\nv 1 0 zero\n' });
  const alert = page.getByRole('alert');
  await alert.filter({ hasText: /bad\.obj:2: .*zero/ }).waitFor();
  assert.match(await page.locator('#name').textContent(), /annulus/);
  await page.getByRole('button', { name: 'Dismiss' }).click();
  await alert.waitFor({ state: 'hidden' });
  await page.keyboard.press('Control+s');

  const address = `${session.address}?file=files/none.obj`;
  await page.goto(address);
  await alert.filter({ hasText: 'none.obj cannot be read: the server answers 404' }).waitFor();
  faults.length = 0;  // the console says so too
});

test('opens a file that an address names, and one that is dropped', async () => {
  session.generated('patch.ply', 'saddle', '--columns', '12', '--rows', '12', '--faces', 'mixed');
  await visit(page, `${session.address}?file=files/patch.ply`);
  assert.equal(await page.locator('#name').textContent(), 'patch.ply');
  await drop(page, 'tent.obj', 'v 0 0 0\nv 2 0 0\nv 0 2 0\nv 1 1 1\nf 1 2 4\nf 2 3 4\nf 3 1 4\n');
  await page.locator('#name', { hasText: 'tent.obj' }).waitFor();
  await settled(page);
  assert.match(await page.locator('#size').textContent(), /4 nodes, 3 faces/);
});

test('both themes draw, and reflection lines move with the view', async () => {
  const picture = async () => (await page.locator('#canvas').screenshot()).toString('base64');
  const light = await picture();
  await page.keyboard.press('t');
  assert.notEqual(await picture(), light);
  await page.keyboard.press('3');
  const zebra = await picture();
  await page.mouse.move(300, 600);
  await page.mouse.down();
  await page.mouse.move(360, 580);
  await page.mouse.up();
  assert.notEqual(await picture(), zebra);
});
