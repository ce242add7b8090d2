// The pictures of docs/editor.md: node e2e/pictures.mjs.

import { join } from 'node:path';
import { find, root, Session, settled } from './support.mjs';

const session = await Session.start();
try {
  for (const [colorScheme, example, key] of [['light', 'Pipe blend', '1'], ['dark', 'Annulus', '3']]) {
    const { page } = await session.open('', { colorScheme, viewport: { width: 1100, height: 680 } });
    await settled(page);
    await page.getByLabel('Example').selectOption({ label: example });
    await page.locator('#name', { hasText: example.split(' ')[0].toLowerCase() }).waitFor();
    await settled(page);
    await page.getByRole('button', { name: 'Normals fixed' }).click();
    await settled(page);
    if (example === 'Annulus') {
      const { x, y } = await find(page, /position fixed/, [0.35, 0.4], [0.35, 0.7]);
      await page.mouse.click(x, y);
      await page.keyboard.press('l');
      await page.mouse.down();
      for (let k = 1; k <= 12; ++k) await page.mouse.move(x - 3 * k, y - 4 * k);
      await page.mouse.up();
      await settled(page);
    }
    await page.keyboard.press(key);
    await page.evaluate(() => document.activeElement.blur());
    await page.mouse.move(700, 5);
    await page.waitForTimeout(1500);
    await page.screenshot({ path: join(root, `docs/pictures/editor-${colorScheme}.png`) });
    await page.close();
  }
} finally {
  await session.stop();
}
