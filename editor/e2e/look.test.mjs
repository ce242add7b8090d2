// What helps to judge a shape: marks out of the way, edges, ranges of colours and combs that are set, units.

import assert from 'node:assert/strict';
import { copyFileSync, readFileSync } from 'node:fs';
import { test } from 'node:test';
import { choose, downloaded, drop, find, follows, open, page, picture, session, settled, useSession } from './support.mjs';

useSession(undefined, { scale: 1 });

async function seen(clip) {
  await page.mouse.move(3, 3);
  return picture(page, clip);
}

const numberOf = (text) => Number(text.replace('−', '-').replace(/^[≤≥ ]+/, ''));
const marks = () => page.getByRole('button', { name: 'Marks' });

test('marks of held nodes hide under reflection lines, and a key shows them; edges lie over any look', async () => {
  await open();
  assert.equal(await marks().getAttribute('aria-pressed'), 'true');
  await page.keyboard.press('3');
  assert.equal(await marks().getAttribute('aria-pressed'), 'false');
  const bare = await seen();
  await page.keyboard.press('m');
  const marked = await seen();
  assert.ok(marked !== bare);
  await page.keyboard.press('m');
  assert.ok((await seen()) === bare);
  await page.keyboard.press('7');
  assert.ok((await seen()) !== bare);
  await page.keyboard.press('7');
  assert.ok((await seen()) === bare);
  await page.keyboard.press('Shift+B');
  await settled(page);
  assert.equal(await page.getByRole('button', { name: 'Normals fixed' }).getAttribute('aria-pressed'), 'true');
  // Pixels that have the colour of what is held, as marks and arrows have.
  const held = async () => {
    const { data } = await pixels(await seen());
    return Array.from({ length: data.length / 4 }, (_, k) => data.subarray(4 * k, 4 * k + 3)).filter(([red, green, blue]) => red > green + 60 && green > blue + 30).length;
  };
  assert.equal(await held(), 0, 'no arrows either');
  await page.keyboard.press('m');
  assert.ok((await held()) > 1000);
  await page.keyboard.press('1');
  assert.equal(await marks().getAttribute('aria-pressed'), 'true');
});

test('colours are spread over as many nodes as the slider says; legend and footer have the unit and the radius', async () => {
  await open();
  await page.getByLabel('Example').selectOption({ label: 'Pipe blend' });
  await page.locator('#name', { hasText: 'pipe-blend' }).waitFor();
  await settled(page);
  await page.keyboard.press('4');
  await page.locator('#legend').waitFor();
  const widths = [];
  for (const share of [60, 96, 100]) {
    const before = await page.locator('#legend .marks').textContent();
    await page.getByRole('slider', { name: 'Colours for' }).fill(String(share));
    if (share !== 96 || widths.length > 0) await page.waitForFunction((old) => document.querySelector('#legend .marks').textContent !== old, before);
    const [low, , high] = (await page.locator('#legend .marks span').allTextContents()).map(numberOf);
    widths.push(high - low);
  }
  assert.ok(widths[0] < widths[1] && widths[1] < widths[2], `${widths}`);
  await page.getByLabel('Unit').selectOption('mm');
  await page.locator('#legend figcaption', { hasText: 'Mean curvature, 1 / mm' }).waitFor();
  await page.locator('#status', { hasText: /moved at most [\d.]+ mm/ }).waitFor();
  await find(page, /mean [−\d.]+, radius [\d.]+ mm$/, [0.3, 0.4], [0.3, 0.7]);
});

test('a comb has a root scale, and its sharpest places can be cut off', async () => {
  await open();
  await page.getByLabel('Example').selectOption({ label: 'Aerofoil NACA 2412' });
  await page.locator('#size', { hasText: 'curve' }).waitFor();
  await settled(page);
  const pictures = new Set([await seen()]);
  await page.getByRole('button', { name: 'Root scale' }).click();
  pictures.add(await seen());
  const highest = async () => Math.max(...(await page.locator('#plot text[text-anchor=end]').allTextContents()).map(numberOf));
  const nose = await highest();
  await page.getByLabel('Cut off beyond').fill('80');
  pictures.add(await seen());
  assert.ok((await highest()) < nose / 3, `the plot is not ruled by the nose: ${nose}, then ${await highest()}`);
  await page.getByRole('button', { name: 'Root scale' }).click();
  pictures.add(await seen());
  assert.equal(pictures.size, 4);
});

