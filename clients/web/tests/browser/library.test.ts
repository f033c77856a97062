// What belongs to a program besides its text: fields, attachments, what it calls; and the search through all of it.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import type { Page } from 'playwright-core';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';
import { until } from './shop';

const kHostile = '<img src=x onerror=alert(1)>';
const kMain = 'O0200 (BRACKET)\nG21 G90\n(DEEP POCKET)\nM98 P210\nM30\n';

const { shop, visit } = shopForTests(async (shop) => {
  await shop.push('O0200', kMain, 'fanuc', kHostile);
  await shop.push('O0210', 'O0210 (HOLES)\nG1 X1. F100.\nM99\n', 'fanuc');
  await shop.push('O0300', 'O0300 (SHAFT)\nG21\nM98 P310\nM30\n', 'fanuc');
  await shop.api('PUT', 'machine-groups/cell-1');
  await shop.addUser('paul', 'programmer', ['all']);
  await shop.addUser('vera', 'viewer');
  await until('the texts are indexed', async () => (await shop.api<{ to_be_indexed: number }>('GET', 'search?words=pocket'))?.to_be_indexed === 0);
});

const region = (page: Page, name: string) => page.getByRole('region', { name });

test('what a program is for is stored, and leads to the programs for the same part', async () => {
  const { page, complaints } = await visit('#/programs/O0200', { user: 'paul' });
  const about = region(page, 'What it is for');
  await about.getByText('Change').click();
  assert.ok(await about.getByRole('button', { name: 'Store' }).isDisabled());
  await about.getByLabel('Part', { exact: true }).fill(kHostile);
  await about.getByLabel('Material').fill('steel');
  await about.getByLabel('Machine group').fill('cell-1');
  await about.getByLabel('CAM file').fill('bracket.prt');
  await about.getByRole('button', { name: 'Store' }).click();
  await about.getByRole('link', { name: kHostile }).waitFor();
  assert.equal(await page.locator('main img').count(), 0);
  assert.deepEqual(await findBarriers(page), []);
  await about.getByRole('link', { name: 'steel' }).click();
  await page.getByText('1 program', { exact: true }).waitFor();
  await page.getByRole('rowheader', { name: 'O0200' }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('an attachment is dropped, saved as it was, and removed', async () => {
  const { page, complaints } = await visit('#/programs/O0200', { user: 'paul' });
  const attachments = region(page, 'Attachments');
  const transfer = await page.evaluateHandle((content) => {
    const data = new DataTransfer();
    data.items.add(new File([content], 'setup sheet.html'));
    return data;
  }, kHostile);
  await attachments.getByText('Drop attachments here').waitFor();
  await attachments.locator('[data-testid=drop]').dispatchEvent('drop', { dataTransfer: transfer });
  const saved = attachments.getByRole('button', { name: 'setup sheet.html save' });
  const [file] = await Promise.all([page.waitForEvent('download'), saved.click()]);
  assert.equal(file.suggestedFilename(), 'setup sheet.html');
  assert.equal(readFileSync((await file.path())!, 'utf8'), kHostile);
  assert.deepEqual(await findBarriers(page), []);
  await pressTwice(attachments.getByRole('button', { name: 'Remove', exact: true }), attachments.getByRole('button', { name: 'Press again: remove setup sheet.html' }));
  await attachments.getByText('There is none').waitFor();
  const { page: viewers } = await visit('#/programs/O0200', { user: 'vera' });
  await region(viewers, 'Attachments').getByText('Your role is Viewer: this needs Programmer.').waitFor();
  assertNoComplaints(complaints);
});

test('a search finds words of the text while they are typed, and leads to the line', async () => {
  const { page, complaints } = await visit('#/programs');
  await page.getByRole('searchbox').fill('deep pock');
  const hit = page.locator('.hit', { hasText: 'O0200' });
  await hit.locator('mark', { hasText: 'POCK' }).first().waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await hit.getByRole('link').click();
  await page.locator('.blocks [aria-current=location]', { hasText: '(DEEP POCKET)' }).waitFor();
  await page.goBack();
  await hit.waitFor(); // the search is in the address
  await page.getByRole('searchbox').fill('o03');
  await page.getByRole('link', { name: /^O0300/ }).waitFor();
  await page.getByText('Nothing has all of these words.').waitFor();
  assertNoComplaints(complaints);
});

test('what is called is listed, what is missing too, and a release pins it', async () => {
  const { page, complaints } = await visit('#/programs/O0300');
  await region(page, 'Called programs').getByText('310 is not stored for this control').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  for (const program of ['O0200', 'O0210']) {
    for (const step of ['submit', 'approve']) await shop.api('POST', `programs/${program}/revisions/1/${step}`, {});
  }
  await page.goto(`${shop.url}/#/programs/O0200`);
  const calls = region(page, 'Called programs');
  await calls.getByRole('row', { name: /O0210.*1.*Approved.*O0200, line 4/ }).waitFor();
  const release = region(page, 'State and approval');
  assert.ok(await release.getByLabel('Release and pin the program that it calls').isChecked());
  await pressTwice(release.getByRole('button', { name: 'Release', exact: true }), release.getByRole('button', { name: 'Press again: release: O0200, revision 1, with the program that it calls' }));
  await release.getByText('With it, and no others:').waitFor();
  await calls.getByRole('row', { name: /O0210.*Released/ }).waitFor();
  assertNoComplaints(complaints);
});

test('in German too', async () => {
  const { page } = await visit('#/programs/O0200', { language: 'de-DE' });
  await region(page, 'Gerufene Programme').getByText('O0210').first().waitFor();
  await region(page, 'Anlagen').waitFor();
  assert.deepEqual(await findBarriers(page), []);
});
