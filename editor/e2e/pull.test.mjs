// Free nodes that are pulled, how far that reaches, and the ways to turn the view.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { drag, expectSameAsNative, find, native, open, page, picture, placesOf, rulesOf, saved, session, settled, useSession } from './support.mjs';

useSession();

const undo = () => page.getByRole('button', { name: 'Undo' });
const distance = (a, b) => Math.hypot(...a.map((part, i) => part - b[i]));

test('a node of a curve that is as in its file is pulled: it is fixed there, and only what is near goes along, as far as the slider says', async () => {
  const wave = Array.from({ length: 81 }, (_, k) => [k / 10, Math.sin(k / 9)]);
  writeFileSync(join(session.folder, 'line.csv'), `x,y\n${wave.map((row) => row.join(',')).join('\n')}\n`);
  await open('?file=files/line.csv', { untouched: true });
  const input = placesOf((await saved(page)).path);
  const pulled = async () => {
    const node = await find(page, /free/, [0.3, 0.02], [0.3, 0.98]);
    await drag(page, node, 0, -60);
    await undo().and(page.locator(`[title*="Move node ${node.node}"]`)).waitFor();
    await settled(page);
    assert.match(await page.locator('#status').textContent(), /^Done · the curve moved at most [\d.]+ \(/);
    const shape = placesOf((await saved(page)).path);
    const moved = input.flatMap((place, n) => (distance(place, shape[n]) > 1e-9 ? [distance(place, input[node.node])] : []));
    assert.ok(distance(shape[node.node], input[node.node]) > 0.3, 'it is where it was pulled to');
    return { reach: Math.max(...moved), count: moved.length };
  };
  const near = await pulled();
  const size = Math.hypot(8, 2);
  assert.ok(near.reach <= 0.15 * size + 0.2 && near.count > 5, `${near.reach}`);
  const rules = join(session.folder, 'rules.json');
  writeFileSync(rules, await rulesOf(page));
  const [ours, out] = [placesOf((await saved(page)).path), join(session.folder, 'out.csv')];
  native('curve', join(session.folder, 'line.csv'), '-o', out, '--constraints', rules, '--quiet');
  placesOf(out).forEach((place, n) => assert.ok(distance(place, ours[n]) < 1e-3, `node ${n}`));
  await undo().click();
  await settled(page);
  assert.deepEqual(placesOf((await saved(page)).path), input);

  await page.getByLabel('A pull reaches').fill('40');
  const far = await pulled();
  assert.ok(far.reach > 1.5 * near.reach && far.reach <= 0.4 * size + 0.2, `${near.reach}, ${far.reach}`);
});

test('a picked free node of a surface is pulled, and the whole surface goes along; a node that is not picked turns the view', async () => {
  const input = session.generated('ring.obj', 'annulus', '--nodes', '3000');
  await open('?file=files/ring.obj');
  const rules = await rulesOf(page);
  const node = await find(page, /free/, [0.35, 0.7], [0.35, 0.6]);
  await page.mouse.move(node.x, node.y);
  await page.mouse.down();
  await page.mouse.move(node.x + 40, node.y, { steps: 4 });
  await page.mouse.up();
  assert.equal(await rulesOf(page), rules, 'the view has turned');
  await page.keyboard.press('Home');
  await page.keyboard.press('0');
  const free = await find(page, /free/, [0.35, 0.75], [0.35, 0.6]);
  await page.mouse.click(free.x, free.y);
  await drag(page, free, 0, -12);
  await undo().and(page.locator(`[title*="Move node ${free.node}"]`)).waitFor();
  await expectSameAsNative(session, page, input);
});

test('a node that is pulled along the surface takes those about it along: no needles, no folds, and no jump when it is let go', async () => {
  const input = session.generated('saddle.obj', 'saddle', '--columns', '48', '--rows', '48', '--jitter', '0.2');
  await open('?file=files/saddle.obj', { untouched: true });
  const faces = readFileSync(input, 'utf8').split('\n').filter((line) => line.startsWith('f ')).map((line) => line.slice(2).trim().split(' ').map((corner) => parseInt(corner) - 1));
  // The longest edge of a face over its least height, and whether all faces look upwards.
  const look = (places) => {
    const seen = { needle: 0, upwards: true };
    for (const [a, b, c] of faces.map((face) => face.map((node) => places[node]))) {
      const [u, v] = [b, c].map((place) => place.map((part, i) => part - a[i]));
      const area = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      const longest = Math.max(distance(a, b), distance(b, c), distance(c, a));
      seen.needle = Math.max(seen.needle, longest ** 2 / Math.hypot(...area));
      seen.upwards &&= area[2] > 0;
    }
    return seen;
  };
  const before = placesOf((await saved(page)).path);
  const node = await find(page, /free/, [0.45, 0.5], [0.55, 0.5]);
  await page.mouse.click(node.x, node.y);
  await page.getByLabel('A pull reaches').fill('30');
  // With X it goes along that axis, which the saddle has nearly as a tangent there.
  let dragged;
  await drag(page, node, 40, 0, async () => {
    await page.keyboard.press('x');
    await page.mouse.move(node.x + 41, node.y);
    await page.waitForTimeout(500);
    dragged = await page.locator('#status').textContent();
  });
  assert.ok(dragged, 'the footer told of the drag');
  const after = placesOf((await saved(page)).path);
  assert.ok(distance(after[node.node], before[node.node]) > 0.13, 'by more than three edges');
  const [was, is] = [look(before), look(after)];
  assert.ok(is.upwards && is.needle < 2 * was.needle, `${was.needle}, ${is.needle}`);
});

test('the view is turned by arrow keys, looks from each side, and is turned by other buttons as other programs have it', async () => {
  await open();
  const changes = async (act) => {
    const before = await picture(page);
    await act();
    return (await picture(page)) !== before;
  };
  const by = (button) => async () => {
    await page.mouse.move(200, 650);
    await page.mouse.down({ button });
    await page.mouse.move(260, 640, { steps: 4 });
    await page.mouse.up({ button });
  };
  await page.locator('#canvas').focus();
  for (const key of ['ArrowLeft', 'ArrowUp', 'Shift+ArrowDown']) assert.ok(await changes(() => page.keyboard.press(key)), key);
  const views = page.getByRole('group', { name: 'Views' });
  const seen = new Set();
  for (const side of ['top, Z', 'front, −Y', 'right, X']) {
    await views.getByRole('button', { name: side }).click();
    seen.add(await picture(page));
  }
  assert.equal(seen.size, 3);
  assert.ok(await changes(by('left')));

  await page.keyboard.press('?');
  await page.getByLabel('Mouse').selectOption({ label: 'As in Rhino: right button turns, with Shift it moves' });
  await page.getByRole('button', { name: 'Close' }).click();
  assert.ok(!(await changes(by('left'))));
  assert.ok(await changes(by('right')));
  await page.reload();
  await settled(page);
  assert.ok(!(await changes(by('left'))), 'it is remembered');
});
