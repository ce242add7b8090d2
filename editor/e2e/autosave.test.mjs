// What is open outlives the page: after a crash, with its history and points, each file by itself; and where nothing can be kept, it is said once.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { drag, drop, find, freeForm, rulesOf, saved, session, settled, useSession } from './support.mjs';

useSession();

let context;

async function visit(query = '') {
  const page = await context.newPage();
  await page.setViewportSize({ width: 1200, height: 760 });
  await page.goto(session.address + query);
  await settled(page);
  return page;
}

const recent = (page) => page.locator('#example optgroup[label=Recent] option');

// Until the step of that label is in the storage, as the newest of all.
async function kept(page, label) {
  await recent(page).first().filter({ hasText: ` · ${label}` }).waitFor({ state: 'attached' });
}

async function crash(page) {
  const crashed = page.waitForEvent('crash');
  (await context.newCDPSession(page)).send('Page.crash').catch(() => {});
  await crashed;
}

test('a reload after a crash', async () => {
  context = await session.browser.newContext();
  let page = await visit();
  assert.ok(await page.locator('#restored').isHidden(), 'nothing was left');
  session.generated('mine.obj', 'annulus', '--nodes', '300');
  await drop(page, 'mine.obj', readFileSync(`${session.folder}/mine.obj`, 'utf8'));
  await page.locator('#name', { hasText: 'mine.obj' }).waitFor();
  await settled(page);
  await freeForm(page);
  const held = await find(page, /position fixed/, [0.02, 0.55], [0.5, 0.55]);
  await drag(page, held, -20, -40);
  await drop(page, 'one.csv', 'x,y,z\n0.7,0,0.2\n', true);
  await page.locator('#fit-figures').filter({ hasText: 'one.csv: 1 points · at most' }).waitFor();
  await settled(page);
  await kept(page, 'Load points one.csv');
  const [rules, shape] = [await rulesOf(page), readFileSync((await saved(page)).path)];
  await crash(page);

  page = await visit();
  await page.locator('#restored', { hasText: 'Restored mine.obj' }).waitFor();
  await page.locator('#fit-figures').filter({ hasText: 'one.csv: 1 points · at most' }).waitFor();
  assert.equal(await page.locator('#name').textContent(), 'mine.obj');
  assert.equal(await rulesOf(page), rules);
  assert.deepEqual(readFileSync((await saved(page)).path), shape);
  await page.keyboard.press('Control+z');
  await settled(page);
  assert.match(await page.getByRole('button', { name: 'Undo' }).getAttribute('title'), new RegExp(`Move node ${held.node}`));
  await page.keyboard.press('Control+z');
  await settled(page);
  assert.notEqual(await rulesOf(page), rules);
  await page.keyboard.press('Control+y');
  await settled(page);
  await kept(page, 'Move node');
  await page.close();

  const other = await visit('?file=examples/saddle.ply');
  assert.equal(await other.locator('#name').textContent(), 'saddle.ply');
  await other.close();
  page = await visit();
  await page.locator('#restored', { hasText: 'Restored mine.obj' }).waitFor();
  await page.getByRole('button', { name: 'Start afresh' }).click();
  await page.locator('#name', { hasText: 'annulus.obj' }).waitFor();
  await settled(page);
  assert.ok(await page.locator('#restored').isHidden());
  await page.close();
  page = await visit();
  assert.equal(await page.locator('#name').textContent(), 'annulus.obj');
  assert.ok(await page.locator('#restored').isHidden());
  await context.close();
});

test('two pages and two files each have a place of their own, and what was worked on lately is listed', async () => {
  context = await session.browser.newContext();
  const tent = (height) => `v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0.6 0.6 ${height}\nf 1 2 4\nf 2 3 4\nf 3 1 4\n`;
  const begin = async (page, name, height) => {
    await drop(page, name, tent(height));
    await page.locator('#name', { hasText: name }).waitFor();
    await settled(page);
    await page.keyboard.press('Shift+B');
    await settled(page);
    await kept(page, 'Fix boundary normals');
  };
  const restored = async (page, name) => {
    await page.locator('#restored', { hasText: `Restored ${name}` }).waitFor();
    assert.equal(await page.getByRole('button', { name: 'Normals fixed' }).getAttribute('aria-pressed'), 'true');
  };
  const pages = [await visit(), await visit()];
  await begin(pages[0], 'one.obj', 1);
  await begin(pages[1], 'two.obj', 2);
  await begin(pages[1], 'three.obj', 3);
  // On a busy machine a page that is reloaded lets go late of what it had.
  const slot = await pages[0].evaluate(() => sessionStorage.getItem('vspring-slot'));
  await pages[1].evaluate((name) => void navigator.locks.request(name, { steal: true }, () => new Promise((release) => setTimeout(release, 3000))), `vspring-${slot}`);
  for (const [k, name] of [[0, 'one.obj'], [1, 'three.obj']]) {
    await pages[k].reload();
    await restored(pages[k], name);
  }
  for (const page of pages) await page.close();

  const page = await visit();
  await restored(page, 'three.obj');
  const listed = await recent(page).allTextContents();
  assert.deepEqual(listed.map((line) => line.split(' · ').slice(0, 2).join(' · ')), ['three.obj', 'two.obj', 'one.obj'].map((name) => `${name} · Fix boundary normals`).concat('Forget those that are not open'));
  await page.getByLabel('Example').selectOption({ label: listed[2] });
  await restored(page, 'one.obj');
  assert.equal(readFileSync((await saved(page)).path, 'utf8'), tent(1));
  await page.getByLabel('Example').selectOption({ label: 'Forget those that are not open' });
  await recent(page).nth(2).waitFor({ state: 'detached' });
  assert.match(await recent(page).first().textContent(), /^one\.obj/);
  await context.close();
});

test('a drawn curve comes back too, with its own nodes as points', async () => {
  context = await session.browser.newContext();
  let page = await visit();
  await page.getByRole('button', { name: 'New curve' }).click();
  for (const [x, y] of [[300, 300], [500, 400], [700, 300]]) await page.mouse.click(x, y);
  await page.keyboard.press('Enter');
  await page.locator('#name', { hasText: 'curve.csv' }).waitFor();
  await settled(page);
  await page.getByRole('button', { name: 'Its own nodes' }).click();
  await settled(page);
  await kept(page, 'Fit to its own nodes');
  const [rules, shape] = [await rulesOf(page), readFileSync((await saved(page)).path)];
  await crash(page);
  page = await visit();
  await page.locator('#restored', { hasText: 'Restored curve.csv' }).waitFor();
  await page.locator('#fit-figures').filter({ hasText: 'Its own 41 nodes · at most' }).waitFor();
  assert.deepEqual(readFileSync((await saved(page)).path), shape);
  assert.equal(await rulesOf(page), rules);
  await context.close();
});

test('where the browser keeps nothing the editor goes on, and says so once', async () => {
  context = await session.browser.newContext();
  await context.addInitScript(() => { IDBFactory.prototype.open = () => { throw new Error('no room'); }; });
  const page = await visit();
  await page.keyboard.press('Shift+B');
  const alert = page.getByRole('alert').filter({ hasText: 'The browser keeps nothing for a reload: no room' });
  await alert.waitFor();
  await page.getByRole('button', { name: 'Dismiss' }).first().click();
  await alert.waitFor({ state: 'hidden' });
  await page.keyboard.press('Shift+B');
  await settled(page);
  await page.keyboard.press('z');
  await settled(page);
  assert.ok(await alert.isHidden());
  await context.close();
});
