// The queue of a machine: a programmer adds to it, an operator orders it, holds it and starts from it, a viewer sees it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Page } from 'playwright-core';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';
import { until } from './shop';

const kHostile = '<img src=x onerror=alert(1)>';
const program = (number: string) => `${number} (PLATE)\nG21 G90\nG1 X10. F6000.\nM30\n`;

const { shop, visit } = shopForTests(async (shop) => {
  await shop.startMachine('mill-1', { control: 'fanuc', speed: 'max' });
  for (const number of ['O0200', 'O0300']) await shop.push(number, program(number), 'fanuc');
  await shop.addUser('otto', 'operator', ['all']);
  await shop.addUser('vera', 'viewer');
});

interface Jobs {
  jobs: Array<{ program: string; completed: number; state: string }>;
  hold: { reason: string } | null;
}
const queue = async () => (await shop.api<Jobs>('GET', 'machines/mill-1/jobs'))!;
const row = (page: Page, program: string) => page.locator('.jobs > li', { hasText: program });

test('jobs are added with quantity and note, and stay in order', async () => {
  const { page, complaints } = await visit('#/machine/mill-1/queue', { user: 'otto' });
  await page.getByText('Nothing waits for this machine.').waitFor();
  await page.getByLabel('Program', { exact: true }).fill('O0200');
  await page.getByLabel('Parts', { exact: true }).fill('2');
  await page.getByLabel('Note for the operator').fill(kHostile);
  await page.getByRole('button', { name: 'Add to the queue' }).click();
  await row(page, 'O0200').getByText('0 of 2 parts').waitFor();
  await row(page, 'O0200').getByText(kHostile).waitFor();
  assert.equal(await page.locator('main img').count(), 0);
  await page.getByLabel('Program', { exact: true }).fill('O0300');
  await page.getByLabel('Counted').selectOption('good');
  await page.getByRole('button', { name: 'Add to the queue' }).click();
  await row(page, 'O0300').getByText('0 of 2 good parts').waitFor();
  await row(page, 'O0300').getByText('0 made: 0 good, 0 unknown; rework 0, scrap 0').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('button', { name: 'Move O0300 up' }).click();
  await page.locator('.jobs > li:first-child', { hasText: 'O0300' }).waitFor();
  assert.deepEqual((await queue()).jobs.map((job) => job.program), ['O0300', 'O0200']);
  await pressTwice(row(page, 'O0300').getByRole('button', { name: 'Remove' }), page.getByRole('button', { name: /Press again: remove O0300/ }));
  await row(page, 'O0300').waitFor({ state: 'detached' });
  assertNoComplaints(complaints);
});

test('a held queue starts nothing and says why, until it is released', async () => {
  const { page } = await visit('#/machine/mill-1/queue', { user: 'otto' });
  await page.getByText('Hold the queue').click();
  await page.getByLabel('Reason').fill('fixture is cracked');
  await page.getByRole('button', { name: 'Hold now' }).click();
  await page.getByText(/^The queue is held by otto since .*: fixture is cracked$/).waitFor();
  assert.ok(await page.getByRole('button', { name: 'Start next' }).isDisabled());
  assert.deepEqual(await findBarriers(page), []);
  assert.equal((await queue()).hold?.reason, 'fixture is cracked');
  await pressTwice(page.getByRole('button', { name: 'Release the queue' }), page.getByRole('button', { name: 'Press again: release the queue of mill-1' }));
  await page.getByText('Hold the queue').waitFor();
});

test('the next part is started from the machine\'s first view, and counted', async () => {
  const { page, complaints } = await visit('#/machine/mill-1', { user: 'otto' });
  await page.getByRole('region', { name: 'Next job' }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await pressTwice(page.getByRole('button', { name: 'Start next' }), page.getByRole('button', { name: 'Press again: start O0200, part 1 of 2, on mill-1' }));
  await until('a part is made', async () => (await queue()).jobs[0]?.completed === 1);
  await page.getByRole('link', { name: 'Queue', exact: true }).click();
  await row(page, 'O0200').getByText('1 of 2 parts').waitFor();
  await pressTwice(page.getByRole('button', { name: 'Start next' }), page.getByRole('button', { name: 'Press again: start O0200, part 2 of 2, on mill-1' }));
  await page.getByText('Nothing waits for this machine.').waitFor();
  await page.getByText('Done and removed').click();
  await page.locator('.closed-jobs').getByText('2 of 2 parts').waitFor();
  assertNoComplaints(complaints);
});

test('a program is queued from its own page; a viewer sees the queue and changes nothing', async () => {
  const { page } = await visit('#/programs/O0300', { user: 'otto' });
  await page.getByText('Add to the queue of a machine').click();
  await page.getByRole('combobox', { name: 'Machine' }).selectOption('mill-1');
  await page.getByRole('button', { name: 'Add to the queue', exact: true }).click();
  await page.getByText('It waits in the queue of mill-1.').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  const { page: viewers } = await visit('#/machine/mill-1/queue', { user: 'vera' });
  await row(viewers, 'O0300').waitFor();
  await viewers.getByText('Your role is Viewer: this needs Operator.').waitFor();
  assert.ok(await viewers.getByRole('button', { name: 'Start next' }).isDisabled());
});

test('in German too', async () => {
  const { page } = await visit('#/machine/mill-1/queue', { language: 'de-DE' });
  await page.getByRole('heading', { name: 'Auftragsliste' }).waitFor();
  await page.getByText('0 von 1 Teilen').waitFor();
  assert.deepEqual(await findBarriers(page), []);
});
