// Two revisions compared: side by side, normalized, by motion on a machine's setup, with conditions, hostile.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { assertNoComplaints, findBarriers, shopForTests } from './page';

const kFirst = 'O0100 (SQUARE)\nG21 G90 G94 G55\nG0 X0. Y0. Z5.\nG1 Z0. F100.\nG1 X100. F500.\nG1 Y100.\nG1 X0.\nG0 Z5.\nM30\n';
const kSecond = kFirst.replace('X100. F500.', 'X100.5 F450.').replace('G1 X0.', '(BACK)\nG1 X0.');
const kHostile = '<img src=x onerror=alert`1`>';

const { shop, visit } = shopForTests(async (shop) => {
  await shop.startMachine('mill-1', { control: 'fanuc' });
  await shop.api('PUT', 'machines/mill-1/setup', '[[offset]]\nname = "G54"\nX = 500.0\n');
  for (const text of [kFirst, kSecond, kSecond.replace('G55', 'G54').replaceAll('G1 ', 'G01 ')]) await shop.push('O0100', text, 'fanuc');
  for (const size of ['1.', '2.']) await shop.push('O0200', `O0200 (${kHostile})\nG21\nG0 X#500\nG0 Y${size} (${kHostile})\nM30\n`, 'fanuc');
});

const complete = '[data-complete=true]';

test('two texts are beside each other, found from the program', async () => {
  const { page, complaints } = await visit('#/programs/O0100/2');
  await page.getByLabel('Changes to revision 2 from').selectOption('1');
  await page.getByRole('link', { name: 'Compare side by side and by motion' }).click();
  await page.getByRole('heading', { name: 'Comparison of O0100' }).waitFor();
  await page.getByText('The texts differ at 2 places: 1 lines removed, 2 added.').waitFor();
  const changed = page.locator('.side-by-side tr.changed');
  assert.deepEqual(await changed.locator('td').allTextContents(), ['5', 'G1 X100. F500.', '≠', '5', 'G1 X100.5 F450.']);
  assert.deepEqual(await page.locator('.side-by-side tr.added td').allTextContents(), ['', '', '+', '7', '(BACK)']);
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('a place where the motion differs opens both texts, by keyboard', async () => {
  const { page, complaints } = await visit('#/compare/O0100/1/2');
  await page.locator(complete).waitFor();
  await page.getByRole('combobox', { name: 'Compare' }).selectOption('motion');
  await page.getByText(/The motion differs at 3 places; paths are up to 0\.5000 mm apart/).waitFor();
  await page.getByText('The change is about: geometry.').waitFor();
  const places = page.locator('.compared-place');
  assert.equal(await places.count(), 3);
  await places.first().focus();
  await page.keyboard.press('Enter');
  const current = page.locator('.path-blocks [aria-current=step] .text');
  await current.nth(1).waitFor();
  assert.deepEqual(await current.allTextContents(), ['G1 X100. F500.', 'G1 X100.5 F450.']);
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('the setup of a machine decides, and the address keeps what is chosen', async () => {
  const { page } = await visit('#/compare/O0100/2/3?by=motion');
  await page.getByText(/^Same motion: \d+ actions, paths within 0\.001 mm\.$/).waitFor();
  await page.getByLabel('Setup of').selectOption('mill-1');
  await page.getByText(/The motion differs at/).waitFor();
  assert.match(new URL(page.url()).hash, /machine=mill-1/);
  await page.getByText('The change is about: offsets.').waitFor();
  await page.getByRole('combobox', { name: 'Compare' }).selectOption('normalized');
  await page.getByText('The texts differ at 1 place:').waitFor();
});

test('what depends on the machine is a condition, and hostile texts do nothing', async () => {
  const { page, complaints } = await visit('#/compare/O0200/1/2?by=motion');
  await page.getByRole('heading', { name: 'Conditions' }).waitFor();
  await page.getByText('A value may come from outside').first().waitFor();
  await page.locator('.compared-place').first().click();
  await page.locator('.path-blocks [aria-current=step]', { hasText: 'onerror' }).first().waitFor();
  assert.equal(await page.locator('main img').count(), 0);
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
  assert.ok(shop.url);
});
