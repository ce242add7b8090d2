// Curves in the editor: real pointer and keys, and the native program's result to compare with.

import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { choose, drag, drop, find, follows, freeForm, greatestDistance, native, open, page, picture, placesOf, root, rulesOf, saved, session, settled, useSession } from './support.mjs';

useSession(() => {
  const wave = Array.from({ length: 61 }, (_, k) => [k / 10, Math.sin(k / 9) + 0.02 * ((k * 7) % 5)]);
  const ring = Array.from({ length: 48 }, (_, k) => (Math.PI * k) / 24).map((a) => [2 * Math.cos(a), Math.sin(a), 0.4 * Math.sin(2 * a) + 0.02 * Math.cos(11 * a)]);
  const rows = (points, between) => points.map((point) => point.join(between)).join('\n') + '\n';
  writeFileSync(join(session.folder, 'wave.csv'), `x,y\n${rows(wave, ',')}`);
  writeFileSync(join(session.folder, 'wave.dat'), `Wave\n${rows(wave, ' ')}`);
  writeFileSync(join(session.folder, 'ring.xyz'), rows(ring, ' '));
  writeFileSync(join(session.folder, 'ring.obj'), `${ring.map((point) => `v ${point.join(' ')}\n`).join('')}l ${ring.map((_, k) => k + 1).join(' ')} 1\n`);
});

async function opened(name) {
  await open(`?file=files/${name}`, { wait: false });
  await page.locator('#name', { hasText: name }).waitFor();
  await settled(page);
  await freeForm(page);
}

// The pointer away from the view, so that the footer names nothing that was under it before.
async function leave() {
  await page.mouse.move(3, 3);
  await page.waitForFunction(() => document.getElementById('node').textContent === '');
}

// What the program makes of the file and the constraints that the editor has saved.
function faired(input, rules, ...options) {
  const [file, out] = ['rules.json', `fair-${input}`].map((name) => join(session.folder, name));
  writeFileSync(file, rules);
  native('curve', join(session.folder, input), '-o', out, '--constraints', file, '--quiet', ...options);
  return placesOf(out);
}

test('a plane curve is seen from above, dragged in its plane, and saved as the native program fairs it', async () => {
  await opened('wave.csv');
  assert.match(await page.locator('#size').textContent(), /61 nodes, open curve/);
  const untouched = placesOf((await saved(page)).path);
  const free = await find(page, /free/, [0.35, 0.02], [0.35, 0.98]);
  await page.mouse.click(free.x, free.y);
  await page.keyboard.press('f');
  await settled(page);
  const still = await page.locator('#plot path.second').getAttribute('d');
  await drag(page, free, 30, -90, async () => {
    await follows(page);
    await page.waitForFunction((d) => document.querySelector('#plot path.second').getAttribute('d') !== d, still);
  });
  const rules = await rulesOf(page);
  const place = JSON.parse(rules).rules.at(-1).position[0];
  assert.equal(place[2], 0, 'it stays in the plane of the file');

  const { name, path } = await saved(page);
  assert.equal(name, 'wave-fair.csv');
  assert.match(readFileSync(path, 'utf8'), /^x,y\n/);
  const ours = placesOf(path);
  assert.ok(greatestDistance(ours, faired('wave.csv', rules)) < 1e-4);
  assert.deepEqual(ours[free.node], place);
  assert.ok(greatestDistance(ours, untouched) > 0.3);

  await page.keyboard.press('z');
  await settled(page);
  await page.keyboard.press('z');
  await settled(page);
  assert.ok(greatestDistance(placesOf((await saved(page)).path), untouched) < 1e-12);
});

test('every format of curves is read and written; a closed one is held where nodes are fixed', async () => {
  await opened('wave.dat');
  const wave = placesOf((await saved(page)).path);
  for (const format of ['csv', 'obj', 'xyz']) assert.deepEqual(placesOf((await saved(page, format)).path), wave);
  assert.match(readFileSync((await saved(page, 'svg')).path, 'utf8'), /<svg/);
  assert.ok(greatestDistance(wave, faired('wave.dat', await rulesOf(page))) < 1e-4);
  await page.goto(`${session.address}?file=files/ring.xyz`);
  await page.locator('#name', { hasText: 'ring.xyz' }).waitFor();
  assert.match(await page.locator('#size').textContent(), /48 nodes, open curve/);

  await page.goto(`${session.address}?file=files/ring.obj`);
  await page.locator('#size', { hasText: '48 nodes, closed curve' }).waitFor();
  assert.ok(await page.getByRole('button', { name: 'Free form' }).isDisabled(), 'nothing holds it');
  for (const share of [0.25, 0.4, 0.52]) {
    await leave();
    const { x, y } = await find(page, /free/, [share, 0.1], [share + 0.06, 0.9]);
    await page.keyboard.down('Shift');
    await page.mouse.click(x, y);
    await page.keyboard.up('Shift');
  }
  assert.equal(await page.locator('#picked').textContent(), '3 nodes');
  await page.keyboard.press('f');
  await settled(page);
  await page.keyboard.press('n');
  await settled(page);
  await freeForm(page);
  const rules = await rulesOf(page);
  assert.equal(JSON.parse(rules).rules.at(-1).tangent, 'fixed');
  const { path } = await saved(page);
  assert.match(path && readFileSync(path, 'utf8'), /\nl /);
  assert.ok(greatestDistance(placesOf(path), faired('ring.obj', rules)) < 1e-4);
});

