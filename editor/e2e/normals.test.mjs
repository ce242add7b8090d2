// Normals as arrows that turn, ways of dragging, and numbers: with the pointer and keys, against the native program.

import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { beforeEach, test } from 'node:test';
import { drag, find, follows, greatestDistance, native, open, page, placesOf, root, rulesOf, saved, session, settled, useSession } from './support.mjs';

useSession();
beforeEach(() => open());

const leftRim = [[0.02, 0.55], [0.5, 0.55]];

function pickedHeld() {
  return find(page, /position fixed/, ...leftRim).then(async (held) => {
    await page.mouse.click(held.x, held.y);
    return held;
  });
}

/** Where the head of the arrow at a node is, near the line up from it. */
async function headOf({ x, y, node }) {
  for (let up = 20; up <= 80; up += 2) {
    for (const aside of [0, -8, 8, -16, 16]) {
      await page.mouse.move(x + aside, y - up);
      if ((await page.locator('#node').textContent()).startsWith(`Normal of node ${node} `)) return { x: x + aside, y: y - up };
    }
  }
  throw new Error(`no arrow at node ${node}`);
}

async function sameAsNative(rules, tolerance = 6e-5) {
  const [file, fair] = ['rules.json', 'fair.obj'].map((name) => join(session.folder, name));
  writeFileSync(file, rules);
  native('fair', join(root, 'examples/annulus.obj'), '-o', fair, '--constraints', file, '--quiet');
  const [ours, theirs] = [(await saved(page)).path, fair].map(placesOf);
  assert.ok(greatestDistance(ours, theirs) < tolerance, `${greatestDistance(ours, theirs)}`);
  return ours;
}

test('tilt a normal', async () => {
  const held = await pickedHeld();
  await page.keyboard.press('n');
  await settled(page);
  const untouched = await rulesOf(page);
  const before = await sameAsNative(untouched);
  const head = await headOf(held);
  const normal = async () => Promise.all(['x', 'y', 'z'].map((axis) => page.getByLabel(`Normal ${axis}`).inputValue().then(Number)));
  const given = await normal();

  await page.mouse.down();
  for (let k = 1; k <= 6; ++k) await page.mouse.move(head.x - 4 * k, head.y);
  await follows(page);
  await page.mouse.up();
  await settled(page);
  assert.match(await page.getByRole('button', { name: 'Undo' }).getAttribute('title'), new RegExp(`Tilt normal of node ${held.node}`));
  const rules = await rulesOf(page);
  const rule = JSON.parse(rules).rules.at(-1);
  assert.deepEqual(rule.nodes, [held.node]);
  const [tilted] = rule.normal;
  assert.ok(Math.abs(Math.hypot(...tilted) - 1) < 1e-9);
  assert.ok(Math.hypot(...tilted.map((part, i) => part - given[i])) > 0.2, 'it has turned');
  assert.ok((await normal()).every((part, i) => Math.abs(part - tilted[i]) < 1e-5), 'the fields say so');
  const after = await sameAsNative(rules);
  assert.ok(greatestDistance(before, after) > 1e-3, 'the surface has followed');

  await page.keyboard.press('Control+z');
  await settled(page);
  assert.equal(await rulesOf(page), untouched);
  await headOf(held);
});

test('picked normals tilt together; a tilt that is given up leaves nothing behind', async () => {
  const held = await pickedHeld();
  await page.keyboard.press('l');
  await page.keyboard.press('n');
  await settled(page);
  const untouched = await rulesOf(page);
  const head = await headOf(held);
  await page.mouse.down();
  await page.mouse.move(head.x - 20, head.y - 5);
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await settled(page);
  assert.equal(await rulesOf(page), untouched);

  await drag(page, await headOf(held), -15, 3);
  const rule = JSON.parse(await rulesOf(page)).rules.at(-1);
  assert.ok(rule.nodes.length > 10);
  const [first] = rule.normal;
  const bounds = rule.normal.map((normal) => Math.hypot(...normal));
  assert.ok(bounds.every((length) => Math.abs(length - 1) < 1e-9));
  assert.ok(Math.hypot(first[0], first[1]) > 0.1);
  await sameAsNative(await rulesOf(page));
});

