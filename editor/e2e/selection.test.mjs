// Picking many nodes with real pointer and keys, and a region that is faired as the native program does.

import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { drop, greatestDistance, native, open, page, placesOf, rulesOf, saved, session, settled, useSession } from './support.mjs';

useSession();

const tool = (name) => page.getByRole('toolbar', { name: 'Tools' }).getByRole('button', { name });
const count = async () => {
  const text = await page.locator('#picked').textContent();
  return text === 'No node picked' ? 0 : text.startsWith('Node ') ? 1 : Number(text.split(' ')[0]);
};

// Places in the view as shares of its free part, left of the panel.
async function stroke(points) {
  const box = await page.locator('#canvas').boundingBox();
  const at = ([x, y]) => [box.x + x * (box.width - 270), box.y + y * box.height];
  await page.mouse.move(...at(points[0]));
  await page.mouse.down();
  for (const point of points.slice(1)) await page.mouse.move(...at(point), { steps: 4 });
  await page.mouse.up();
}

const everything = [[0.01, 0.01], [0.99, 0.99]];
const leftHalf = [[0.01, 0.01], [0.5, 0.99]];
const rightHalf = [[0.5, 0.01], [0.99, 0.99]];

test('box and lasso: alone, with Shift more, with Alt fewer; clicks and Escape pick nothing', async () => {
  await open('?file=examples/annulus.obj');
  await page.keyboard.press('w');
  assert.equal(await tool('Pick in a box').getAttribute('aria-pressed'), 'true');
  await stroke(everything);
  assert.equal(await count(), 1610);
  await stroke(leftHalf);
  const left = await count();
  assert.ok(left > 500 && left < 1100, `${left}`);
  await page.keyboard.down('Shift');
  await stroke(rightHalf);
  await page.keyboard.up('Shift');
  assert.equal(await count(), 1610);
  await tool('Pick in a lasso').click();
  await page.keyboard.down('Alt');
  await stroke([[0.01, 0.01], [0.5, 0.01], [0.5, 0.99], [0.01, 0.99]]);
  await page.keyboard.up('Alt');
  assert.equal(await count(), 1610 - left);
  await stroke([[0.9, 0.12]]);
  assert.equal(await count(), 0);

  await page.mouse.move(20, 300);
  await page.mouse.down();
  await page.mouse.move(400, 500);
  await page.mouse.move(700, 100);
  assert.equal(await page.locator('#overlay polygon').count(), 1);
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('#overlay polygon').count(), 0);
  await page.mouse.up();
  assert.equal(await count(), 0);
});

test('the switch leaves out what is hidden; the brush never paints that, and its size changes', async () => {
  session.generated('ball.ply', 'torus', '--columns', '60', '--rows', '40');
  await open('?file=files/ball.ply', { untouched: true });
  assert.ok(await page.getByRole('button', { name: 'Free form' }).isDisabled(), 'it has no boundary');
  await page.keyboard.press('w');
  await stroke(everything);
  const all = await count();
  await page.getByRole('button', { name: 'Pick only what is seen' }).click();
  await stroke(everything);
  const seen = await count();
  assert.ok(seen > 0.3 * all && seen < 0.7 * all, `${seen} of ${all}`);

  await page.keyboard.press('Escape');
  await page.keyboard.press('r');
  const ring = page.locator('#overlay circle');
  const way = [[0.3, 0.7], [0.5, 0.8]];
  await stroke(way);
  const narrow = await count();
  assert.ok(narrow > 5 && narrow < seen, `${narrow}`);
  const radius = Number(await ring.getAttribute('r'));
  for (let k = 0; k < 3; ++k) await page.keyboard.press(']');
  assert.ok(Number(await ring.getAttribute('r')) > 1.8 * radius);
  await stroke(way);
  const wide = await count();
  assert.ok(wide > 1.3 * narrow, `${narrow}, ${wide}`);
  await page.getByRole('slider', { name: 'Brush' }).press('Home');
  assert.equal(await ring.getAttribute('r'), '3');
  await page.getByRole('slider', { name: 'Brush' }).press('End');
  assert.equal(await page.locator('#brush output').textContent(), '600 pixels');
  await page.getByRole('button', { name: 'Erase' }).click();
  await stroke([[0.3, 0.7], [0.31, 0.7]]);
  const less = await count();
  assert.ok(less < wide, `${less}`);
  await page.keyboard.press('Shift+X');
  await page.keyboard.down('Alt');
  await stroke(everything);
  await page.keyboard.up('Alt');
  assert.equal(await count(), 0);
  await page.keyboard.press('q');
  assert.ok(await page.getByRole('button', { name: 'Erase' }).isHidden());
  assert.equal(await page.getByRole('button', { name: 'Undo' }).isDisabled(), true, 'what is picked is no step of its own');
});