test('the comb and the plot follow; both can be put away', async () => {
  await opened('wave.csv');
  const picture = async () => (await page.locator('#canvas').screenshot()).toString('base64');
  const plot = page.locator('#plot svg');
  assert.match(await plot.getAttribute('aria-label'), /curvature, 1\/unit.* against arc length, units of the input; curvature is positive to the left, input and shown/);
  const low = await page.locator('#canvas').boundingBox();
  await page.mouse.move(3, 3);
  const withComb = await picture();
  await page.keyboard.press('c');
  assert.notEqual(await picture(), withComb);
  assert.equal(await page.getByLabel('Comb').inputValue(), '0');
  await page.getByLabel('Comb').fill('2');
  assert.notEqual(await picture(), withComb);

  const before = await page.locator('#plot path.second').getAttribute('d');
  // From the plot's ticks: what it shows of the arc length.
  const shown = async () => {
    const numbers = (await page.locator('#plot text[text-anchor=middle]').allTextContents()).map(Number).filter(Number.isFinite);
    return [Math.min(...numbers), Math.max(...numbers)];
  };
  const other = (was) => page.waitForFunction((d) => document.querySelector('#plot path.second').getAttribute('d') !== d, was);
  const line = () => page.locator('#plot path.second').getAttribute('d');
  const whole = await shown();
  const box = await page.locator('#plot').boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.wheel(0, -800);
  await other(before);
  const part = await shown();
  assert.ok(part[0] > whole[0] && part[1] < whole[1], `${whole}, then ${part}`);
  const zoomed = await line();
  await page.mouse.down();
  await page.mouse.move(x - 200, y, { steps: 4 });
  await page.mouse.up();
  await other(zoomed);
  const moved = await shown();
  assert.ok(moved[0] > part[0], `${part}, then ${moved}`);
  const out = page.getByRole('button', { name: 'Zoom out along the curve' });
  for (let k = 0; k < 6; ++k) if (await out.isEnabled()) await out.click();
  assert.ok(await out.isDisabled());
  await page.waitForFunction((d) => document.querySelector('#plot path.second').getAttribute('d') === d, before);
  await page.getByRole('button', { name: 'Tangents fixed' }).click();
  await settled(page);
  await other(before);

  await page.getByRole('button', { name: 'Fold the plot away' }).click();
  assert.ok(await page.locator('#dock').isHidden());
  assert.ok((await page.locator('#canvas').boundingBox()).height > low.height + 100);
  await page.keyboard.press('p');
  await plot.waitFor();
});

async function drawn(points, end) {
  await page.getByRole('button', { name: 'New curve' }).click();
  const box = await page.locator('#canvas').boundingBox();
  for (const [x, y] of points) await page.mouse.click(box.x + box.width * x, box.y + box.height * y);
  await end(box);
  await page.locator('#name', { hasText: 'curve.csv' }).waitFor();
  await settled(page);
}

// The places that a constraints file holds by their own numbers, and what the program makes of a curve through them. more: other rules.
function fairedThrough(rules, nodes, more, ...options) {
  const { position } = JSON.parse(rules).rules.find((rule) => Array.isArray(rule.position));
  writeFileSync(join(session.folder, 'drawn.csv'), `x,y\n${position.map(([x, y]) => `${x},${y}`).join('\n')}\n`);
  return faired('drawn.csv', JSON.stringify({ rules: [{ nodes: 'all', position: 'fixed' }, ...more] }), '--resample', String(nodes), ...options);
}