test('a normal and a position are given by numbers', async () => {
  const held = await pickedHeld();
  await page.getByLabel('Normal x').fill('0.5');
  await page.getByLabel('Normal z').fill('1');
  await page.getByLabel('Normal z').press('Enter');
  await settled(page);
  assert.deepEqual(JSON.parse(await rulesOf(page)).rules.at(-1), { nodes: [held.node], normal: [[0.5, 0, 1]] });
  await page.getByLabel('Position z').fill('0.25');
  await page.getByLabel('Position z').press('Enter');
  await page.locator('[title*="Undo: Move node"]').waitFor();
  await settled(page);
  const rules = await rulesOf(page);
  const { nodes, position } = JSON.parse(rules).rules.find((rule) => Array.isArray(rule.position));
  assert.deepEqual([nodes, position[0][2]], [[held.node], 0.25]);
  const ours = await sameAsNative(rules);
  assert.equal(ours[held.node][2], 0.25);

  await page.getByLabel('Normal x').fill('much');
  await page.getByLabel('Normal x').press('Enter');
  assert.equal(await page.getByLabel('Normal x').getAttribute('aria-invalid'), 'true');
  assert.equal(await rulesOf(page), rules);

  await page.locator('#canvas').focus();
  await page.keyboard.press('l');
  await page.getByLabel('Move by y').fill('0.125');
  await page.getByLabel('Move by y').press('Enter');
  await settled(page);
  assert.match(await page.getByRole('button', { name: 'Undo' }).getAttribute('title'), /Move \d+ nodes/);
  const moved = await sameAsNative(await rulesOf(page));
  assert.ok(Math.abs(moved[held.node][1] - ours[held.node][1] - 0.125) < 1e-9);
});

test('a node is dragged along an axis or its normal, as a key says', async () => {
  const held = await pickedHeld();
  const start = placesOf((await saved(page)).path)[held.node];
  const way = page.locator('#way');
  const dragged = async (...keys) => {
    await page.mouse.move(held.x, held.y);
    await page.mouse.down();
    await page.mouse.move(held.x - 20, held.y - 20);
    for (const key of keys) await page.keyboard.press(key);
    const said = await way.textContent();
    await page.mouse.move(held.x - 40, held.y - 6);
    await page.mouse.up();
    await settled(page);
    assert.ok(await way.isHidden());
    const place = JSON.parse(await rulesOf(page)).rules.findLast(({ position }) => Array.isArray(position)).position[0];
    await page.keyboard.press('Control+z');
    await settled(page);
    return { said, way: place.map((part, i) => part - start[i]) };
  };
  for (const [i, key] of ['x', 'y', 'z'].entries()) {
    const { said, way: gone } = await dragged(key);
    assert.match(said, new RegExp(`Along ${key.toUpperCase()}`));
    assert.ok(gone.every((part, k) => (k === i ? Math.abs(part) > 0.01 : part === 0)), `${key}: ${gone}`);
  }
  const free = await dragged('x', 'x');
  assert.match(free.said, /plane of the view/);
  assert.ok(free.way.every((part) => part !== 0));

  await page.getByLabel('Normal x').fill('3');
  await page.getByLabel('Normal z').fill('4');
  await page.getByLabel('Normal z').press('Enter');
  await settled(page);
  await page.evaluate(() => document.activeElement.blur());
  const along = (await dragged('n')).way;
  assert.ok(Math.abs(along[0] * 4 - along[2] * 3) < 1e-9 && Math.abs(along[1]) < 1e-12 && Math.abs(along[2]) > 0.01, `${along}`);
});
