// What is looked at: curvatures and deviation by their colours, and shapes between the input and the result.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { drop, find, greatestDistance, native, open, page, placesOf, root, saved, session, settled, useSession } from './support.mjs';

useSession();

function scalarsOf(path, ...options) {
  const file = join(session.folder, 'scalars.vtp');
  native('measure', path, '--scalars', file, ...options);
  const text = readFileSync(file, 'utf8');
  return (name) => text.match(new RegExp(`Name="${name}"[^>]*>([^<]*)<`))[1].trim().split(/\s+/).map(Number);
}

const numberOf = (text) => Number(text.replace('−', '-').replace(/^[≤≥ ]+/, ''));
const legend = async () => (await page.locator('#legend .marks span').allTextContents()).map(numberOf);
const quantile = (values, share) => values.slice().sort((a, b) => a - b)[Math.round(share * (values.length - 1))];
const near = (a, b, share, what) => assert.ok(Math.abs(a - b) <= share * Math.max(Math.abs(a), Math.abs(b)) + 1e-9, `${what}: ${a}, ${b}`);

test('curvatures have the values of --scalars, at nodes and in the legend; their colours are those of the result', async () => {
  await open('?file=examples/pipe-blend.obj');
  const path = join(session.folder, 'fair.obj');
  native('fair', join(root, 'examples/pipe-blend.obj'), '-o', path, '--quiet');
  const scalars = scalarsOf(path);
  const pictures = new Set();
  for (const [button, key, name, range] of [
    ['Mean', '4', 'mean_curvature', (values) => [quantile(values, 0.02), quantile(values, 0.98)]],
    ['Gaussian', '5', 'gaussian_curvature', (values) => [-quantile(values.map(Math.abs), 0.98), quantile(values.map(Math.abs), 0.98)]]]) {
    await page.keyboard.press(key);
    assert.equal(await page.getByRole('button', { name: button }).getAttribute('aria-pressed'), 'true');
    await page.locator('#legend').waitFor();
    const values = scalars(name);
    const marks = await legend();
    range(values).forEach((end, k) => near(marks[2 * k], end, 0.01, `${name} in the legend`));
    const { node } = await find(page, new RegExp(`free · ${button.toLowerCase()}`), [0.4, 0.45], [0.4, 0.6]);
    const said = await page.locator('#node').textContent();
    near(numberOf(said.match(/(?:mean|gaussian) ([^ ,]+)/)[1]), values[node], 0.01, `${name} of node ${node}`);
    if (button === 'Mean') near(Number(said.match(/, radius (\S+)$/)[1]), Math.abs(1 / values[node]), 0.01, 'radius');
    pictures.add((await page.locator('#canvas').screenshot()).toString('base64'));
    await page.keyboard.press('i');
    await page.locator('#status', { hasText: 'The input' }).waitFor();
    assert.deepEqual(await legend(), marks, 'the input has the range of the result');
    await page.keyboard.press('i');
    await settled(page);
  }
  await page.keyboard.press('1');
  await page.locator('#legend').waitFor({ state: 'hidden' });
  pictures.add((await page.locator('#canvas').screenshot()).toString('base64'));
  assert.equal(pictures.size, 3);
});

test('deviation is how far nodes lie from the input along its normal', async () => {
  session.generated('plane.obj', 'plane', '--columns', '16', '--rows', '16');
  await open('?file=files/plane.obj');
  await page.keyboard.press('6');
  await page.locator('#legend').waitFor();
  let held;
  for (let x = 0.3; !held; x += 0.01) held = await find(page, /position fixed/, [x, 0.5], [x, 1]).catch(() => null);
  await page.mouse.down();
  for (let k = 1; k <= 6; ++k) await page.mouse.move(held.x, held.y - 8 * k);
  await page.mouse.up();
  await settled(page);
  await page.locator('#legend .marks').filter({ hasText: /≥ 0\.\d/ }).waitFor();
  const heights = placesOf((await saved(page)).path).map(([, , z]) => z);
  const { node } = await find(page, /free · deviation/, [0.33, 0.5], [0.4, 0.75]);
  const value = numberOf((await page.locator('#node').textContent()).split(' ').at(-1));
  near(Math.abs(value), Math.abs(heights[node]), 0.001, `node ${node}`);
  assert.ok(Math.abs(value) > 1e-4);
  near((await legend())[2], quantile(heights.map(Math.abs), 0.98), 0.01, 'legend');
});