test('the brush paints what a spike hides, with a finger too, and not the other side', async () => {
  const cells = 20;
  const plate = (spike) => {
    const places = Array.from({ length: (cells + 1) ** 2 }, (_, n) => [n % (cells + 1), Math.floor(n / (cells + 1)), 0]);
    if (spike) places[10 * (cells + 1) + 8] = [12.4, 10.1, 2];
    const faces = places.flatMap(([x, y], n) => (x < cells && y < cells ? [`f ${[n + 1, n + 2, n + cells + 3, n + cells + 2].join(' ')}`] : []));
    return `${places.map((place) => `v ${place.join(' ')}`).join('\n')}\n${faces.join('\n')}\n`;
  };
  await open('', { untouched: true, hasTouch: true });
  const painted = [];
  for (const spike of [false, true]) {
    await drop(page, `plate${spike}.obj`, plate(spike));
    await page.locator('#name', { hasText: `plate${spike}` }).waitFor();
    await settled(page);
    await page.getByRole('button', { name: 'View from the top' }).click();
    await page.keyboard.press('r');
    await page.getByRole('slider', { name: 'Brush' }).fill('86');
    const box = await page.locator('#canvas').boundingBox();
    await page.touchscreen.tap(box.x + (box.width - 300) / 2, box.y + box.height / 2);
    painted.push(await count());
    await page.keyboard.press('Escape');
  }
  assert.ok(painted[0] > 60, `${painted}`);
  assert.equal(painted[0], painted[1]);
});

test('all, the rest, rings, parts; the toolbar goes by arrow keys', async () => {
  writeFileSync(join(session.folder, 'two.obj'), [0, 3].flatMap((x) => [0, 1, 2, 3].map((y) => `v ${x} ${y} 0\nv ${x + 1} ${y} 0.1\n`)).join('')
    + [0, 8].flatMap((o) => [1, 3, 5].map((n) => `f ${o + n} ${o + n + 1} ${o + n + 3} ${o + n + 2}\n`)).join(''));
  await open('?file=files/two.obj');
  await page.keyboard.press('w');
  await stroke(leftHalf);
  const half = await count();
  assert.ok(half > 0 && half < 16);
  await page.keyboard.press('Control+i');
  assert.equal(await count(), 16 - half);
  await page.keyboard.press('Control+a');
  assert.equal(await count(), 16);
  await page.keyboard.press('Escape');
  assert.equal(await count(), 0);
  await stroke([[0.01, 0.01], [0.15, 0.99]]);
  const few = await count();
  assert.ok(few > 0 && few < 8, `${few}`);
  await page.keyboard.press('g');
  const more = await count();
  assert.ok(more > few && more <= 8);
  await page.keyboard.press('Shift+G');
  assert.ok(await count() < more || more === 8);
  await page.keyboard.press('Shift+L');
  assert.equal(await count(), 8);

  await page.keyboard.press('Escape');
  const number = page.getByLabel('Node number');
  await number.fill('5');
  await number.press('Enter');
  await page.locator('#picked', { hasText: /^Node 5$/ }).waitFor();
  await number.evaluate((one) => one.blur());
  await page.keyboard.press('.');
  await page.keyboard.press('.');
  await page.keyboard.press(',');
  assert.equal(await page.locator('#picked').textContent(), 'Node 6');
  await page.keyboard.press('Shift+L');

  await tool('Pick and drag').focus();
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  assert.equal(await tool('Pick in a box').getAttribute('aria-pressed'), 'true');
});

