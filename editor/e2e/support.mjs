// The editor in a real Chromium, served as anyone would serve it; and the native program beside it.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, beforeEach } from 'node:test';
import { chromium } from 'playwright-core';
import { serve } from '../serve.mjs';

export const root = new URL('../../', import.meta.url).pathname;
export const program = process.env.VSPRING ?? join(root, 'build/release/vspring');

export function native(...options) {
  return execFileSync(program, options, { encoding: 'utf8' });
}

// Software drawing, as where there is no graphics card, the same on every machine. The sandbox needs rights that containers lack; the pages are our own.
export const launch = {
  executablePath: process.env.CHROMIUM ?? '/usr/lib/chromium/chromium-headless-shell',
  args: ['--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader', '--disable-dev-shm-usage', '--process-per-site'],
};

export class Session {
  // shared: whether page and worker may share memory. without: a file of the editor that the server does not have. scale: pixels that
  // are drawn to one of the page, along each side; fewer cost less.
  static async start({ shared = true, without, scale = 0.5 } = {}) {
    const session = new Session();
    session.folder = mkdtempSync(join(tmpdir(), 'vspring-editor-'));
    session.server = await serve({ '/': join(root, 'build/editor'), '/files/': session.folder, ...(without && { [`/${without}`]: '/' }) }, 0, shared);
    session.address = `http://127.0.0.1:${session.server.address().port}/`;
    session.browser = await (process.env.VSPRING_BROWSER ? chromium.connect(process.env.VSPRING_BROWSER) : chromium.launch(launch));
    session.view = { viewport: { width: 1200, height: 760 }, deviceScaleFactor: scale };
    session.context = await session.browser.newContext(session.view);
    // While it is there, one process draws all pages of the session.
    const first = await session.context.newPage();
    await first.goto(`${session.address}style.css`);
    session.storage = await session.context.newCDPSession(first);
    return session;
  }

  async stop() {
    await this.browser.close();
    this.server.close();
    rmSync(this.folder, { recursive: true });
  }

  generated(name, ...options) {
    const path = join(this.folder, name);
    native('generate', ...options, '-o', path);
    return path;
  }

  // address: of the page, or what comes after the session's own. Nothing is stored by pages before. others: options of a browser that
  // shares nothing with other pages.
  async open(address = '', { viewport, colorScheme, ...others } = {}) {
    const whole = new URL(address, this.address);
    await this.storage.send('Storage.clearDataForOrigin', { origin: new URL(this.address).origin, storageTypes: 'all' });
    const page = await (Object.keys(others).length > 0 ? this.browser.newPage({ ...this.view, ...others }) : this.context.newPage());
    if (viewport) await page.setViewportSize(viewport);
    if (colorScheme) await page.emulateMedia({ colorScheme });
    page.setDefaultTimeout(180_000); // a test that fails waits in vain; a machine that is busy with other work must not fail one
    const faults = [];
    page.on('pageerror', (error) => faults.push(String(error)));
    page.on('console', (message) => { if (message.type() === 'error') faults.push(message.text()); });
    page.on('request', (request) => { if (!/^(blob|data):/.test(request.url()) && !request.url().startsWith(whole.origin)) faults.push(`asks for ${request.url()}`); });
    await page.goto(whole.href);
    return { page, faults };
  }
}

// What the tests of a file have: one session, and the page that a test has opened, with what went wrong in it.
export let session;
export let page;
export let faults;

// To be called once by a file of tests. A page is closed after its test, and nothing may have gone wrong.
export function useSession(prepare = () => {}, options = {}) {
  before(async () => {
    session = await Session.start(options);
    prepare();
  });
  after(() => session.stop());
  beforeEach(() => {
    page = null;
    faults = [];
  });
  afterEach(async () => {
    await page?.close();
    assert.deepEqual(faults, []);
  });
}

// address: as Session.open takes it. wait: until what it names is seen. untouched: a file stays as it is; else it is then faired as a free form.
export async function open(address, { wait = true, untouched = false, ...options } = {}) {
  await page?.close();
  ({ page, faults } = await session.open(address, options));
  if (!wait) return;
  await settled(page);
  if (!untouched) await freeForm(page);
}

// The same in a page that is open already.
export async function visit(page, address) {
  await page.goto(address);
  await settled(page);
  await freeForm(page);
}

// Where a file is as it came: the fairest shape through its boundary.
export async function freeForm(page) {
  const free = page.getByRole('button', { name: 'Free form' });
  const came = page.getByRole('heading', { name: 'It is as in the file' });
  if (!(await came.isVisible()) || (await free.isDisabled())) return;
  await free.click();
  await keep(page);
}

// A file that stays as it is, and what is then solved, from its first moment.
export async function solving(page) {
  await settled(page);
  // No large picture keeps the page from what is clicked next.
  await page.locator('#canvas[data-picture="fine"]').waitFor();
  // Looked for from before the click: on a busy machine it may be over when that has returned.
  const begun = page.getByRole('progressbar', { name: 'Solving' }).waitFor();
  await Promise.all([begun, page.getByRole('button', { name: 'Free form' }).click()]);
}

// What a way of the start shows is kept.
export async function keep(page) {
  await settled(page);
  await page.getByRole('button', { name: 'Apply', exact: true }).click();
  await page.locator('#start-end').waitFor({ state: 'hidden' });
}

export async function drop(page, name, text, alt = false) {
  await page.evaluate(([file, content, altKey]) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([content], file));
    document.body.dispatchEvent(new DragEvent('drop', { dataTransfer, altKey, bubbles: true, cancelable: true }));
  }, [name, text, alt]);
}

