// The page at widths from a phone's to a large screen's: nothing is cut off, nothing lies on something else, and what matters first is seen.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { find, open, page, settled, useSession } from './support.mjs';

useSession();

const sizes = [[390, 844], [768, 1024], [1024, 768], [1440, 900], [2560, 1440]];

// Controls that are seen and yet reach beyond the page, are wrapped out of their row, or have words that do not fit.
function faultsOf() {
  const faults = [];
  if (document.documentElement.scrollWidth > innerWidth) faults.push(`the page is ${document.documentElement.scrollWidth} wide`);
  if (document.documentElement.scrollHeight > innerHeight) faults.push(`the page is ${document.documentElement.scrollHeight} high`);
  const boxes = [];
  for (const one of document.querySelectorAll('button, input, select, output, footer span, h2')) {
    if (!one.checkVisibility() || one.closest('dialog')) continue;
    const { left, right, top, bottom } = one.getBoundingClientRect();
    const name = one.textContent.trim() || one.id || one.ariaLabel;
    if (left < -1 || right > innerWidth + 1) faults.push(`${name} reaches from ${left} to ${right}`);
    if (one.matches('button') && (one.scrollWidth > one.clientWidth + 1)) faults.push(`${name} is cut off`);
    if (one.matches('header button, #left button, #below input') && one.tagName !== 'H2') boxes.push({ name, left, right, top, bottom });
  }
  const panel = document.querySelector('aside').getBoundingClientRect();
  for (const box of boxes) {
    if (Math.min(box.right, panel.right) - Math.max(box.left, panel.left) > 1 && Math.min(box.bottom, panel.bottom) - Math.max(box.top, panel.top) > 1) faults.push(`${box.name} lies on the panel`);
  }
  boxes.forEach((a, k) => boxes.slice(k + 1).forEach((b) => {
    if (Math.min(a.right, b.right) - Math.max(a.left, b.left) > 2 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 2) faults.push(`${a.name} lies on ${b.name}`);
  }));
  return faults;
}

for (const [width, height] of sizes) {
  test(`${width} by ${height}: a file of one's own, a surface and a curve`, async () => {
    await open('?file=examples/annulus.obj', { untouched: true, viewport: { width, height } });
    assert.deepEqual(await page.evaluate(faultsOf), []);
    const seen = (locator) => locator.evaluate((one) => {
      const { top, bottom, height } = one.getBoundingClientRect();
      return height > 0 && top >= 0 && bottom <= innerHeight;
    });
    assert.ok(await seen(page.getByRole('button', { name: 'Smooth it' })), 'what can be done is seen at once');
    const canvas = await page.locator('#canvas').boundingBox();
    assert.ok(canvas.height > 0.4 * height && canvas.width > 0.9 * width, `the shape has ${canvas.width} by ${canvas.height}`);

    if (width <= 768) {
      const long = page.locator('#name');
      assert.ok(await long.evaluate((one) => one.scrollWidth <= one.clientWidth), 'the file is named');
      await page.getByRole('button', { name: 'Smooth it' }).click();
      await page.locator('#start-says', { hasText: 'Moves' }).waitFor();
      await page.getByRole('button', { name: 'Mean' }).click();
      await page.locator('#legend').waitFor();
      const [apply, panel, legend] = await Promise.all(['#start-end', 'aside', '#legend'].map((one) => page.locator(one).boundingBox()));
      assert.ok(apply.y + apply.height <= panel.y + panel.height + 1, 'Apply is above the fold');
      assert.ok(legend.width * legend.height < 0.15 * canvas.width * (panel.y - canvas.y), `the legend covers ${legend.width} by ${legend.height}`);
      await page.getByRole('button', { name: 'Not this' }).click();
    }

    await page.getByLabel('Example').selectOption({ label: 'Aerofoil NACA 2412' });
    await page.locator('#size', { hasText: 'curve' }).waitFor();
    await settled(page);
    assert.deepEqual(await page.evaluate(faultsOf), []);
    for (const name of ['Shaded', 'Wire', 'Zebra', 'Mean', 'Deviation']) assert.ok(await page.getByRole('button', { name, exact: true }).isHidden(), `${name} does nothing for curves`);

    await page.keyboard.press('?');
    const dialog = page.getByRole('dialog', { name: 'Keyboard shortcuts' });
    await dialog.waitFor();
    assert.equal(await dialog.evaluate((one) => one.scrollTop), 0, 'the list is seen from its beginning');
    await dialog.getByRole('button', { name: 'Close' }).click();
  });
}

test('numbers are seen whole, and warnings at the top of the panel', async () => {
  await open();
  const { x, y } = await find(page, /position fixed/, [0.02, 0.55], [0.5, 0.55]);
  await page.mouse.click(x, y);
  await page.getByLabel('Position x').waitFor();
  const [numbers, panel] = await Promise.all(['#numbers', 'aside'].map((one) => page.locator(one).boundingBox()));
  assert.ok(numbers.y + numbers.height <= panel.y + panel.height, 'they are found without scrolling');
  assert.equal((await page.locator('#numbers form').first().textContent()).replace(/\s/g, ''), 'PositionXYZApply', 'what each is, is said beside it');
  await page.getByLabel('Position y').fill('five');
  await page.getByLabel('Position y').press('Enter');
  await page.getByRole('alert').filter({ hasText: 'Give numbers' }).waitFor();
  await page.getByLabel('Position y').fill('-0.541623');
  for (const axis of 'xyz') assert.ok(await page.getByLabel(`Position ${axis}`).evaluate((one) => one.scrollWidth <= one.clientWidth), axis);
  assert.equal(await page.locator('aside > section:not(#start)').first().getAttribute('id'), 'warnings');
});
