// What somebody needs who sees little or has no pointer: names of controls, visible focus, all of the page by Tab, keys that are listed.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { choose, find, open, page, root, session, settled, solving, useSession } from './support.mjs';

useSession();

const controls = 'button, input, select, textarea, canvas, [tabindex], [role=toolbar], [role=group], dialog[open], progress';

// What axe-core finds wrong with the page as it is, WCAG 2.1 AA and good practice.
async function violations() {
  await page.addScriptTag({ path: join(root, 'editor/node_modules/axe-core/axe.min.js') });
  return page.evaluate(async () => (await axe.run()).violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120)).join(' | ')}`));
}

// All controls have names, as Chromium tells them to a screen reader, and no two of them the same with the same description. Returns the names.
async function names() {
  const cdp = await page.context().newCDPSession(page);
  const { root: { nodeId } } = await cdp.send('DOM.getDocument');
  const { nodeIds } = await cdp.send('DOM.querySelectorAll', { nodeId, selector: controls });
  const found = [];
  const told = new Set();
  for (const one of nodeIds) {
    const { nodes: [{ ignored, role, name, description }] } = await cdp.send('Accessibility.getPartialAXTree', { nodeId: one, fetchRelatives: false });
    if (ignored) continue;
    const { outerHTML } = await cdp.send('DOM.getOuterHTML', { nodeId: one });
    assert.ok(name?.value.trim(), `no name: ${outerHTML}`);
    const words = JSON.stringify([role.value, name.value, description?.value]);
    assert.ok(!told.has(words), `twice: ${words}`);
    told.add(words);
    found.push(name.value);
  }
  await cdp.detach();
  return found;
}

// Tab goes to each control that can be used, once around, and what has the focus is outlined.
async function walkByTab() {
  const all = await page.evaluate(() => {
    const stops = [...document.querySelectorAll('button, input, select, canvas')].filter((one) => one.checkVisibility() && !one.disabled && one.tabIndex >= 0);
    stops.forEach((one, k) => { one.dataset.stop = k; });
    return stops.map((one) => one.outerHTML);
  });
  const reached = new Set();
  // One more, for between the last and the first.
  for (let k = 0; k <= all.length; ++k) {
    await page.keyboard.press('Tab');
    const at = await page.evaluate(() => {
      const at = document.activeElement;
      const { outlineStyle, outlineWidth } = getComputedStyle(at);
      return at === document.body ? null : { stop: at.dataset.stop, html: at.outerHTML, outlined: outlineStyle !== 'none' && parseFloat(outlineWidth) >= 2 };
    });
    if (!at) continue;
    assert.ok(at.stop !== undefined, `Tab goes to ${at.html}`);
    assert.ok(at.outlined, `no outline: ${at.html}`);
    reached.add(Number(at.stop));
  }
  assert.deepEqual(all.filter((_, k) => !reached.has(k)), []);
}

for (const colorScheme of ['light', 'dark']) {
  test(`axe-core finds nothing, ${colorScheme}: a file that is tried on, a curve, the list of keys`, async () => {
    await open('?file=examples/saddle.ply', { untouched: true, colorScheme });
    assert.deepEqual(await violations(), []);
    await page.getByRole('button', { name: 'Smooth it' }).click();
    await page.locator('#start-says', { hasText: 'Moves' }).waitFor();
    // However it ended.
    await page.locator('#status:not([data-outcome="solving"])').waitFor();
    await page.getByRole('button', { name: 'Deviation' }).click();
    await page.locator('#legend').waitFor();
    assert.deepEqual(await violations(), []);
    await page.getByLabel('Example').selectOption({ label: 'Noisy wave' });
    await page.locator('#size', { hasText: 'curve' }).waitFor();
    await settled(page);
    assert.deepEqual(await violations(), []);
    await page.keyboard.press('?');
    await page.getByRole('dialog', { name: 'Keyboard shortcuts' }).waitFor();
    assert.deepEqual(await violations(), []);
  });
}

test('a surface with points: every control has a name, and Tab reaches it', async () => {
  await open();
  await page.getByRole('button', { name: 'Its own nodes' }).click();
  await page.locator('#fit-figures').filter({ hasText: 'at most' }).waitFor();
  await settled(page);
  const { x, y } = await find(page, /position fixed/, [0.02, 0.55], [0.5, 0.55]);
  await page.mouse.click(x, y);
  await page.getByLabel('Position x').waitFor();
  await choose(page, 'Open…', { name: 'bad.obj', text: 'v 0 zero 0\n' });
  await page.getByRole('alert').waitFor();
  const said = await names();
  for (const name of ['Open…', 'Fit by', 'How much', 'Smoothing length, units of the file', 'Outliers, %', 'Position z', 'Normal x', 'Dismiss', 'Pick in a box', 'Strength', 'Tools', 'History']) {
    assert.ok(said.some((other) => other.startsWith(name)), `${name} in ${said}`);
  }
  await walkByTab();
});

test('a curve: every control has a name, and Tab reaches it', async () => {
  await open('?file=examples/wave.csv');
  const said = await names();
  for (const name of ['Comb', 'Plot along the curve', 'Fold the plot away', 'Nodes a span']) assert.ok(said.includes(name), `${name} in ${said}`);
  await walkByTab();
});

test('the progress bar has a name and so has what ends it', async () => {
  session.generated('large.ply', 'annulus', '--nodes', '400000', '--noise', '0.01');
  await open('?file=files/large.ply', { wait: false });
  await solving(page);
  assert.ok((await names()).includes('Cancel'));
  await page.keyboard.press('Escape');
  await settled(page, 'cancelled');
});

test('the list of keys has all of the documentation, and the documentation all of the list', async () => {
  await open();
  await page.keyboard.press('?');
  const dialog = page.getByRole('dialog', { name: 'Keyboard shortcuts' });
  await dialog.waitFor();
  await names();
  const listed = await dialog.locator('kbd').allTextContents();
  const [, table] = readFileSync(join(root, 'docs/editor.md'), 'utf8').match(/\n## Keys\n\n\| \| \|\n\|---\|---\|\n((?:\|.*\n)+)/);
  const documented = table.trim().split('\n').flatMap((row) => row.split('|')[1].trim().split(/[,;] | or /)).map((key) => key.replace('−', '-'));
  assert.deepEqual([...new Set(documented)].sort(), [...new Set(listed)].sort());
  await page.keyboard.press('Escape');
  await dialog.waitFor({ state: 'hidden' });
});
