// Five tasks as people have them, from the file to the saved one, each in at most 15 actions: a click, a drag, a turn of the wheel, an entry.
// With PICTURES=FOLDER each step leaves a picture there: docs/pictures has those of docs/editor.md.

import assert from 'node:assert/strict';
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { choose, downloaded, find, findAround, greatestDistance, native, open, page, placesOf, root, session, settled, useSession } from './support.mjs';

useSession(undefined, process.env.PICTURES ? { scale: 1 } : {});

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

async function smoothInMetres(name, text) {
  await act(() => choose(page, 'Open…', { name, text }));
  await page.locator('#name', { hasText: name }).waitFor();
  await settled(page);
  await act(() => page.getByLabel('Unit').selectOption('m'));
  await act(() => button('Zebra').click());
  await picture(1);
  await act(() => button('Smooth it').click());
  await says('Its noise seems to be');
}

// Returns the path of the file that is saved, under that name.
async function done(what, name) {
  const { path } = await act(() => downloaded(page, () => page.getByRole('button', { name: 'Save as' }).click()));
  assert.ok(actions <= most, `${what} took ${actions} actions`);
  const own = join(session.folder, name);
  copyFileSync(path, own);
  return own;
}

// Numbers from −0.5 to 0.5, the same each time.
function randomly() {
  let state = 7;
  return () => {
    state = (state * 16807) % 2147483647;
    return state / 2147483647 - 0.5;
  };
}

// Half of a hull of 6 m, from the transom to near the bow and from the sheer to the keel; noise of 1 mm as of measured offsets.
function hull(noise) {
  const [along, down] = [48, 18];
  let text = '';
  const random = randomly();
  for (let i = 0; i <= along; ++i) {
    for (let j = 0; j <= down; ++j) {
      const [x, girth] = [(0.97 * i) / along, (Math.PI / 2) * (j / down)];
      const [beam, depth, sheer] = [1.3 + 0.8 * x - 2.05 * x ** 3, 1.3 * (1 - x ** 5) + 0.05, 0.9 + 0.4 * x * x];
      const inner = i > 0 && i < along && j > 0 && j < down ? noise : 0;
      text += `v ${[6 * x + inner * random(), -beam * Math.cos(girth) + inner * random(), sheer - (sheer + depth) * Math.sin(girth) + inner * random()].join(' ')}\n`;
    }
  }
  for (let i = 0; i < along; ++i) for (let j = 1; j <= down; ++j) {
    const a = i * (down + 1) + j;
    text += `f ${a} ${a + down + 1} ${a + down + 2} ${a + 1}\n`;
  }
  return text;
}

// A figure of fairness, by its key.
function figure(path, key) {
  const report = join(session.folder, 'measured.json');
  native('measure', path, '--report', report);
  return JSON.parse(readFileSync(report, 'utf8')).figures[key];
}

// How unevenly a shape bends.
const unrest = (path) => figure(path, 'mean_curvature_variation');

test('a hull is faired within 2 mm, from its file to the saved one', async () => {
  await begin('hull');
  const text = hull(0.002);
  await smoothInMetres('hull.obj', text);
  await act(async () => {
    await page.getByLabel('Tolerance', { exact: true }).fill('0.002');
    await page.getByLabel('Tolerance', { exact: true }).press('Enter');
  });
  await says('the shape by at most 0.002 m');
  await settled(page);
  await picture(2);
  await act(() => button('Apply').click());
  await settled(page);
  await picture(3);
  const fair = await done('the hull', 'fair-hull.obj');
  const path = join(session.folder, 'hull.obj');
  writeFileSync(path, text);
  assert.ok(greatestDistance(placesOf(fair), placesOf(path)) < 0.003, 'every node is about where it was');
  const exact = join(session.folder, 'exact.obj');
  writeFileSync(exact, hull(0));
  // Of what the noise adds nothing is left: the hull itself bends more towards its bow.
  assert.ok(unrest(path) > 1.5 * unrest(exact));
  assert.ok(unrest(fair) < unrest(exact), `reflections on the hull are calm: ${unrest(fair)}, ${unrest(path)}, ${unrest(exact)}`);
});

// Spot with three dents in its side. Returns places without dents and with them, and the middles and the radius of the dents.
function dented() {
  const places = placesOf(join(root, 'examples/spot.obj'));
  const middles = [[0.02, -0.02], [0.35, 0.12], [0.62, 0.1]].map(([y, z]) => places.filter(([x]) => x > 0.15)
    .reduce((best, place) => (Math.hypot(place[1] - y, place[2] - z) < Math.hypot(best[1] - y, best[2] - z) ? place : best)));
  const radius = 0.12;
  const bent = places.map(([x, y, z]) => {
    const far = Math.min(...middles.map((middle) => Math.hypot(x - middle[0], y - middle[1], z - middle[2])));
    return far < radius ? [x - 0.05 * (1 - (far / radius) ** 2) ** 2, y, z] : [x, y, z];
  });
  return { places, bent, middles, radius };
}

