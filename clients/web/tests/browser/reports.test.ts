// What came of the runs, and the server itself: records and charts, exports, hostile report lines, ports, audit.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';
import { measuringProgram, until } from './shop';

const kHostile = '<img src=x onerror=alert(1)>';
let run = '';

const { visit } = shopForTests(async (shop) => {
  await shop.startMachine('lathe-1', { control: 'centurion', speed: 'max' });
  await shop.push('O0500', measuringProgram(40).replace('PCLOS', `DPRNT [${kHostile}]\nPCLOS`), 'centurion');
  run = await shop.start('lathe-1', 'O0500');
  await until('the run has ended', async () => (await shop.api<{ state: string }>('GET', `runs/${run}`))?.state === 'completed');
});

test('measured values become a chart, and limits count what is outside', async () => {
  const { page, complaints } = await visit('#/reports');
  await page.getByRole('rowheader', { name: 'O0500' }).getByRole('link').click();
  await page.locator('.chart canvas').waitFor();
  await page.getByRole('combobox', { name: 'Value' }).selectOption('Z');
  await page.getByText('40 values').first().waitFor();
  await page.getByLabel('Lower limit').fill('-2.2');
  await page.getByLabel('Lower limit').press('Tab');
  await page.getByText(/\d+ are outside the limits/).waitFor();
  const inked = await page.locator('.chart canvas').evaluate((canvas: HTMLCanvasElement) => {
    const { data } = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
    return data.filter((value, i) => i % 4 === 3 && value > 0).length;
  });
  assert.ok(inked > 1000, `${inked} pixels are drawn`);
  await page.reload();
  await page.getByText(/\d+ are outside the limits/).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('report lines that others wrote are shown and do nothing', async () => {
  const { page, complaints } = await visit(`#/reports/${run}`);
  await page.getByRole('cell', { name: kHostile }).waitFor();
  assert.equal(await page.locator('img').count(), 0);
  assertNoComplaints(complaints);
});

test('a report is exported as CSV and JSON', async () => {
  const { page } = await visit(`#/reports/${run}`);
  for (const format of ['CSV', 'JSON']) {
    const [file] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: format }).click()]);
    assert.match(file.suggestedFilename(), new RegExp(`^O0500-.*\\.${format.toLowerCase()}$`));
    assert.match(readFileSync((await file.path())!, 'utf8'), /X10\.00/);
  }
});

test('the server\'s state and who changed what can be read', async () => {
  const { page, complaints } = await visit('#/administration');
  await page.getByText('1 of 1 connected').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('link', { name: 'Audit trail' }).click();
  await page.getByRole('cell', { name: 'admin' }).first().waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('a port is added, tested, changed and removed', async () => {
  const { page } = await visit('#/administration/ports');
  await page.getByText('Add a port').click();
  await page.getByLabel('Name').fill('line-9');
  await page.getByLabel('Machine').fill('mill-9');
  await page.getByLabel('Address').fill('/dev/does-not-exist');
  await page.getByRole('combobox', { name: 'Template' }).selectOption('tnc155');
  await page.getByLabel(/Settings/).fill('baud 4800');
  await page.getByRole('button', { name: 'Store and reopen the line' }).click();
  await page.getByRole('alert').getByText('"baud 4800" is no setting').waitFor();
  await page.getByLabel(/Settings/).fill('line = 4800e71');
  await page.getByRole('button', { name: 'Store and reopen the line' }).click();
  const card = page.locator('li.panel', { hasText: 'line-9' });
  await card.locator('.pill', { hasText: 'Closed' }).waitFor();
  await card.getByText('/dev/does-not-exist').first().waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await card.getByRole('button', { name: 'Test' }).click();
  await card.getByText(/The test failed|does-not-exist/).first().waitFor();
  await pressTwice(card.getByRole('button', { name: 'Remove' }), card.getByRole('button', { name: 'Press again: remove line-9' }));
  await page.getByText('There is no port yet.').waitFor();
});
