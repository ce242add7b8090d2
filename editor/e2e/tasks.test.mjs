// Three tasks as people have them, from the file to the saved one, each in at most 15 actions: a click, a drag, a turn of the wheel, an entry.
// With PICTURES=FOLDER each step leaves a picture there: docs/pictures has those of docs/editor.md.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { choose, downloaded, find, greatestDistance, open, page, placesOf, root, session, settled, useSession } from './support.mjs';

useSession();

const most = 15;
let actions;
let task;

async function act(what) {
  ++actions;
  return what();
}

async function picture(step) {
  if (!process.env.PICTURES) return;
  await page.mouse.move(640, 3);
  await page.evaluate(() => document.activeElement.blur());
  await page.waitForTimeout(1200);
  await page.screenshot({ path: join(process.env.PICTURES, `editor-${task}-${step}.png`) });
}

async function begin(name) {
  task = name;
  actions = 0;
  await open('', { viewport: { width: 1100, height: 680 } });
}

const button = (name) => page.getByRole('button', { name });
const says = (text) => page.locator('#start-says', { hasText: text }).waitFor();

async function done(name) {
  const { path } = await act(() => downloaded(page, () => page.getByRole('button', { name: 'Save as' }).click()));
  assert.ok(actions <= most, `${name} took ${actions} actions`);
  return placesOf(path);
}

// Half of a hull of 10 m, from the transom to near the bow and from the sheer to the keel; noise of 1 mm as of measured offsets.
function hull(noise) {
  const [along, down] = [48, 18];
  let text = '';
  let state = 7;
  const random = () => {
    state = (state * 16807) % 2147483647;
    return state / 2147483647 - 0.5;
  };
  for (let i = 0; i <= along; ++i) {
    for (let j = 0; j <= down; ++j) {
      const [x, girth] = [(0.97 * i) / along, (Math.PI / 2) * (j / down)];
      const [beam, depth, sheer] = [1.3 + 0.8 * x - 2.05 * x ** 3, 0.9 * (1 - x ** 5) + 0.05, 0.9 + 0.5 * x * x];
      const inner = i > 0 && i < along && j > 0 && j < down ? noise : 0;
      text += `v ${[10 * x + inner * random(), -beam * Math.cos(girth) ** 0.7 + inner * random(), sheer - (sheer + depth) * Math.sin(girth) ** 1.4 + inner * random()].join(' ')}\n`;
    }
  }
  for (let i = 0; i < along; ++i) for (let j = 1; j <= down; ++j) {
    const a = i * (down + 1) + j;
    text += `f ${a} ${a + down + 1} ${a + down + 2} ${a + 1}\n`;
  }
  return text;
}

test('a hull is faired within 2 mm, from its file to the saved one', async () => {
  await begin('hull');
  const text = hull(0.002);
  await act(() => choose(page, 'Open…', { name: 'hull.obj', text }));
  await page.locator('#name', { hasText: 'hull.obj' }).waitFor();
  await settled(page);
  await act(() => page.getByLabel('Unit').selectOption('m'));
  await act(() => button('Zebra').click());
  await picture(1);
  await act(() => button('Smooth it').click());
  await says('Its noise seems to be');
  await act(async () => {
    await page.getByLabel('Tolerance', { exact: true }).fill('0.002');
    await page.getByLabel('Tolerance', { exact: true }).press('Enter');
  });
  await says('within 0.002 m');
  await settled(page);
  await picture(2);
  await act(() => button('Apply').click());
  await settled(page);
  await act(() => button('Zebra').click());
  await picture(3);
  const fair = await done('the hull');
  const path = join(session.folder, 'hull.obj');
  writeFileSync(path, text);
  const input = placesOf(path);
  writeFileSync(path, hull(0));
  assert.ok(greatestDistance(fair, input) < 0.003, 'every node is about where it was');
  const apart = (places, smooth) => Math.sqrt(places.reduce((sum, [, y, z], n) => sum + (y - smooth[n][1]) ** 2 + (z - smooth[n][2]) ** 2, 0) / places.length);
  assert.ok(apart(fair, placesOf(path)) < 0.7 * apart(input, placesOf(path)), 'and nearer to the hull without its noise');
});

// Spot, standing, with three dents in the side that is seen first. Returns the text, and places without dents and with them.
function dented() {
  const places = placesOf(join(root, 'examples/spot.obj')).map(([x, y, z]) => [-z, -x, y]);
  const middles = [[-0.45, 0.15], [0.05, 0.05], [0.45, 0.25]].map(([x, z]) => {
    const near = places.map((place, n) => ({ n, far: Math.hypot(place[0] - x, place[2] - z) + (place[1] > 0 ? 9 : 0) }));
    return places[near.sort((a, b) => a.far - b.far)[0].n];
  });
  const radius = 0.13;
  const bent = places.map((place) => {
    const far = Math.min(...middles.map((middle) => Math.hypot(...place.map((part, i) => part - middle[i]))));
    return far < radius ? [place[0], place[1] + 0.06 * (1 - (far / radius) ** 2) ** 2, place[2]] : place;
  });
  return { places, bent, middles, radius };
}