// Spot's faces, with its nodes there.
function spotWith(places) {
  const lines = readFileSync(join(root, 'examples/spot.obj'), 'utf8').split('\n').filter((line) => line.startsWith('f '));
  return `${places.map((place) => `v ${place.join(' ')}`).join('\n')}\n${lines.map((line) => line.replace(/\/[^ ]*/g, '')).join('\n')}\n`;
}

test('a scan is smoothed by someone in a hurry, who changes nothing that is offered', async () => {
  await begin('hurry');
  const places = placesOf(join(root, 'examples/spot.obj'));
  const random = randomly();
  const rough = places.map((place) => place.map((part) => part + 0.012 * random()));
  await act(() => choose(page, 'Open…', { name: 'scan.obj', text: spotWith(rough) }));
  await page.locator('#name', { hasText: 'scan.obj' }).waitFor();
  await settled(page);
  await picture(1);
  await act(() => button('Smooth it').click());
  await says('Its noise seems to be');
  await settled(page);
  await picture(2);
  await act(() => button('Apply').click());
  await settled(page);
  await picture(3);
  const smooth = await done('the scan', 'smooth-scan.obj');
  assert.equal(actions, 4);
  const path = join(session.folder, 'rough.obj');
  writeFileSync(path, spotWith(rough));
  assert.ok(greatestDistance(placesOf(smooth), places) < 0.03, 'every node is about where it was');
  const [turns, before, wanted] = [smooth, path, join(root, 'examples/spot.obj')].map((one) => figure(one, 'rms_turn'));
  assert.ok(before > 1.3 * wanted && turns < 1.02 * wanted, `the noise is gone: faces turn by ${turns}°, ${before}° before, ${wanted}° without noise`);
});

test('three dents of a scan are repaired', async () => {
  await begin('dents');
  const { places, bent, middles, radius } = dented();
  await act(() => choose(page, 'Open…', { name: 'scan.obj', text: spotWith(bent) }));
  await page.locator('#name', { hasText: 'scan.obj' }).waitFor();
  await settled(page);
  await act(() => page.getByRole('button', { name: 'View from the right, X' }).click());
  await picture(1);
  await act(() => button('Repair a part').click());
  const box = await page.locator('#canvas').boundingBox();
  const at = await pixelsOf(places, box);
  for (const [k, middle] of middles.entries()) {
    const [x, y] = at(middle);
    await act(async () => {
      await page.mouse.move(x, y);
      await page.mouse.down();
      const around = at([middle[0], middle[1] + radius, middle[2]])[0] - x;
      for (let turn = 0; turn <= 24; ++turn) await page.mouse.move(x + 0.75 * around * Math.cos(turn / 3.5), y + 0.75 * around * Math.sin(turn / 3.5));
      await page.mouse.up();
    });
    await says(/^Moves [\d,]+ nodes/);
    if (k === 0) await picture(2);
    await act(() => button('Apply').click());
    await says('Paint over');
  }
  await act(() => button('Done').click());
  await picture(3);
  const fair = placesOf(await done('the scan', 'fair-scan.obj'));
  const off = (shape, k) => Math.max(...shape.flatMap((place, n) => (Math.hypot(...places[n].map((part, i) => part - middles[k][i])) < radius ? [Math.abs(place[0] - places[n][0])] : [])));
  middles.forEach((_, k) => assert.ok(off(fair, k) < 0.5 * off(bent, k), `dent ${k}: ${off(fair, k)} of ${off(bent, k)}`));
  places.forEach(([x], n) => { if (x < -0.1) assert.ok(greatestDistance([fair[n]], [bent[n]]) < 1e-9, 'the other side stays'); });
});

// Where places are seen from the right, as all of the shape is in the view, left of the panel.
async function pixelsOf(places, box) {
  const panel = await page.locator('aside').boundingBox();
  const bounds = (i) => [Math.min(...places.map((place) => place[i])), Math.max(...places.map((place) => place[i]))];
  const [[left, right], [low, high]] = [bounds(1), bounds(2)];
  const width = panel.x - box.x;
  const perUnit = 0.8 * Math.min(box.height / (high - low), width / (right - left));
  return ([, y, z]) => [box.x + width / 2 + perUnit * (y - (left + right) / 2), box.y + box.height / 2 - perUnit * (z - (low + high) / 2)];
}