// file: a path, or a name and its text.
export async function choose(page, button, file) {
  const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.getByRole('button', { name: button }).click()]);
  await chooser.setFiles(typeof file === 'string' ? file : { name: file.name, mimeType: 'text/plain', buffer: Buffer.from(file.text) });
}

// Until nothing is being solved and the last outcome is that.
export async function settled(page, outcome = 'converged') {
  await page.locator(`#status[data-outcome="${outcome}"]`).waitFor();
}

// Until the shape follows the pointer.
export async function follows(page) {
  await page.locator('#status[title*="frames/s"]').waitFor();
}

// What the view shows at last: without a graphics card pictures are drawn more finely once all has been still.
export async function picture(page, clip) {
  await page.evaluate(async () => {
    for (let k = 0; k < 4; ++k) await new Promise((done) => requestAnimationFrame(done));
  });
  await page.locator('#canvas[data-picture="fine"]').waitFor();
  return (await (clip ? page.screenshot({ clip }) : page.locator('#canvas').screenshot())).toString('base64');
}

// From a place on the view, with the left button down. held: what happens before it is let go.
export async function drag(page, { x, y }, across, down, held = async () => {}) {
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 1; k <= 8; ++k) await page.mouse.move(x + (across * k) / 8, y + (down * k) / 8);
  await held();
  await page.mouse.up();
  await settled(page);
}

// Moves the pointer from place to place until the footer says what is under it. Returns where that is, and the node.
async function findAmong(page, pattern, places) {
  // The page moves it itself, which costs less than a pointer of the browser; that one only goes where something is found.
  const found = await page.evaluate(async ([ways, text]) => {
    const [canvas, node, sought] = [document.getElementById('canvas'), document.getElementById('node'), new RegExp(text)];
    for (const [k, [clientX, clientY]] of ways.entries()) {
      if (document.elementFromPoint(clientX, clientY) !== canvas) continue;
      canvas.dispatchEvent(new PointerEvent('pointermove', { clientX, clientY, pointerType: 'mouse', isPrimary: true, bubbles: true }));
      await new Promise((done) => requestAnimationFrame(done));
      if (sought.test(node.textContent)) return k;
    }
    return -1;
  }, [places, pattern.source]);
  if (found < 0) throw new Error(`nothing from ${places[0]} to ${places.at(-1)} is ${pattern}`);
  const [x, y] = places[found];
  await page.mouse.move(x, y);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const text = await page.locator('#node').textContent();
  assert.match(text, pattern);
  return { x, y, node: Number(text.match(/Node (\d+)/)?.[1]) };
}

// Across the view, from and to as shares of it.
export async function find(page, pattern, from, to) {
  const box = await page.locator('#canvas').boundingBox();
  const steps = 120;
  return findAmong(page, pattern, Array.from({ length: steps + 1 }, (_, k) => [0, 1].map((i) => [box.x, box.y][i] + [box.width, box.height][i] * (from[i] + ((to[i] - from[i]) * k) / steps))));
}

// Around a place, from there outwards.
export async function findAround(page, pattern, { x, y }, reach = 200) {
  const step = 16;
  const places = [];
  for (let far = 0; far <= reach; far += step) {
    for (let turn = 0; turn <= (2 * Math.PI * far) / step; ++turn) {
      const angle = (turn * step) / Math.max(far, 1);
      places.push([x + far * Math.cos(angle), y + far * Math.sin(angle)]);
    }
  }
  return findAmong(page, pattern, places);
}

const downloads = mkdtempSync(join(tmpdir(), 'vspring-downloads-'));
let files = 0;
process.on('exit', () => rmSync(downloads, { recursive: true }));

export async function downloaded(page, press) {
  const [download] = await Promise.all([page.waitForEvent('download'), press()]);
  const path = join(downloads, String(files++));
  await download.saveAs(path); // a browser that is shared may be elsewhere for all that Playwright knows, and then tells no path of its own
  return { name: download.suggestedFilename(), path };
}

export async function rulesOf(page) {
  const { path } = await downloaded(page, () => page.getByRole('button', { name: 'Save', exact: true }).click());
  return readFileSync(path, 'utf8');
}

// Places of a file with a table of numbers, or of OBJ.
export function placesOf(path) {
  return readFileSync(path, 'utf8').split('\n').map((line) => line.replace(/^v /, '').split(/[\s,]+/).filter(Boolean).map(Number))
    .filter((row) => row.length >= 2 && row.every(Number.isFinite)).map(([x, y, z = 0]) => [x, y, z]);
}

export function greatestDistance(a, b) {
  if (a.length !== b.length) throw new Error(`${a.length} nodes and ${b.length}`);
  return a.reduce((greatest, place, n) => Math.max(greatest, Math.hypot(...place.map((part, i) => part - b[n][i]))), 0);
}

// format: of the file, or the one that is chosen.
export async function saved(page, format) {
  if (format) await page.getByLabel('File format').selectOption(format);
  return downloaded(page, () => page.getByRole('button', { name: 'Save as' }).click());
}

// That what is saved is what the program makes of the same file and constraints. Of sizes of some 2.4, to six times the tolerance of 1e-5.
export async function expectSameAsNative(session, page, input) {
  const { path } = await saved(page);
  const [rules, fair] = [join(session.folder, 'rules.json'), join(session.folder, 'fair.obj')];
  writeFileSync(rules, await rulesOf(page));
  native('fair', input, '-o', fair, '--constraints', rules, '--quiet');
  const [ours, theirs] = [path, fair].map(placesOf);
  assert.ok(greatestDistance(ours, theirs) < 6e-5, `${greatestDistance(ours, theirs)}`);
}
