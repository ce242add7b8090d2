// The examples: each opens and converges; those of the paper are what its commands make.

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { greatestDistance, native, open, page, placesOf, root, saved, session, settled, useSession } from './support.mjs';

useSession();

test('every example opens with what holds it, and converges', async () => {
  await open();
  const menu = page.getByLabel('Example');
  assert.equal(await menu.locator('option:checked').textContent(), 'Annulus');
  const titles = await menu.locator('optgroup option').allTextContents();
  assert.ok(titles.length >= 8);
  for (const title of titles.reverse()) {
    const before = await page.locator('#size').textContent();
    await menu.selectOption({ label: title });
    if (!title.startsWith('Fig. 8')) await page.locator('#size').filter({ hasNotText: before }).waitFor();
    await settled(page);
    assert.equal(await menu.locator('option:checked').textContent(), title);
    assert.ok(await page.getByRole('button', { name: 'Undo' }).isDisabled());
    assert.ok(await page.getByRole('alert').isHidden());
  }
});

test('figures of the paper: the shapes are those of its commands, and Figs. 8(C) and 12 are what the native program makes', async () => {
  for (const [number, ...options] of [[8, 'annulus', '--nodes', '553', '--boundary-nodes', '121'],
    [9, 'annulus', '--nodes', '553', '--boundary-nodes', '121', '--noise', '0.08', '--seed', '7'], [10, 'pipe-blend', '--pipes=+x,+z,-z', '--cells', '10'], [12, 'polygon-patch', '--sides', '5', '--rings', '10']]) {
    const [ours, theirs] = [join(root, `examples/figure-${number}.obj`), session.generated(`${number}.obj`, ...options)];
    assert.ok(greatestDistance(...[ours, theirs].map(placesOf)) < 1e-12);
  }
  await open('?file=examples/saddle.ply');
  assert.equal(await page.getByLabel('Example').inputValue(), '', 'a file of somebody is no example, whatever its name');
  await page.getByLabel('Example').selectOption({ label: 'Fig. 8(C): normals too' });
  await page.locator('#name', { hasText: 'figure-8' }).waitFor();
  await settled(page);
  assert.equal(await page.getByRole('button', { name: 'Normals fixed' }).getAttribute('aria-pressed'), 'true');
  const { path } = await saved(page);
  const fair = join(session.folder, 'fair.obj');
  native('fair', join(root, 'examples/figure-8.obj'), '-o', fair, '--fix-normals', 'boundary', '--quiet');
  const same = (ours) => assert.ok(greatestDistance(...[ours, fair].map(placesOf)) < 6e-5);
  same(path);
  await page.getByLabel('Example').selectOption({ label: 'Fig. 12: to points' });
  await page.locator('#name', { hasText: 'figure-12' }).waitFor();
  await settled(page);
  const [patch, points] = ['obj', 'xyz'].map((format) => join(root, `examples/figure-12.${format}`));
  native('fit', patch, '--points', points, '-o', fair, '--weight', '0.01', '--quiet');
  same((await saved(page)).path);
});
