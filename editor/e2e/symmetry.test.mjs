// Mirror symmetry: what is picked, dragged, moved by numbers and tilted on one side of a plane is so on the other.

import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { drag, find, follows, greatestDistance, open, page, placesOf, rulesOf, saved, session, settled, useSession } from './support.mjs';

const side = 13;

useSession(() => {
  const lines = [];
  for (let row = 0; row < side; ++row) for (let column = 0; column < side; ++column) {
    const [x, y] = [column, row].map((k) => (2 * k) / (side - 1) - 1);
    lines.push(`v ${x} ${y} ${0.3 * (x * x - y * y)}`);
  }
  const node = (row, column) => row * side + column + 1;
  for (let row = 0; row + 1 < side; ++row) for (let column = 0; column + 1 < side; ++column) lines.push(`f ${node(row, column)} ${node(row, column + 1)} ${node(row + 1, column + 1)} ${node(row + 1, column)}`);
  writeFileSync(join(session.folder, 'patch.obj'), `${lines.join('\n')}\n`);
});

const imageOf = (node) => node - (node % side) + side - 1 - (node % side);
const mirrored = (places) => places.map((_, node) => { const [x, y, z] = places[imageOf(node)]; return [-x, y, z]; });
const edits = async () => {
  const { nodes, position } = JSON.parse(await rulesOf(page)).rules.find((rule) => Array.isArray(rule.position));
  return new Map(nodes.map((node, k) => [node, position[k]]));
};

async function fromAbove() {
  await open('?file=files/patch.obj');
  await page.getByRole('button', { name: 'View from the top' }).click();
  await page.getByLabel('Symmetry about').selectOption({ label: 'x = 0' });
  await page.locator('#symmetric', { hasText: '169 of 169 nodes have a mirror image' }).waitFor();
}

test('a pair is picked by a click, dragged to mirror places, and let go by Shift; the shape stays symmetric', async () => {
  await fromAbove();
  const { x, y, node } = await find(page, /position fixed/, [0.75, 0.45], [0.45, 0.45]);
  assert.equal(node % side, side - 1, 'at the right side');
  await page.mouse.click(x, y);
  await page.locator('#picked', { hasText: /^2 nodes$/ }).waitFor();
  await drag(page, { x, y }, 25, -15, () => follows(page));
  const places = await edits();
  assert.deepEqual([...places.keys()].sort((a, b) => a - b), [imageOf(node), node].sort((a, b) => a - b));
  const [right, left] = [places.get(node), places.get(imageOf(node))];
  assert.ok(right[0] > 1.02, `${right}`);
  right.forEach((part, i) => assert.ok(Math.abs(part - (i === 0 ? -left[i] : left[i])) < 1e-12, `${right} and ${left}`));
  const shape = placesOf((await saved(page)).path);
  assert.ok(greatestDistance(shape, mirrored(shape)) < 1e-4, `${greatestDistance(shape, mirrored(shape))}`);

  assert.equal(Number(await page.getByLabel('Position x').inputValue()).toFixed(5), right[0].toFixed(5), 'a pair has a place, as one node has');
  await page.getByLabel('Position x').fill(String(right[0] + 0.1));
  await page.keyboard.press('Enter');
  await settled(page);
  const moved = await edits();
  assert.ok(Math.abs(moved.get(node)[0] - right[0] - 0.1) < 1e-9 && Math.abs(moved.get(imageOf(node))[0] - left[0] + 0.1) < 1e-9);

  const again = await find(page, new RegExp(`Node ${node} `), [0.9, 0.4], [0.45, 0.4]);
  await page.keyboard.down('Shift');
  await page.mouse.click(again.x, again.y);
  await page.keyboard.up('Shift');
  await page.locator('#picked', { hasText: 'No node picked' }).waitFor();
  await page.getByLabel('Symmetry about').selectOption({ label: 'none' });
  await page.mouse.click(again.x, again.y);
  await page.locator('#picked', { hasText: new RegExp(`^Node ${node}$`) }).waitFor();
});

test('a node on the plane stays on it; a box on one side picks both, and Alt lets both go', async () => {
  await fromAbove();
  const half = (side - 1) / 2;
  const middle = await find(page, new RegExp(`Node ${half} · position fixed`), [0.375, 0.98], [0.375, 0.5]);
  await page.mouse.click(middle.x, middle.y);
  await page.locator('#picked', { hasText: new RegExp(`^Node ${half}$`) }).waitFor();
  await drag(page, middle, 40, 30, () => follows(page));
  const [place] = (await edits()).values();
  assert.equal(place[0], 0);
  assert.ok(place[1] < -1.02, `${place}`);

  await page.keyboard.press('w');
  const box = await page.locator('#canvas').boundingBox();
  const across = async (from, to) => {
    await page.mouse.move(box.x + from * box.width, box.y + 0.12 * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + to * box.width, box.y + 0.9 * box.height, { steps: 3 });
    await page.mouse.up();
  };
  await across(0.42, 0.75);
  const picked = async () => Number((await page.locator('#picked').textContent()).match(/^(\d+)/)[1]);
  const count = await picked();
  assert.ok(count > 80 && count % 2 === 0 && count < 169, `${count} nodes`);
  await page.keyboard.down('Alt');
  await across(0.5, 0.75);
  await page.keyboard.up('Alt');
  const fewer = await picked();
  assert.ok(fewer < count && fewer % 2 === 0 && fewer > 0, `${fewer} of ${count}`);
});
