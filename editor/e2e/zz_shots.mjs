import { Session, settled } from './support.mjs';
const session = await Session.start();
try {
  for (const [w, h] of [[390, 844], [768, 1024], [1024, 768], [1440, 900], [2560, 1440]]) {
    const { page } = await session.open('?file=examples/annulus.obj', { viewport: { width: w, height: h }, colorScheme: w % 3 ? 'light' : 'dark' });
    await settled(page);
    await page.waitForTimeout(500);
    await page.screenshot({ path: `/tmp/ed/w${w}.png` });
    if (w < 800) {
      await page.getByLabel('Example').selectOption({ label: 'Aerofoil NACA 2412' });
      await page.locator('#size', { hasText: 'curve' }).waitFor();
      await settled(page);
      await page.waitForTimeout(400);
      await page.screenshot({ path: `/tmp/ed/c${w}.png` });
    }
    await page.close();
  }
} finally { await session.stop(); }
