// An operator's day at one machine: hold, resume, overrides, abort, start, an answer, the setup, a restart; and a server that is lost
// while a command is on its way.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Page } from 'playwright-core';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';
import { longProgram, until } from './shop';

const kHostileLine = '<script>alert(1)</script>';

const { shop, visit } = shopForTests(async (shop) => {
  await shop.startMachine('mill-1', { control: 'fanuc', description: 'Vertical' });
  await shop.startMachine('lathe-1', { control: 'centurion' });
  await shop.push('O0100', longProgram('O0100', 2000), 'fanuc');
  await shop.push('O0300', `O0300\nG20 G93 G98\nINPUT (<B>DIAMETER</B>) P1\nPOPEN P0\nDPRNT [${kHostileLine}]\nPCLOS\nM30\n`, 'centurion');
});

const state = (page: Page, word: string) => page.locator('.machine-head .pill', { hasText: word });

test('a program is started, held, continued, slowed down and aborted', async () => {
  const { page, complaints } = await visit('#/machine/mill-1');
  await page.getByLabel('Program', { exact: true }).fill('O0100');
  await pressTwice(page.getByRole('button', { name: 'Start', exact: true }), page.getByRole('button', { name: 'Press again: start O0100, revision 1, on mill-1' }));
  await state(page, 'Running').waitFor();
  const executing = page.locator('.blocks [aria-current="step"] .number');
  const first = await executing.textContent();
  await page.waitForFunction((old) => document.querySelector('.blocks [aria-current="step"] .number')?.textContent !== old, first);
  assert.match((await page.locator('.blocks [aria-current="step"] .text').textContent()) ?? '', /^N\d+ G1 X/);
  await page.getByRole('button', { name: 'Feed hold' }).click();
  await state(page, 'Feed hold').waitFor();
  await page.getByRole('button', { name: 'Resume' }).click();
  await state(page, 'Running').waitFor();
  await page.getByRole('group', { name: 'Feed', exact: true }).getByRole('button', { name: 'Less' }).click();
  await page.getByRole('group', { name: 'Feed', exact: true }).getByText('90 %', { exact: true }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await pressTwice(page.getByRole('button', { name: 'Abort' }), page.getByRole('button', { name: 'Press again: abort O0100' }));
  await state(page, 'Stopped').waitFor();
  assertNoComplaints(complaints);
});

test('one press aborts nothing', async () => {
  const { page } = await visit('#/machine/mill-1');
  const id = await shop.start('mill-1', 'O0100');
  await state(page, 'Running').waitFor();
  await page.getByRole('button', { name: 'Abort' }).click();
  await page.getByRole('button', { name: 'Abort', exact: true }).waitFor(); // disarmed by itself
  assert.equal((await shop.api<{ state: string }>('GET', `runs/${id}`))?.state, 'active');
  await shop.api('POST', `runs/${id}/commands`, { action: 'abort' });
  await state(page, 'Stopped').waitFor();
});

test('a question of the control is answered, and what it prints is shown as text', async () => {
  const { page, complaints } = await visit('#/machine/lathe-1');
  await shop.start('lathe-1', 'O0300');
  const answer = page.getByLabel(/The control asks: <B>DIAMETER<\/B>/);
  await answer.fill('2.5');
  assert.deepEqual(await findBarriers(page), []);
  await answer.press('Enter');
  await page.locator('.records').getByText(kHostileLine).waitFor();
  await state(page, 'Completed').waitFor();
  assertNoComplaints(complaints);
});

test('an aborted run is continued where it was', async () => {
  const { page } = await visit('#/machine/mill-1/runs');
  await page.getByText('Restart').first().click();
  await pressTwice(page.getByRole('button', { name: 'Restart' }).first(), page.getByRole('button', { name: 'Press again: restart O0100' }));
  await page.locator('.run').first().getByText('Running').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('link', { name: 'Now' }).click();
  await state(page, 'Waits for cycle start').waitFor();
  await page.getByRole('button', { name: 'Resume' }).click();
  await state(page, 'Running').waitFor();
});

test('a tool is added in the table, and a change that another one overtook is refused and shown', async () => {
  const { page } = await visit('#/machine/mill-1/setup');
  await page.getByRole('button', { name: 'Add a tool' }).click();
  await page.getByRole('textbox', { name: 'Text' }).fill('# by hand\n[[tool]]\nnumber = 1\nlength = 100.0\n');
  await page.getByLabel('Tools, row 1, length').fill('101.5');
  assert.equal(await page.getByRole('textbox', { name: 'Text' }).inputValue(), '# by hand\n[[tool]]\nnumber = 1\nlength = 101.5\n');
  await page.getByRole('button', { name: 'Store as a new revision' }).click();
  await page.getByText(/^Revision 1,/).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await shop.api('PUT', 'machines/mill-1/setup', '[[tool]]\nnumber = 7\n');
  await page.getByLabel('Tools, row 1, length').fill('102');
  await page.getByRole('button', { name: 'Store as a new revision' }).click();
  await page.getByText('admin has stored revision 2 meanwhile').waitFor();
  await page.getByRole('button', { name: /Continue with my text/ }).click();
  await page.getByRole('button', { name: 'Store as a new revision' }).click();
  await page.getByText(/^Revision 3,/).waitFor();
  await page.getByRole('button', { name: 'Compare' }).last().click();
  await page.getByText('From revision 1 to 3').waitFor();
});

test('a command whose answer is lost is reported and never sent again', async () => {
  const { page } = await visit('#/machine/mill-1');
  await state(page, 'Running').waitFor();
  const commands: string[] = [];
  page.on('request', (request) => { if (request.method() !== 'GET') commands.push(request.url()); });
  await shop.stopServer();
  await page.getByText(/Server lost since/).waitFor();
  await page.getByRole('button', { name: 'Feed hold' }).click();
  await page.getByRole('alert').getByText('may have been carried out').waitFor();
  await shop.startServer();
  await page.getByText('Live', { exact: true }).waitFor();
  await state(page, 'Running').waitFor();
  await until('the machine runs on', async () => (await shop.api<{ status: { execution: string } }>('GET', 'machines/mill-1'))?.status.execution === 'ACTIVE');
  assert.equal(commands.length, 1);
});