test('a curve is drawn by clicks, ended by Enter, pulled, closed and saved, as the native program makes it', async () => {
  await opened('wave.csv');
  await drawn([[0.15, 0.6], [0.3, 0.3], [0.45, 0.9], [0.45, 0.65], [0.6, 0.4]], async () => {
    for (let k = 0; k < 3; ++k) await page.keyboard.press('Backspace');
    const box = await page.locator('#canvas').boundingBox();
    for (const [x, y] of [[0.45, 0.65], [0.6, 0.4]]) await page.mouse.click(box.x + box.width * x, box.y + box.height * y);
    await page.keyboard.press('Enter');
  });
  assert.match(await page.locator('#size').textContent(), /61 nodes, open curve/);
  const rules = await rulesOf(page);
  assert.deepEqual(JSON.parse(rules).rules.at(-1).position.map(([, , z]) => z), [0, 0, 0, 0]);
  assert.ok(greatestDistance(placesOf((await saved(page, 'csv')).path), fairedThrough(rules, 61, [])) < 1e-4);

  await leave();
  const held = await find(page, /position fixed/, [0.3, 0.3], [0.31, 0.3]);  // where it was drawn
  await drag(page, held, 10, 40);
  const pulled = await rulesOf(page);
  assert.notEqual(pulled, rules);

  await page.getByRole('button', { name: 'Closed' }).click();
  await page.locator('#size', { hasText: '80 nodes, closed curve' }).waitFor();
  await settled(page);
  assert.deepEqual(JSON.parse(await rulesOf(page)).rules.at(-1).position, JSON.parse(pulled).rules.at(-1).position);
  const ours = placesOf((await saved(page, 'xyz')).path).slice(0, 80);  // the first once more at the end
  assert.ok(greatestDistance(ours, fairedThrough(pulled, 80, [], '--closed').slice(0, 80)) < 1e-4);

  await page.getByLabel('Nodes a span').fill('10');
  await page.keyboard.press('Tab');
  await page.locator('#size', { hasText: '40 nodes, closed curve' }).waitFor();
  await settled(page);
});

test('the curve through the clicked places and the pointer is seen while it is drawn', async () => {
  await open('', { deviceScaleFactor: 1 });
  await page.getByRole('button', { name: 'New curve' }).click();
  const box = await page.locator('#canvas').boundingBox();
  const clicks = [[0.1, 0.6], [0.25, 0.3], [0.35, 0.7], [0.55, 0.5]].map(([x, y]) => [box.x + box.width * x, box.y + box.height * y]);
  for (const [x, y] of clicks.slice(0, 3)) await page.mouse.click(x, y);
  await page.mouse.move(...clicks[3]);
  const before = await picture(page);
  await page.mouse.click(...clicks[3]);
  await page.keyboard.press('Enter');
  await page.locator('#size', { hasText: '61 nodes, open curve' }).waitFor();
  await settled(page);
  const places = placesOf((await saved(page, 'csv')).path);
  // In the plane from above: the first and the third click say how places come to the picture.
  const { nodes } = JSON.parse(await rulesOf(page)).rules.find((rule) => Array.isArray(rule.position));
  const scale = (clicks[2][0] - clicks[0][0]) / (places[nodes[2]][0] - places[0][0]);
  const pixels = places.map(([x, y]) => [clicks[0][0] - box.x + scale * (x - places[0][0]), clicks[0][1] - box.y - scale * (y - places[0][1])]);
  assert.ok(Math.hypot(pixels[60][0] + box.x - clicks[3][0], pixels[60][1] + box.y - clicks[3][1]) < 2);
  const between = pixels.filter((_, k) => nodes.every((node) => Math.abs(node - k) > 3));
  const dark = await page.evaluate(async ([picture, where]) => {
    const image = Object.assign(new Image(), { src: `data:image/png;base64,${picture}` });
    await image.decode();
    const context = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height }).getContext('2d');
    context.drawImage(image, 0, 0);
    return where.map(([x, y]) => context.getImageData(Math.round(x) - 1, Math.round(y) - 1, 3, 3).data.some((part, k) => k % 4 === 0 && part < 110));
  }, [before, between]);
  assert.ok(dark.every(Boolean), `${dark}`);
  const chords = between.map(([x, y]) => Math.min(...[0, 1, 2].map((k) => {
    const [[ax, ay], [bx, by]] = [pixels[nodes[k]], pixels[nodes[k + 1]]];
    return Math.abs((x - ax) * (by - ay) - (y - ay) * (bx - ax)) / Math.hypot(bx - ax, by - ay);
  })));
  assert.ok(Math.max(...chords) > 15, 'it is no polygon');
});

