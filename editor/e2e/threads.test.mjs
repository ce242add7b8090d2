// Threads, where page and worker may share memory, and one thread where they may not or where threads cannot be loaded.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { expectSameAsNative, freeForm, Session, settled } from './support.mjs';

for (const [what, options, many] of [
  ['a page that may share memory solves with a thread for each core', {}, true],
  ['a page that may not solves with one', { shared: false }, false],
  ['where threads cannot be loaded there is one', { without: 'vspring_core_threads.worker.js' }, false],
]) {
  test(`${what}, and the result is that of the program`, async () => {
    const session = await Session.start(options);
    try {
      const input = session.generated('part.obj', 'annulus', '--nodes', '6000', '--noise', '0.01');
      const { page, faults } = await session.open('?file=files/part.obj');
      await settled(page);
      await freeForm(page);
      const cores = Math.min(8, await page.evaluate(() => navigator.hardwareConcurrency));
      const status = await page.locator('#status').getAttribute('title');
      assert.equal(Number(status.match(/ on (\d+) threads/)?.[1] ?? 1), many ? cores : 1, status);
      await expectSameAsNative(session, page, input);
      assert.deepEqual(faults.filter((fault) => !options.without || !/worker/.test(fault)), []);
    } finally {
      await session.stop();
    }
  });
}
