// The pictures of docs/editor.md: node e2e/pictures.mjs.

import { join } from 'node:path';
import { find, root, Session, settled } from './support.mjs';

const session = await Session.start({ scale: 1 });
try {
  for (const [name, colorScheme, example, key] of [['light', 'light', 'Pipe blend', '4'], ['dark', 'dark', 'Annulus', '3']]) {
    const { page } = await session.open('', { colorScheme, viewport: { width: 1100, height: 680 } });
    await settled(page);
    await page.getByLabel('Example').selectOption({ label: example });
    await page.getByRole('button', { name: 'Undo' }).and(page.locator(':disabled')).waitFor();
    await settled(page);
    if (name === 'dark') {
      await page.getByRole('button', { name: 'Normals fixed' }).click();
      await settled(page);
      const { x, y } = await find(page, /position fixed/, [0.35, 0.4], [0.35, 0.7]);
      await page.mouse.click(x, y);
      await page.keyboard.press('l');
      await page.mouse.down();
      for (let k = 1; k <= 12; ++k) await page.mouse.move(x - 3 * k, y - 4 * k);
      await page.mouse.up();
      await settled(page);
    }
    await page.keyboard.press(key);
    await page.mouse.move(700, 5);
    await page.evaluate(() => document.activeElement.blur());
    await page.waitForTimeout(1500);
    await page.screenshot({ path: join(root, `docs/pictures/editor-${name}.png`) });
    await page.close();
  }
} finally {
  await session.stop();
}