test('a drawn curve that is closed, or gets other nodes, keeps the points that it is drawn towards', async () => {
  await open();
  await drawn([[0.2, 0.6], [0.4, 0.5], [0.6, 0.6]], () => page.keyboard.press('Enter'));
  const [[x, y]] = placesOf((await saved(page, 'xyz')).path);
  await drop(page, 'near.xyz', `${x} ${y} 0\n${x + 1} ${y + 1} 0\n`, true);
  const figures = page.locator('#fit-figures');
  await figures.filter({ hasText: 'near.xyz: 2 points · at most' }).waitFor();
  await page.getByRole('button', { name: 'Closed' }).click();
  await page.locator('#size', { hasText: '60 nodes, closed curve' }).waitFor();
  await settled(page);
  await figures.filter({ hasText: 'near.xyz: 2 points · at most' }).waitFor();
});

test('the tangent at an end is given by numbers, tilted by its arrow, and free again', async () => {
  await open();
  await drawn([[0.2, 0.6], [0.4, 0.5], [0.6, 0.6]], () => page.keyboard.press('Enter'));
  const box = await page.locator('#canvas').boundingBox();
  const end = { x: box.x + 0.2 * box.width, y: box.y + 0.6 * box.height };
  await leave();
  await find(page, /Node 0 /, [0.19, 0.6], [0.21, 0.6]);
  await page.mouse.click(end.x, end.y);
  await page.locator('#picked', { hasText: /^Node 0$/ }).waitFor();
  for (const [part, number] of [['x', '0'], ['y', '1'], ['z', '0']]) await page.getByLabel(`Tangent ${part}`).fill(number);
  await page.keyboard.press('Enter');
  await page.getByRole('button', { name: 'Undo' }).and(page.locator('[title*="Tilt tangent of node 0"]')).waitFor();
  await settled(page);
  const length = 0.09 * box.height;
  const atHead = page.locator('#node', { hasText: 'Tangent of node 0 · 0, 1, 0' });
  // As a hand is never quite still: an arrow may be drawn only after the pointer has come.
  for (let k = 0; k < 200 && !(await atHead.isVisible()); ++k) {
    await page.mouse.move(end.x + (k % 2), end.y - 0.87 * length);
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  }
  await drag(page, { x: end.x, y: end.y - 0.87 * length }, length, 0, () => follows(page));
  const rules = await rulesOf(page);
  const [tangent] = JSON.parse(rules).rules.find((rule) => Array.isArray(rule.tangent)).tangent;
  for (const part of tangent.slice(0, 2)) assert.ok(Math.abs(part - Math.SQRT1_2) < 0.02, `${tangent}`);
  assert.equal(tangent[2], 0);
  const ours = placesOf((await saved(page, 'csv')).path);
  assert.ok(greatestDistance(ours, fairedThrough(rules, 41, [{ nodes: [0], tangent }])) < 1e-4);

  await page.mouse.click(end.x, end.y);
  await page.keyboard.press('Shift+N');
  await settled(page);
  assert.equal(JSON.parse(await rulesOf(page)).rules.at(-1).tangent, 'free');
  assert.ok(greatestDistance(placesOf((await saved(page, 'csv')).path), ours) > 0.01);
});

test('a click on the first node closes, a double click ends, Escape gives up', async () => {
  await open();
  await drawn([[0.2, 0.3], [0.5, 0.25], [0.4, 0.7], [0.2, 0.3]], async () => {});
  assert.match(await page.locator('#size').textContent(), /60 nodes, closed curve/);
  await drawn([[0.2, 0.3], [0.5, 0.25]], async (box) => page.mouse.dblclick(box.x + 0.4 * box.width, box.y + 0.7 * box.height));
  assert.match(await page.locator('#size').textContent(), /41 nodes, open curve/);

  await page.keyboard.press('d');
  assert.equal(await page.getByRole('button', { name: 'Draw a curve' }).getAttribute('aria-pressed'), 'true');
  const box = await page.locator('#canvas').boundingBox();
  await page.mouse.click(box.x + 0.3 * box.width, box.y + 0.3 * box.height);
  await page.keyboard.press('Escape');
  assert.equal(await page.getByRole('button', { name: 'Draw a curve' }).getAttribute('aria-pressed'), 'false');
  assert.match(await page.locator('#size').textContent(), /41 nodes, open curve/);
});