test('three dents of a scan are repaired', async () => {
  await begin('dents');
  const { places, bent, middles, radius } = dented();
  const lines = readFileSync(join(root, 'examples/spot.obj'), 'utf8').split('\n').filter((line) => line.startsWith('f '));
  const text = `${bent.map((place) => `v ${place.join(' ')}`).join('\n')}\n${lines.map((line) => line.replace(/\/[^ ]*/g, '')).join('\n')}\n`;
  await act(() => choose(page, 'Open…', { name: 'scan.obj', text }));
  await page.locator('#name', { hasText: 'scan.obj' }).waitFor();
  await settled(page);
  await act(() => page.getByRole('button', { name: 'View from the front, −Y' }).click());
  await picture(1);
  await act(() => button('Repair a part').click());
  const box = await page.locator('#canvas').boundingBox();
  const at = await pixelsOf(places, box);
  for (const [k, middle] of middles.entries()) {
    const [x, y] = at(middle);
    await act(async () => {
      await page.mouse.move(x, y);
      await page.mouse.down();
      const around = at([middle[0] + radius, middle[1], middle[2]])[0] - x;
      for (let turn = 0; turn <= 24; ++turn) await page.mouse.move(x + 0.6 * around * Math.cos(turn / 3), y + 0.6 * around * Math.sin(turn / 3));
      await page.mouse.up();
    });
    await says(/^Moves [\d,]+ nodes/);
    if (k === 0) await picture(2);
    await act(() => button('Apply').click());
    await says('Paint over');
  }
  await act(() => button('Done').click());
  await picture(3);
  const fair = await done('the scan');
  const off = (shape, k) => Math.max(...shape.flatMap((place, n) => (Math.hypot(...places[n].map((part, i) => part - middles[k][i])) < radius ? [Math.abs(place[1] - places[n][1])] : [])));
  middles.forEach((_, k) => assert.ok(off(fair, k) < 0.5 * off(bent, k), `dent ${k}: ${off(fair, k)} of ${off(bent, k)}`));
  const outside = places.flatMap((place, n) => (middles.every((middle) => Math.hypot(...place.map((part, i) => part - middle[i])) > 2 * radius) ? [n] : []));
  for (const n of outside) assert.deepEqual(fair[n], bent[n]);
});

// Where places are seen from the front, as all of the shape is in the view, left of the panel.
async function pixelsOf(places, box) {
  const panel = await page.locator('aside').boundingBox();
  const bounds = (i) => [Math.min(...places.map((place) => place[i])), Math.max(...places.map((place) => place[i]))];
  const [[left, right], [low, high]] = [bounds(0), bounds(2)];
  const width = panel.x - box.x;
  const perUnit = 0.8 * Math.min(box.height / (high - low), width / (right - left));
  return ([x, , z]) => [box.x + width / 2 + perUnit * (x - (left + right) / 2), box.y + box.height / 2 - perUnit * (z - (low + high) / 2)];
}

test('the nose of an aerofoil is redesigned by its comb', async () => {
  await begin('nose');
  const places = placesOf(join(root, 'examples/naca-2412.dat'));
  // Some millimetres of a metre flattened.
  const flat = places.map(([x, y], n) => [x < 0.02 ? Math.max(x, 0.004) : x, y + (x < 0.06 ? 0.0012 * Math.sin(2.4 * n) : 0)]);
  const text = `Mine\n${flat.map((row) => row.join(' ')).join('\n')}\n`;
  await act(() => choose(page, 'Open…', { name: 'mine.dat', text }));
  await page.locator('#name', { hasText: 'mine.dat' }).waitFor();
  await settled(page);
  await act(() => button('Root scale').click());
  await picture(1);
  const nose = await find(page, /Node 3\d/, [0.02, 0.42], [0.25, 0.42]);
  await act(async () => {
    await page.mouse.move(nose.x, nose.y);
    for (let k = 0; k < 12; ++k) await page.mouse.wheel(0, -120);
  });
  await act(() => page.getByLabel('A pull reaches').fill('8'));
  await page.evaluate(() => new Promise((ready) => requestAnimationFrame(() => requestAnimationFrame(ready))));
  const plot = () => page.locator('#plot path.second').getAttribute('d');
  const before = await plot();
  await act(async () => {
    await page.mouse.move(nose.x, nose.y);
    await page.mouse.down();
    await page.mouse.move(nose.x - 20, nose.y, { steps: 5 });
    await page.mouse.up();
  });
  await button('Undo').and(page.locator('[title*="Move node"]')).waitFor();
  await settled(page);
  assert.notEqual(await plot(), before, 'the comb and its plot have followed');
  await picture(2);
  await act(() => page.keyboard.press('0'));
  await picture(3);
  const fair = await done('the nose');
  const waves = (shape) => {
    const bends = shape.slice(1, -1).map(([x, y], k) => Math.atan2(shape[k + 2][1] - y, shape[k + 2][0] - x) - Math.atan2(y - shape[k][1], x - shape[k][0])).map((turn) => Math.atan2(Math.sin(turn), Math.cos(turn)));
    return bends.slice(1).filter((bend, k) => bend * bends[k] < 0).length;
  };
  assert.ok(Math.min(...fair.map(([x]) => x)) < 0.003, 'the nose is further forward');
  assert.ok(waves(fair) < waves(flat), `${waves(fair)} of ${waves(flat)} changes of sign of the curvature`);
});
