// Large meshes, and solutions that are given up: with memory that page and worker share, and without.

import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { downloaded, expectSameAsNative, find, freeForm, greatestDistance, native, placesOf, Session, settled, solving } from './support.mjs';

for (const shared of [true, false]) {
  test(`a mesh of 200,000 nodes opens, its solution is given up, and nodes are picked; memory is ${shared ? '' : 'not '}shared`, async () => {
    const session = await Session.start({ shared });
    try {
      session.generated('large.ply', 'annulus', '--nodes', '200000', '--noise', '0.001');
      const { page, faults } = await session.open('?file=files/large.ply');
      assert.equal(await page.evaluate(() => crossOriginIsolated), shared);
      await page.locator('#size', { hasText: '200,000 nodes' }).waitFor();
      await solving(page);
      await page.getByRole('button', { name: 'Cancel' }).click();
      await settled(page, 'cancelled');
      const { x, y, node } = await find(page, /Node \d+/, [0.3, 0.6], [0.4, 0.6]);
      await page.mouse.click(x, y);
      assert.equal(await page.locator('#picked').textContent(), `Node ${node}`);
      assert.deepEqual(faults, []);
    } finally {
      await session.stop();
    }
  });
}

// Of so many nodes that a busy page has time for two clicks before the solution ends.
for (const shared of [true, false]) {
  test(`a file that waits for its shape is given up or written, after a solution was given up; memory is ${shared ? '' : 'not '}shared`, async () => {
    const session = await Session.start({ shared });
    try {
      const input = session.generated('patch.obj', 'annulus', '--nodes', '200000', '--noise', '0.01');
      const { page, faults } = await session.open('?file=files/patch.obj');
      const [cancel, save, alert] = [page.getByRole('button', { name: 'Cancel' }), page.getByRole('button', { name: 'Save as' }), page.getByRole('alert')];
      let files = 0;
      page.on('download', () => ++files);
      for (const end of [() => cancel.click(), () => page.keyboard.press('Escape')]) {
        await solving(page);
        await save.click();
        await end();
        await alert.filter({ hasText: 'patch-fair.obj is not saved, as its solution was cancelled' }).waitFor();
        await page.getByRole('button', { name: 'Dismiss' }).click();
        await page.getByRole('button', { name: 'Not this' }).click();
      }
      assert.equal(files, 0);

      // What is changed meanwhile is in the file.
      await solving(page);
      const { path } = await downloaded(page, async () => {
        await save.click();
        for (let k = 0; k < 4; ++k) await page.keyboard.press('Shift+B');
      });
      const fair = join(session.folder, 'fair.obj');
      native('fair', input, '-o', fair, '--quiet');
      const [ours, theirs] = [path, fair].map(placesOf);
      assert.ok(greatestDistance(ours, theirs) < 6e-5, `${greatestDistance(ours, theirs)}`);  // six times the tolerance of 1e-5, on a size of some 2.4
      await settled(page);
      assert.ok(await alert.isHidden());
      assert.deepEqual(faults, []);
    } finally {
      await session.stop();
    }
  });
}

test('a long solution says how long it lasts; given up without shared memory, it is no step, and goes on where asked', async () => {
  const session = await Session.start({ shared: false });
  try {
    const input = session.generated('patch.obj', 'annulus', '--nodes', '100000', '--noise', '0.01');
    const { page, faults } = await session.open('?file=files/patch.obj');
    // Which states its bar has had: whether it told how far it is.
    await page.evaluate(() => {
      const bar = document.querySelector('#progress progress');
      window.told = [];
      new MutationObserver(() => { if (bar.checkVisibility()) window.told.push(bar.position >= 0); }).observe(document.body, { subtree: true, childList: true, attributes: true });
    });
    await solving(page);
    await page.locator('#status', { hasText: /^Solving … \d+ s$/ }).waitFor();
    assert.equal(await page.evaluate(() => window.told[0]), false);
    await page.getByRole('button', { name: 'Cancel' }).click();
    await settled(page, 'cancelled');
    assert.ok(await page.getByRole('button', { name: 'Apply', exact: true }).isDisabled());
    await page.getByRole('button', { name: 'Go on' }).click();
    await page.locator('#start-says', { hasText: /^Moves [\d,]+ nodes, at most by/ }).waitFor();
    await expectSameAsNative(session, page, input);
    assert.deepEqual(faults, []);
  } finally {
    await session.stop();
  }
});

test('a large mesh is drawn with fewer triangles while it is dragged; pictures do not wait for the library, and what comes out is solved', async () => {
  const session = await Session.start();
  try {
    const input = session.generated('annulus.obj', 'annulus', '--nodes', '50000');
    const { page, faults } = await session.open('?file=files/annulus.obj');
    await page.locator('#size', { hasText: '50,000 nodes' }).waitFor();
    await settled(page);
    await freeForm(page);
    // Where the library is soon quick enough, all is drawn again before anybody asks: what has been seen counts.
    await page.evaluate(() => {
      Object.assign(window, { drawn: 0, few: false, counted: false });
      const draw = WebGL2RenderingContext.prototype.drawElements;
      WebGL2RenderingContext.prototype.drawElements = function (mode, count, ...rest) {
        if (mode === this.TRIANGLES && count > 3000) window.drawn = count / 3;
        window.few ||= window.drawn > 5000 && window.drawn < 9000;
        return draw.call(this, mode, count, ...rest);
      };
      const status = document.getElementById('status');
      new MutationObserver(() => { window.counted ||= status.title.includes('frames/s, '); }).observe(status, { attributes: true });
    });
    const { x, y } = await find(page, /position fixed/, [0.4, 0.4], [0.4, 0.7]);
    await page.mouse.click(x, y);
    await page.keyboard.press('l');
    await page.waitForFunction(() => window.drawn > 95_000);
    assert.ok(await page.evaluate(() => !window.few && !window.counted));
    await page.mouse.down();
    for (let step = 1; step <= 10; ++step) await page.mouse.move(x, y - 3 * step);
    const seen = () => page.evaluate(() => window.few && window.counted);
    for (let step = 0; step < 300 && !(await seen()); ++step) {
      await page.mouse.move(x, y - 30 - (step % 3));
      await page.waitForTimeout(100);
    }
    assert.ok(await seen());
    await page.mouse.up();
    await settled(page);
    await page.waitForFunction(() => window.drawn > 95_000);
    await expectSameAsNative(session, page, input);
    assert.deepEqual(faults, []);
  } finally {
    await session.stop();
  }
});