test('loops that nothing holds are faired between their corners, or as many nodes as are said', async () => {
  session.generated('plate.obj', 'saddle', '--columns', '12', '--rows', '12', '--noise', '0.02');
  await opened('plate.obj');
  const first = () => page.getByRole('button', { name: 'Fair its loops first' });
  await first().click();
  await settled(page);
  assert.ok(await page.getByRole('alert').isHidden());
  assert.match(await page.getByRole('button', { name: 'Undo' }).getAttribute('title'), /Fair boundary loops, 4 nodes held/);
  assert.deepEqual(JSON.parse(await rulesOf(page)).rules.find(({ position }) => position === 'fixed').nodes, [0, 12, 156, 168]);

  session.generated('ring.ply', 'annulus', '--nodes', '400');
  await opened('ring.ply');
  await first().click();
  await settled(page);
  const undo = page.getByRole('button', { name: 'Undo' });
  assert.match(await undo.getAttribute('title'), /Fair boundary loops, 16 nodes held/);
  await page.getByLabel('Nodes held in a loop').fill('5');
  await page.keyboard.press('Enter');
  await undo.and(page.locator('[title*="10 nodes held"]')).waitFor();
  await settled(page);
  assert.ok(await page.getByRole('alert').isHidden());
  await first().click();
  await settled(page);
  assert.deepEqual(JSON.parse(await rulesOf(page)).rules, [{ nodes: 'boundary', position: 'fixed' }], 'they are free again');
  session.generated('torus.ply', 'torus', '--columns', '20', '--rows', '12');
  await opened('torus.ply');
  assert.ok(await first().isDisabled());
  assert.match(await first().getAttribute('title'), /it has no boundary/);
});

test('boundary loops are faired first, then the surface, as --fair-boundary does; what holds them is dragged', async () => {
  const input = session.generated('patch.obj', 'saddle', '--columns', '12', '--rows', '12', '--noise', '0.02');
  await opened('patch.obj');
  // Of every four nodes along the sides three.
  const nodes = Array.from({ length: 169 }, (_, node) => node).filter((node) => {
    const [row, column] = [Math.floor(node / 13), node % 13];
    return (row % 12 === 0 || column % 12 === 0) && (row + column) % 4 !== 2;
  });
  await choose(page, 'Load…', { name: 'held.json', text: JSON.stringify({ rules: [{ nodes, position: 'fixed' }] }) });
  await page.locator('[title^="Undo: Load constraints"]').waitFor();
  await settled(page);
  const drawnIn = placesOf((await saved(page, 'obj')).path);
  const first = page.getByRole('button', { name: 'Fair its loops first' });
  await first.click();
  await settled(page);
  assert.equal(await first.getAttribute('aria-pressed'), 'true');
  await leave();
  let held;
  for (let y = 0.4; !held; y += 0.06) held = await find(page, /position fixed/, [0.06, y], [0.5, y]).catch(() => null);
  await drag(page, held, -10, -40);

  const rules = await rulesOf(page);
  assert.ok(nodes.includes(JSON.parse(rules).rules.at(-1).nodes[0]));
  const [file, out] = ['rules.json', 'fair-patch.obj'].map((name) => join(session.folder, name));
  writeFileSync(file, rules);
  native('fair', input, '-o', out, '--constraints', file, '--fair-boundary', '--quiet');
  const vertices = (path) => placesOf(path).slice(0, 169);
  const ours = vertices((await saved(page, 'obj')).path);
  assert.ok(greatestDistance(ours, vertices(out)) < 2e-4, `${greatestDistance(ours, vertices(out))}`);
  assert.ok(greatestDistance(ours, drawnIn.slice(0, 169)) > 0.01);
  await page.keyboard.press('k');
  assert.equal(await first.getAttribute('aria-pressed'), 'false');
  assert.equal(await page.getByRole('button', { name: 'Positions fixed' }).getAttribute('aria-pressed'), 'true');
  await settled(page);
});

for (const [label, file, size] of [
  ['Aerofoil NACA 2412', 'naca-2412.dat', '61 nodes, open curve'], ['Noisy wave', 'wave.csv', '121 nodes, open curve'], ['Noisy trefoil knot', 'trefoil.obj', '144 nodes, closed curve'],
]) {
  test(`the example ${label} comes with what holds it`, async () => {
    await open();
    await page.getByLabel('Example').selectOption({ label });
    await page.locator('#size', { hasText: size }).waitFor();
    await settled(page);
    assert.ok(await page.getByRole('button', { name: 'Undo' }).isDisabled());
    const [input, rules] = [file, file.replace(/\..*/, '.json')].map((name) => join(root, 'examples', name));
    assert.deepEqual(JSON.parse(await rulesOf(page)), JSON.parse(readFileSync(rules, 'utf8')));
    const out = join(session.folder, `fair-${file}`);
    native('curve', input, '-o', out, '--constraints', rules, '--quiet');
    assert.ok(greatestDistance(placesOf((await saved(page)).path), placesOf(out)) < 3e-4);
  });
}