test('only the picked region is faired: the saved constraints give the same with the native program, as its --region does', async () => {
  const path = session.generated('saddle.obj', 'saddle', '--columns', '24', '--rows', '24', '--noise', '0.01');
  await open('?file=files/saddle.obj', { untouched: true });
  await page.keyboard.press('w');
  await stroke([[0.42, 0.42], [0.58, 0.58]]);
  const picked = await count();
  assert.ok(picked > 20 && picked < 400, `${picked}`);
  await page.getByRole('button', { name: 'Fair only these nodes' }).click();
  await page.locator(`[title^="Undo: Fair only ${picked} nodes"]`).waitFor();
  await settled(page);
  const rules = await rulesOf(page);
  const ours = placesOf((await saved(page)).path);

  const [constraints, region] = ['region-rules.json', 'region.json'].map((name) => join(session.folder, name));
  writeFileSync(constraints, rules);
  const input = placesOf(path);
  const fixed = new Set(JSON.parse(rules).rules.filter((rule) => rule.position === 'fixed' && Array.isArray(rule.nodes)).flatMap((rule) => rule.nodes));
  const inner = (n) => Math.min(n % 25, Math.floor(n / 25)) > 0 && Math.max(n % 25, Math.floor(n / 25)) < 24;
  const inside = input.map((_, n) => n).filter((n) => inner(n) && !fixed.has(n));
  assert.equal(inside.length, picked);
  writeFileSync(region, JSON.stringify(inside));
  for (const options of [['--constraints', constraints], ['--region', region]]) {
    const fair = join(session.folder, 'fair.obj');
    native('fair', path, '-o', fair, ...options, '--quiet');
    assert.ok(greatestDistance(ours, placesOf(fair)) < 2e-5, `${options[0]}`);
  }
  assert.ok(greatestDistance(inside.map((n) => ours[n]), inside.map((n) => input[n])) > 1e-3);
  ours.forEach((place, n) => { if (fixed.has(n)) assert.deepEqual(place, input[n]); });
});

test('with a tool in hand the right button turns the view; the wheel zooms, with Shift it moves', async () => {
  await open('?file=examples/annulus.obj');
  const picture = async () => (await page.locator('#canvas').screenshot()).toString('base64');
  const changes = async (act) => {
    const before = await picture();
    await act();
    await page.waitForFunction(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true)))));
    return (await picture()) !== before;
  };
  await page.keyboard.press('w');
  await stroke(leftHalf);
  const half = await count();
  assert.ok(await changes(async () => {
    await page.mouse.move(300, 500);
    await page.mouse.down({ button: 'right' });
    await page.mouse.move(380, 460, { steps: 4 });
    await page.mouse.up({ button: 'right' });
  }));
  assert.equal(await count(), half);
  await page.mouse.move(450, 400);
  assert.ok(await changes(() => page.mouse.wheel(0, -200)), 'zooms');
  await page.keyboard.press('0');
  await stroke(everything);
  assert.equal(await count(), 1610);
  await page.keyboard.down('Shift');
  await page.mouse.wheel(0, 5000);
  await page.keyboard.up('Shift');
  await stroke(everything);
  assert.equal(await count(), 0, 'the surface has been moved out of the view, not made smaller');
});

test('two fingers zoom and move the view, whatever the tool, and pick nothing; one finger does what the tool does', async () => {
  await open('?file=examples/annulus.obj', { hasTouch: true });
  const touch = await page.context().newCDPSession(page);
  const send = (type, points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const fingers = async (from, to) => {
    await send('touchStart', from.slice(0, 1));
    if (from.length > 1) await send('touchStart', from);
    for (let k = 1; k <= 6; ++k) await send('touchMove', from.map((start, f) => start.map((part, i) => part + ((to[f][i] - part) * k) / 6)));
    if (from.length > 1) await send('touchEnd', from.slice(0, 1));
    await send('touchEnd', []);
  };
  // All that is in the view is picked, by the mouse.
  const inView = async () => {
    await page.keyboard.press('w');
    await stroke(everything);
    const found = await count();
    await page.keyboard.press('Escape');
    assert.equal(await count(), 0);
    return found;
  };
  const apart = [[[440, 400], [500, 400]], [[200, 400], [740, 400]]];
  assert.equal(await inView(), 1610);
  for (const key of ['q', 'w', 'r']) {
    await page.keyboard.press(key);
    await fingers(...apart);
    assert.equal(await count(), 0, key);
    const found = await inView();
    assert.ok(found < 1300, `with ${key} ${found} are left in the view`);
    await page.keyboard.press('0');
    assert.equal(await inView(), 1610);
  }
  await page.keyboard.press('q');
  await fingers([[440, 400], [500, 400]], [[440, 2400], [500, 2400]]);
  assert.equal(await inView(), 0, 'moved away');
  await page.keyboard.press('0');
  await page.keyboard.press('w');
  await fingers([[15, 60]], [[920, 700]]);
  assert.equal(await count(), 1610, 'one finger draws the box');
});