// How much the curvature of a plane curve goes up and down, in all.
function unevenness(places) {
  const minus = (a, b) => a.map((part, i) => part - b[i]);
  const bends = places.slice(1, -1).map((place, k) => {
    const [a, b] = [minus(place, places[k]), minus(places[k + 2], place)];
    return (2 * Math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])) / (Math.hypot(...a) + Math.hypot(...b));
  });
  return bends.slice(1).reduce((sum, bend, k) => sum + Math.abs(bend - bends[k]), 0);
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
  const seen = await find(page, /Node (29|30|31) /, [0.03, 0.52], [0.3, 0.54]);
  await act(async () => {
    await page.mouse.move(seen.x, seen.y);
    for (let k = 0; k < 8; ++k) await page.mouse.wheel(0, -120);
  });
  await act(() => page.getByLabel('A pull reaches').fill('6'));
  await page.evaluate(() => new Promise((ready) => requestAnimationFrame(() => requestAnimationFrame(ready))));
  const nose = await findAround(page, new RegExp(`Node ${seen.node} `), seen);
  const plot = () => page.locator('#plot path.second').getAttribute('d');
  const before = await plot();
  await act(async () => {
    await page.mouse.move(nose.x, nose.y);
    await page.mouse.down();
    await page.mouse.move(nose.x - 9, nose.y, { steps: 5 });
    await page.mouse.up();
  });
  await button('Undo').and(page.locator('[title*="Move node"]')).waitFor();
  await settled(page);
  assert.notEqual(await plot(), before, 'the comb and its plot have followed');
  await picture(2);
  await act(() => page.keyboard.press('0'));
  await picture(3);
  const fair = placesOf(await done('the nose', 'fair-nose.dat'));
  assert.ok(Math.min(...fair.map(([x]) => x)) < 0.003, 'the nose is further forward');
  assert.ok(unevenness(fair) < 0.5 * unevenness(flat), `the comb is calm: ${unevenness(fair)}, ${unevenness(flat)}`);
});

const bonnetSide = { along: 30, across: 40 };

// The bonnet of a car in metres, as it comes from a scan of a clay model: crowned, with noise of a third of a millimetre inside.
function bonnet() {
  const { along, across } = bonnetSide;
  const random = randomly();
  let text = '';
  for (let i = 0; i <= along; ++i) for (let j = 0; j <= across; ++j) {
    const [x, y] = [(1.2 * i) / along, 1.4 * (j / across - 0.5)];
    const noise = i > 0 && i < along && j > 0 && j < across ? 0.001 * random() : 0;
    text += `v ${x} ${y} ${0.85 + 0.05 * Math.sin((2 * x) / 1.2) - 0.12 * y * y - 0.05 * x * x + noise}\n`;
  }
  for (let i = 0; i < along; ++i) for (let j = 1; j <= across; ++j) {
    const a = i * (across + 1) + j;
    text += `f ${a} ${a + across + 1} ${a + across + 2} ${a + 1}\n`;
  }
  return text;
}

test('a bonnet is smoothed and gets more crown on both sides', async () => {
  await begin('bonnet');
  const text = bonnet();
  await smoothInMetres('bonnet.obj', text);
  await settled(page);
  await picture(2);
  await act(() => button('Apply').click());
  await settled(page);
  await act(() => page.getByLabel('Symmetry about').selectOption({ label: 'y = 0' }));
  await page.locator('#symmetric', { hasText: 'have a mirror image' }).waitFor();
  const smooth = placesOf((await downloaded(page, () => page.getByRole('button', { name: 'Save as' }).click())).path);
  const seen = await find(page, /Node \d+ .*free/, [0.5, 0.35], [0.5, 0.6]);
  await act(() => page.mouse.click(seen.x, seen.y));
  await page.locator('#picked', { hasText: /^2 nodes$/ }).waitFor();
  await act(() => page.getByLabel('A pull reaches').fill('25'));
  await act(async () => {
    const height = page.getByLabel('Position z');
    await height.fill(String(Number(await height.inputValue()) + 0.008));
    await height.press('Enter');
  });
  // It is asked first what goes along.
  await button('Undo').and(page.locator('[title*="Move 2 nodes"]')).waitFor();
  await settled(page);
  await picture(3);
  const fair = placesOf(await done('the bonnet', 'fair-bonnet.obj'));
  const path = join(session.folder, 'bonnet.obj');
  writeFileSync(path, text);
  const { across } = bonnetSide;
  const column = seen.node % (across + 1);
  const image = seen.node - column + across - column;
  for (const node of [seen.node, image]) assert.ok(Math.abs(fair[node][2] - smooth[node][2] - 0.008) < 2e-4, `node ${node} went up`);
  const raised = fair.filter((place, node) => place[2] > smooth[node][2] + 0.004).length;
  assert.ok(raised > 10, `what is about them went along: ${raised}`);
  assert.ok(unrest(join(session.folder, 'fair-bonnet.obj')) < 0.2 * unrest(path), 'reflections are calm');
});