test('input and result are compared left and right of a line, which is moved', async () => {
  await open();
  await page.keyboard.press('m');
  // Left of the panel, below the buttons, without the line.
  const part = () => seen({ x: 80, y: 200, width: 640, height: 380 });
  const result = await part();
  await page.keyboard.press('i');
  const input = await part();
  assert.ok(input !== result);
  await page.keyboard.press('i');
  await page.getByRole('button', { name: 'Compare' }).click();
  const slider = page.getByLabel('The input left of the line');
  const half = await part();
  assert.ok(half !== input);
  assert.ok(half !== result);
  await slider.fill('100');
  assert.ok((await part()) === input, 'all of the input');
  await slider.fill('0');
  assert.ok((await part()) === result, 'all of the result');
  const box = await page.locator('#canvas').boundingBox();
  const { x: free } = await page.locator('aside').boundingBox();
  await page.mouse.move(box.x + 3, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.75 * (free - box.x), box.y + box.height / 3, { steps: 4 });
  await page.mouse.up();
  assert.equal(await slider.inputValue(), '75');
  const most = await part();
  assert.ok(most !== input && most !== half && most !== result);

  // The picture has both sides, whatever the line hides, and the colours with their legend.
  await page.getByLabel('Unit').selectOption('mm');
  await page.keyboard.press('4');
  await page.locator('#legend .marks').waitFor();
  const { name, path } = await downloaded(page, () => page.keyboard.press('Shift+P'));
  assert.equal(name, 'annulus-before-after.png');
  assert.equal(await slider.inputValue(), '75');
  if (process.env.PICTURES) copyFileSync(path, `${process.env.PICTURES}/before-after.png`);
  const { width, height, data } = await pixels(readFileSync(path).toString('base64'));
  assert.ok(width > 2 * (free - box.x), `${width} by ${height}`);
  const side = (from, to) => {
    const rows = [];
    for (let row = Math.round(0.2 * height); row < 0.7 * height; ++row) rows.push(data.subarray(4 * (row * width + Math.round(from * width)), 4 * (row * width + Math.round(to * width))));
    return Buffer.concat(rows);
  };
  // How much of a side has the colour of the upper end: of the input, whose curvature is great, more.
  const bright = (bytes) => Array.from({ length: bytes.length / 4 }, (_, k) => bytes.subarray(4 * k, 4 * k + 3)).filter(([red, green, blue]) => red > 200 && green > 180 && blue < 80).length / (bytes.length / 4);
  const colours = (bytes) => new Set(Array.from({ length: bytes.length / 4 }, (_, k) => bytes.readUInt32LE(4 * k))).size;
  const sides = [side(0.05, 0.45), side(0.55, 0.95)];
  for (const one of sides) assert.ok(colours(one) > 200, `${colours(one)} colours`);
  assert.ok(bright(sides[0]) > 3 * bright(sides[1]), `${sides.map(bright)}`);
});

// The numbers of the picture as it is, red, green, blue and opacity of each pixel.
async function pixels(picture) {
  const { width, height, data } = await page.evaluate(async (picture) => {
    const image = Object.assign(new Image(), { src: `data:image/png;base64,${picture}` });
    await image.decode();
    const { width, height } = image;
    const context = Object.assign(document.createElement('canvas'), { width, height }).getContext('2d');
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    return { width, height, data: btoa(Array.from(data, (part) => String.fromCharCode(part)).join('')) };
  }, picture);
  return { width, height, data: Buffer.from(data, 'base64') };
}

// How often a row and a column through the middle of the picture, left of the panel, change between dark and light.
async function changes() {
  const { width, height, data } = await pixels(await seen());
  const [x, y] = [Math.round(width / 2 - 144), Math.round(height / 2)];
  const half = Math.round(0.2 * height);  // of the line that is looked at: within the square
  return [(k) => [x + k, y], (k) => [x, y + k]].map((at) => {
    const bright = Array.from({ length: 2 * half }, (_, k) => at(k - half)).map(([column, row]) => data[4 * (row * width + column)] > 128);
    return bright.filter((now, k) => k > 0 && now !== bright[k - 1]).length;
  });
}

// The box around all that has the colour of combs; null where nothing has.
async function combBox(picture) {
  const { width, data } = await pixels(picture);
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let k = 0; k < data.length; k += 4) {
    const [red, green, blue] = data.subarray(k, k + 3);
    if (green < red + 50 || green < blue + 15 || k / 4 % width > width - 310) continue;
    const [x, y] = [(k / 4) % width, Math.floor(k / 4 / width)];
    box.splice(0, 4, Math.min(box[0], x), Math.min(box[1], y), Math.max(box[2], x), Math.max(box[3], y));
  }
  return Number.isFinite(box[0]) ? box : null;
}