test('between input and result: what is saved is what --strength makes; a drag shows the result again', async () => {
  await open('?file=examples/annulus.obj');
  const save = page.getByRole('button', { name: 'Save as' });
  assert.doesNotMatch(await save.getAttribute('title'), /%/);
  const whole = placesOf((await saved(page)).path);
  const strength = page.getByLabel('Strength');
  await strength.focus();
  await page.keyboard.press('End');
  for (let k = 0; k < 40; ++k) await page.keyboard.press('ArrowLeft');
  assert.equal(await page.locator('#share').textContent(), '60 %');
  assert.match(await save.getAttribute('title'), /60 % of the way from the input/);
  const ours = placesOf((await saved(page)).path);
  const path = join(session.folder, 'strength.obj');
  native('fair', join(root, 'examples/annulus.obj'), '-o', path, '--strength', '0.6', '--quiet');
  assert.ok(greatestDistance(ours, placesOf(path)) < 6e-5);
  assert.ok(greatestDistance(ours, whole) > 0.01);
  await strength.press('Home');
  assert.deepEqual(placesOf((await saved(page)).path), placesOf(join(root, 'examples/annulus.obj')), 'the input itself');

  await page.locator('#canvas').focus();
  const held = await find(page, /position fixed/, [0.02, 0.55], [0.5, 0.55]);
  await page.mouse.down();
  await page.mouse.move(held.x - 10, held.y - 20);
  assert.equal(await page.locator('#share').textContent(), '100 %');
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await settled(page);
  assert.deepEqual(placesOf((await saved(page)).path), whole);
});

test('a file whose Y is upwards stands up by itself; a choice is kept, and sides are named by it', async () => {
  await open('?file=examples/annulus.obj', { untouched: true });
  const up = page.getByLabel('Up');
  assert.equal(await up.locator('option:checked').textContent(), 'seems Z');
  // A pyramid that stands on y = 0.
  await drop(page, 'mast.obj', 'v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 3 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n');
  await page.locator('#name', { hasText: 'mast.obj' }).waitFor();
  await settled(page);
  assert.equal(await up.locator('option:checked').textContent(), 'seems Y');
  const box = await page.locator('#canvas').boundingBox();
  // Where the tip is, as a share of the height, seen from the front.
  const tip = async () => {
    await page.getByRole('button', { name: 'View from the front' }).click();
    const line = [0.5 - 0.5 * (300 / box.width), 0.5 - 0.5 * (300 / box.width)];
    return ((await find(page, /Node 4 /, [line[0], 0.05], [line[1], 0.95])).y - box.y) / box.height;
  };
  assert.equal(await page.getByRole('button', { name: 'View from the top, Y' }).count(), 1);
  assert.ok((await tip()) < 0.2, 'the tip is on top');
  await page.getByRole('button', { name: 'View from the top, Y' }).click();
  await page.locator('#canvas').focus();
  for (let k = 0; k < 12; ++k) await page.keyboard.press('ArrowUp');
  await up.selectOption('z');
  assert.equal(await page.getByRole('button', { name: 'View from the top, Z' }).count(), 1);
  assert.ok((await tip()) > 0.3, 'it lies on its back');
  await page.reload();
  await settled(page);
  assert.equal(await up.inputValue(), 'z');
});

test('a browser without WebGL 2 is told what is missing and what to do', async () => {
  const without = await session.browser.newPage();
  const faults = [];
  without.on('pageerror', (error) => faults.push(String(error)));
  await without.addInitScript(() => {
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return kind === 'webgl2' ? null : get.call(this, kind, ...rest); };
  });
  await without.goto(session.address);
  await without.getByRole('alert').filter({ hasText: /no WebGL 2.*Switch hardware acceleration on/ }).waitFor();
  assert.equal(await without.locator('#status').textContent(), 'Cannot draw');
  assert.ok(await without.locator('header').evaluate((header) => header.inert), 'buttons that could do nothing');
  assert.deepEqual(faults, ['Error: no WebGL 2'], 'nothing else goes wrong');
  await without.close();
});
