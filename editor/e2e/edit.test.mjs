// `vspring edit`: a file is opened by the program, pulled in the page, and saved back when that is asked for.

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { after, test } from 'node:test';
import { drag, faults, find, greatestDistance, native, open, page, placesOf, program, root, rulesOf, session, settled, useSession } from './support.mjs';

useSession();

// The program, and the address that it prints.
async function edited(...options) {
  const child = spawn(program, ['edit', ...options, '--no-browser', '--quiet'],
    { stdio: ['ignore', 'pipe', 'inherit'], env: { ...process.env, VSPRING_EDITOR: join(root, 'build/editor') } });
  running.add(child);
  const [address] = await once(createInterface(child.stdout), 'line');
  return { child, address };
}

// A test that fails leaves its program behind, and that would keep this process waiting.
const running = new Set();
after(() => { for (const child of running) child.kill('SIGKILL'); });

async function ended({ child }) {
  child.kill('SIGINT');
  const [status] = await once(child, 'exit');
  assert.equal(status, 0);
}

test('a node is dragged and the file saved back: it is what the command line makes of the same constraints', async () => {
  const original = join(root, 'examples/annulus.obj');
  const file = join(session.folder, 'my annulus & more.obj');
  copyFileSync(original, file);
  const editor = await edited(file);
  await open(editor.address);
  assert.equal(await page.locator('#name').textContent(), 'my annulus & more.obj');
  assert.ok(await page.evaluate(() => crossOriginIsolated));

  const held = await find(page, /position fixed/, [0.02, 0.55], [0.5, 0.55]);
  await drag(page, held, -20, -60);
  assert.deepEqual(readFileSync(file), readFileSync(original), 'nothing is written unless it is asked for');
  await page.keyboard.press('Control+s');
  const button = page.getByRole('button', { name: 'Saved to my annulus & more.obj' });
  await button.waitFor();
  assert.ok(await button.isDisabled());

  const [rules, fair] = [join(session.folder, 'rules.json'), join(session.folder, 'fair.obj')];
  writeFileSync(rules, await rulesOf(page));
  native('fair', original, '-o', fair, '--constraints', rules, '--quiet');
  const [saved, expected, before] = [file, fair, original].map(placesOf);
  assert.ok(greatestDistance(saved, expected) < 6e-5, `${greatestDistance(saved, expected)}`);  // six times the tolerance of 1e-5, on a size of some 2.4
  assert.ok(greatestDistance(saved, before) > 0.05);

  const again = page.getByRole('button', { name: 'Save to my annulus & more.obj' });
  await page.keyboard.press('Control+z');
  await settled(page);
  await ended(editor);
  await again.click();
  await page.getByRole('alert').filter({ hasText: 'is not saved: vspring edit does not answer' }).waitFor();
  faults.length = 0;  // the console says so too
});

test('the result goes to another file and format, and another mesh that is opened does not', async () => {
  const output = join(session.folder, 'out.ply');
  const editor = await edited(session.generated('patch.obj', 'saddle', '--columns', '8', '--rows', '8'), '-o', output);
  await open(editor.address);
  const save = page.getByRole('button', { name: 'Save to out.ply' });
  await save.click();
  await page.getByRole('button', { name: 'Saved to out.ply' }).waitFor();
  assert.match(readFileSync(output, 'latin1'), /^ply[^]*element vertex 81/);

  await page.getByLabel('Example').selectOption({ label: 'Annulus' });
  await page.locator('#name', { hasText: 'annulus.obj' }).waitFor();
  await settled(page);
  await save.and(page.locator(':disabled')).waitFor();
  await ended(editor);
});

test('a curve is saved back as the command line fairs it', async () => {
  const rows = Array.from({ length: 40 }, (_, k) => [k / 40, 0.3 * Math.sin(k / 6) + 0.01 * Math.sin(7 * k)].join(','));
  const [file, input, fair] = ['arc.csv', 'input.csv', 'fair.csv'].map((name) => join(session.folder, name));
  for (const path of [file, input]) writeFileSync(path, `x,y\n${rows.join('\n')}\n`);
  const editor = await edited(file);
  await open(editor.address);
  await page.getByRole('button', { name: 'Save to arc.csv' }).click();
  await page.getByRole('button', { name: 'Saved to arc.csv' }).waitFor();
  native('curve', input, '-o', fair, '--quiet');
  const [saved, expected, before] = [file, fair, input].map(placesOf);
  assert.ok(greatestDistance(saved, expected) < 6e-5, `${greatestDistance(saved, expected)}`);  // six times the tolerance of 1e-5, on a size of some 1
  assert.ok(greatestDistance(saved, before) > 0.01);

  // With other nodes it is still that file.
  await page.keyboard.press('Control+a');
  await page.keyboard.press('a');
  await page.locator('#size', { hasText: '79 nodes' }).waitFor();
  await settled(page);
  await page.getByRole('button', { name: 'Save to arc.csv' }).click();
  await page.getByRole('button', { name: 'Saved to arc.csv' }).waitFor();
  assert.equal(placesOf(file).length, 79);
  await ended(editor);
});
