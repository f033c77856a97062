// The floor in a real browser: signing in, live cards, the filter, a lost server, hostile names, and its size.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { assertNoComplaints, findBarriers, shopForTests } from './page';
import { longProgram } from './shop';

const kHostile = '<img src=x onerror=alert(1)>';

const { shop, visit } = shopForTests(async (shop) => {
  await shop.startMachine('mill-1', { control: 'fanuc', description: kHostile });
  await shop.startMachine('mill-10', { control: 'fanuc', description: 'Five axes' });
  await shop.startMachine('lathe-2', { control: 'centurion' });
  await shop.push('O0100', longProgram('O0100', 2000), 'fanuc');
  await shop.push('O0200', 'O0200\nG21 G90\nG1 X1. F100. ZZ5.\nM30\n', 'fanuc');
  await shop.start('mill-1', 'O0100');
});

test('cards follow the machines and show what others wrote as text', async () => {
  const { page, complaints } = await visit();
  const card = page.locator('[data-machine="mill-1"]');
  await card.getByText('Running').waitFor();
  await card.getByText(kHostile).waitFor();
  await card.getByText('O0100').waitFor();
  const first = await card.locator('.program .muted').textContent();
  await page.waitForFunction((old) => document.querySelector('[data-machine="mill-1"] .program .muted')?.textContent !== old, first);
  assert.deepEqual(await page.locator('.card h2').allTextContents(), ['lathe-2', 'mill-1', 'mill-10']);
  assertNoComplaints(complaints);
  assert.deepEqual(await findBarriers(page), []);
});

test('an alarm is red, says the control\'s words and can be filtered', async () => {
  const { page } = await visit();
  await shop.start('mill-10', 'O0200');
  const card = page.locator('[data-machine="mill-10"].alarm');
  await card.getByText('Alarm', { exact: true }).waitFor();
  assert.match((await card.locator('.message').textContent()) ?? '', /\S/);
  await page.getByRole('button', { name: 'Alarm 1' }).click();
  await page.waitForFunction(() => document.querySelectorAll('.card').length === 1);
  await page.getByRole('searchbox').fill('lathe');
  await page.getByText('No machine fits the filter.').waitFor();
  await page.reload();
  await page.getByText('No machine fits the filter.').waitFor();
  await page.getByRole('button', { name: 'All' }).click();
  await page.locator('[data-machine="lathe-2"]').waitFor();
});

test('the wall mode has no bar, fits, and is left again', async () => {
  const { page } = await visit();
  await page.getByRole('link', { name: 'Wall mode' }).click();
  await page.getByText('3 machines').waitFor();
  assert.equal(await page.getByRole('navigation').count(), 0);
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('link', { name: 'Leave wall mode' }).click();
  await page.getByRole('navigation').waitFor();
});

test('a lost server is reported with its time, values stay and are marked, and the page comes back by itself', async () => {
  const { page, complaints } = await visit();
  await page.locator('[data-machine="mill-1"]').getByText('O0100').waitFor();
  await shop.stopServer();
  await page.getByText(/Server lost since \d/).waitFor();
  assert.equal(await page.locator('html.old').count(), 1);
  await page.locator('[data-machine="mill-1"]').getByText('O0100').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await shop.startServer();
  await page.getByText('Live', { exact: true }).waitFor();
  await page.waitForFunction(() => !document.documentElement.classList.contains('old'));
  await page.locator('[data-machine="mill-1"]').getByText('Running').waitFor();
  assertNoComplaints(complaints);
});

test('German is one choice away, and stays', async () => {
  const { page } = await visit();
  await page.getByText('Settings').click();
  await page.getByLabel('Language').selectOption('de');
  await page.getByRole('link', { name: 'Halle' }).waitFor();
  await page.reload();
  await page.getByRole('link', { name: 'Halle' }).waitFor();
  assert.equal(await page.evaluate(() => document.documentElement.lang), 'de');
});

test('the first view is at most 60 KiB, and comes again as 304', async () => {
  const { page } = await visit();
  const session = await page.context().newCDPSession(page);
  await session.send('Network.enable');
  let bytes = 0;
  session.on('Network.loadingFinished', (event) => { bytes += event.encodedDataLength; });
  await session.send('Network.setCacheDisabled', { cacheDisabled: true });
  await page.goto('about:blank');
  bytes = 0; // what the visit had not loaded yet
  await page.goto(`${shop.url}/`);
  await page.locator('[data-machine="mill-1"]').waitFor();
  assert.ok(bytes > 5_000 && bytes <= 60 * 1024, `${bytes} bytes`);
  const first = await fetch(`${shop.url}/`);
  const again = await fetch(`${shop.url}/`, { headers: { 'If-None-Match': first.headers.get('etag')! } });
  assert.equal(again.status, 304);
});
