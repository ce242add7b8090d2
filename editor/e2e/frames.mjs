// Frames a second while the inner rim of an annulus is dragged in a circle, one line for each size: node e2e/frames.mjs [nodes...].
// SPEED: of the pointer, in pixels a second.

import { find, freeForm, Session, settled } from './support.mjs';

const speed = Number(process.env.SPEED ?? 50);
const sizes = process.argv.slice(2).map(Number);
const session = await Session.start({ scale: 1 });
try {
  for (const size of sizes.length ? sizes : [2000, 15000]) {
    session.generated('annulus.obj', 'annulus', '--nodes', String(size));
    const begin = performance.now();
    const { page } = await session.open('?file=files/annulus.obj');
    await page.locator('#size', { hasText: 'nodes' }).waitFor();
    const picture = performance.now() - begin;
    await settled(page);
    await freeForm(page);
    const anew = await page.locator('#status').getAttribute('title');
    const { x, y } = await find(page, /position fixed/, [0.4, 0.4], [0.4, 0.7]);
    await page.mouse.click(x, y);
    await page.keyboard.press('l');
    await page.mouse.down();
    // A mouse tells its place every 8 ms, whether anyone looks or not.
    let moved = Promise.resolve();
    for (let time = 0, start = performance.now(); time < 5; time = (performance.now() - start) / 1000) {
      moved = page.mouse.move(x + (speed / 2) * Math.sin(2 * time), y + (speed / 2) * (Math.cos(2 * time) - 1));
      await new Promise((done) => setTimeout(done, 8));
    }
    await moved;
    const following = await page.locator('#status').getAttribute('title');
    await page.mouse.up();
    console.log(`${size} nodes: first picture ${Math.round(picture)} ms; anew: ${anew}; following: ${following}`);
    await page.close();
  }
} finally {
  await session.stop();
}
