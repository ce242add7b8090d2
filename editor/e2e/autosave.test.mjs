// What is open outlives the page: after a crash, with its history and points; and where nothing can be kept, it is said once.

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

// Until the step of that label is in the storage.
async function kept(page, label) {
  await page.waitForFunction((wanted) => new Promise((done) => {
    indexedDB.open('vspring-editor').onsuccess = ({ target: { result: database } }) => {
      if (!database.objectStoreNames.contains('kept')) return done(false);
      database.transaction('kept').objectStore('kept').get('state').onsuccess = ({ target: { result } }) => {
        database.close();
        done(result?.history.now.label.startsWith(wanted));
      };
    };
  }), label);
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