test('reflection lines are as many as a slider says, and turned', async () => {
  await open();
  await drop(page, 'square.obj', 'v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n');
  await page.locator('#name', { hasText: 'square.obj' }).waitFor();
  await page.getByRole('button', { name: 'View from the top' }).click();
  const lines = page.getByRole('slider', { name: 'Lines' });
  assert.ok(await lines.isHidden());
  await page.keyboard.press('3');
  const [usual, down] = await changes();
  assert.ok(usual > 1 && down === 0, `upright: ${usual} across, ${down} down`);
  await lines.fill('48');
  const [many] = await changes();
  assert.ok(many > 2 * usual, `${usual}, then ${many}`);
  await page.getByRole('slider', { name: 'Turned' }).fill('90');
  const turned = await changes();
  assert.ok(turned[0] === 0 && turned[1] > 2 * usual, `level: ${turned}`);
  await page.getByLabel('Example').selectOption({ label: 'Noisy wave' });
  await page.locator('#size', { hasText: 'curve' }).waitFor();
  assert.ok(await lines.isHidden());
});

test('that edge springs took over is in the tip of the status, not among the warnings', async () => {
  await open();
  await page.getByLabel('Example').selectOption({ label: 'Pipe blend' });
  await page.locator('#name', { hasText: 'pipe-blend' }).waitFor();
  await settled(page);
  await page.locator('#status[title$="sphere springs have no equilibrium here: these are edge springs"]').waitFor();
  assert.ok(await page.locator('#warnings').isHidden());
});

test('a section of a surface has a comb, is moved by a slider, and follows a drag', async () => {
  await open();
  await page.locator('#gizmo').evaluate((one) => one.remove());  // its axes are coloured too
  const bare = await seen();
  assert.equal(await combBox(bare), null);
  assert.ok(await page.locator('#section-at').isHidden());
  await page.getByLabel('Across').selectOption({ label: 'X' });
  const middle = await combBox(await seen());
  assert.ok(middle[2] - middle[0] > 50 || middle[3] - middle[1] > 50, `${middle}`);
  await page.locator('#section-at').fill('150');
  const aside = await combBox(await seen());
  assert.ok(aside[0] < middle[0] - 50, `${middle}, then ${aside}`);
  const value = page.getByLabel('At', { exact: true });
  await value.fill('-0.7');
  await value.press('Enter');
  assert.equal(Number(await page.locator('#section-at').inputValue()), 150, 'the slider is where the number says');
  assert.deepEqual(await combBox(await seen()), aside);
  const count = page.getByLabel('How many');
  await count.fill('9');
  await count.press('Enter');
  const several = await combBox(await seen());
  assert.ok(several[2] - several[0] > 2 * (aside[2] - aside[0]), `${aside}, then ${several}`);
  assert.ok(await value.isHidden());
  await count.fill('1');
  await count.press('Enter');
  await page.locator('#section-comb').fill('0');
  assert.equal(await combBox(await seen()), null, 'no hairs');
  await page.locator('#section-comb').fill('1');
  await page.locator('#section-at').fill('500');

  const { x, y } = await find(page, /position fixed/, [0.35, 0.4], [0.35, 0.7]);
  await page.mouse.click(x, y);
  await page.keyboard.press('l');
  await page.mouse.down();
  for (let k = 1; k <= 10; ++k) await page.mouse.move(x, y - 10 * k);
  await follows(page);
  await page.waitForTimeout(300);
  const held = await combBox(await picture(page));
  assert.ok(Math.max(...held.map((end, k) => Math.abs(end - middle[k]))) > 20, `${middle}, then ${held}`);
  await page.mouse.up();
  await settled(page);
  for (let k = 0; k < 3; ++k) await page.keyboard.press('v');  // Y, Z, none
  await page.locator('#section-at').waitFor({ state: 'hidden' });
  assert.equal(await combBox(await seen()), null);
});

test('colours that are chosen are those of a file that is then opened, too', async () => {
  await open();
  await page.keyboard.press('4');
  await page.locator('#legend .marks').waitFor();
  await choose(page, 'Open…', session.generated('saddle.obj', 'saddle', '--columns', '20', '--rows', '20'));
  await page.locator('#size', { hasText: '441 nodes' }).waitFor();
  await settled(page);
  await page.locator('#legend').waitFor();
  await find(page, /mean [−\d.e]+, radius/, [0.3, 0.4], [0.4, 0.7]);
});
