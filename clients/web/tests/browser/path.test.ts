// The tool path of a program: drawn, chosen from both sides, of another setup, with an alarm, long, hostile.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Page } from 'playwright-core';
import { assertNoComplaints, findBarriers, shopForTests } from './page';

const kSquare = 'O0100 (SQUARE)\nG21 G90 G94\nT1 M6\nG0 X0. Y0. Z5.\nG1 Z0. F100.\nG1 X100. F500.\nG1 Y100.\nG1 X0.\nG1 Y0.\nG0 Z5.\nM30\n';
const kHostile = '<img src=x onerror=alert`1`>';

const { shop, visit } = shopForTests(async (shop) => {
  await shop.startMachine('mill-1', { control: 'fanuc' });
  await shop.api('PUT', 'machines/mill-1/setup', '[[offset]]\nname = "G54"\nX = 500.0\n');
  await shop.push('O0100', kSquare, 'fanuc');
  await shop.push('O0200', `O0200 (${kHostile})\nG21 G90\nG1 X1. F100.\nG1 X2. ZZ5.\nM30\n`, 'fanuc');
  await shop.push('O0300', 'O0300\nG20 G93 G98\nG0 X2. Z0.\nG1 Z-1. F10.\nM30\n', 'centurion');
  const lines = Array.from({ length: 100_000 }, (_, i) => `G1 X${(i % 1000) / 10} Y${Math.floor(i / 1000)}.`);
  await shop.push('O0400', `O0400\nG21 G90 F500.\n${lines.join('\n')}\nM30\n`, 'fanuc');
});

const complete = (page: Page) => page.locator('[data-complete=true]').waitFor();
const current = (page: Page) => page.locator('.path-blocks [aria-current=step] .number');

/// Pixels of the canvas that are not its ground; the last frame may still be on its way.
async function waitForInk(page: Page, least: number): Promise<void> {
  for (const end = Date.now() + 60_000; ;) {
    const picture = (await page.locator('.path-frame canvas').screenshot()).toString('base64');
    const inked = await page.evaluate(async (data) => {
      const image = new Image();
      image.src = `data:image/png;base64,${data}`;
      await image.decode();
      const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
      const context = canvas.getContext('2d')!;
      context.drawImage(image, 0, 0);
      const pixels = context.getImageData(0, 0, image.width, image.height).data;
      const at = 4 * (Math.floor(image.height / 2) * image.width + 20);
      return pixels.reduce((count, value, i) => count + (i % 4 === 0 && Math.abs(value - pixels[at]!) > 60 ? 1 : 0), 0);
    }, picture);
    if (inked >= least) return;
    assert.ok(Date.now() < end, `${inked} pixels are drawn`);
  }
}

/// The place of a point of the square on the screen, seen from the top and fitted.
async function press(page: Page, x: number, y: number): Promise<void> {
  const box = (await page.locator('.path-frame').boundingBox())!;
  const scale = box.height / (100 * 1.15);
  await page.mouse.click(box.x + box.width / 2 + (x - 50) * scale, box.y + box.height / 2 - (y - 50) * scale);
}

test('a path is drawn, and its figures are there', async () => {
  const { page, complaints } = await visit('#/programs/O0100');
  await page.getByRole('link', { name: 'Tool path' }).click();
  await complete(page);
  await waitForInk(page, 500);
  await page.getByRole('row', { name: 'X 0.000 100.000' }).waitFor();
  await page.getByRole('button', { name: 'T1, line 3' }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('the path chooses the block, and the block the path', async () => {
  const { page } = await visit('#/path/O0100');
  await complete(page);
  await page.getByRole('button', { name: 'Top' }).click();
  await press(page, 100, 50);
  await current(page).getByText('7').waitFor();
  await page.getByRole('heading', { name: 'Line 7' }).waitFor();
  await page.getByRole('button', { name: 'Next' }).click();
  await page.getByRole('heading', { name: 'Line 8' }).waitFor();
  await page.getByRole('button', { name: /G1 X100/ }).click();
  await page.getByRole('heading', { name: 'Line 6' }).waitFor();
  await page.locator('canvas').focus();
  await page.keyboard.press('p');
  await page.getByRole('heading', { name: 'Line 5' }).waitFor();
  await page.keyboard.press('4');
  for (const key of ['ArrowLeft', 'Shift+ArrowUp', '+', '-', '0', '1']) await page.keyboard.press(key);
  await press(page, 50, 100);
  await page.getByRole('heading', { name: 'Line 8' }).waitFor();
});

test('drag and wheel move the path, and a drag chooses nothing', async () => {
  const { page } = await visit('#/path/O0100');
  await complete(page);
  await page.getByRole('button', { name: 'Top' }).click();
  const box = (await page.locator('.path-frame').boundingBox())!;
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  await page.mouse.move(middle.x, middle.y);
  await page.mouse.down({ button: 'right' });
  await page.mouse.move(middle.x + 60, middle.y, { steps: 4 });
  await page.mouse.up({ button: 'right' });
  await page.getByRole('heading', { name: 'Press on the path' }).waitFor();
  const scale = box.height / (100 * 1.15);
  await page.mouse.click(middle.x + 60 + 50 * scale, middle.y); // the edge has moved by 60 pixels
  await page.getByRole('heading', { name: 'Line 7' }).waitFor();
});

test('the setup of a machine moves the path', async () => {
  const { page } = await visit('#/path/O0100');
  await complete(page);
  await page.getByLabel('Setup of').selectOption('mill-1');
  await page.getByRole('row', { name: 'X 500.000 600.000' }).waitFor();
});

test('an alarm ends the path, with its line and its words as text', async () => {
  const { page, complaints } = await visit('#/path/O0200?line=1');
  await complete(page);
  await page.getByRole('alert').getByText('Line 4:').waitFor();
  await page.getByText(kHostile).waitFor();
  assert.equal(await page.locator('main img').count(), 0);
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('a lathe\'s path has Z to the right, and X as its diameter', async () => {
  const { page } = await visit('#/path/O0300');
  await complete(page);
  await page.getByText('X ⌀').waitFor();
  await waitForInk(page, 200);
});

test('a long path arrives in pieces, and ends when the view is left', async () => {
  const { page, complaints } = await visit('#/path/O0400');
  await complete(page);
  await page.getByText(/^100,00\d$/).first().waitFor();
  for (let i = 0; i < 8; ++i) { // more than may be interpreted at a time: the left ones have made room
    await page.goto(`${shop.url}/#/path/O0400?machine=mill-1&line=${i}`);
    await page.goto(`${shop.url}/#/floor`);
  }
  await page.goto(`${shop.url}/#/path/O0400/1`);
  await complete(page);
  assertNoComplaints(complaints, [503]);
});
