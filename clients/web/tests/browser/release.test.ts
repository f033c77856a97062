// From a draft to a released revision and back: each step by who may take it, with the comments that the policy asks for; and why a run was allowed.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import type { Page } from 'playwright-core';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';
import { until } from './shop';

const kHostile = '<img src=x onerror=alert(1)>';
const kPolicy = `runs = "release"
[prove_out]
machines = ["mill-9"]
role = "programmer"
[approve]
four_eyes = true
[withdraw]
comment = true
`;

const { shop, visit } = shopForTests(async (shop) => {
  await shop.startMachine('mill-1', { control: 'fanuc', speed: 'max' });
  await shop.addUser('paul', 'programmer', ['all']);
  await shop.addUser('vera', 'approver', ['all']);
  await shop.push('O0200', 'O0200\nG21 G90\nG1 X10. F100.\nM30\n', 'fanuc', undefined, 'vera');
}, (shop) => {
  const file = path.join(shop.folder, 'policy.toml');
  writeFileSync(file, kPolicy);
  return ['--policy', file];
});

const panel = (page: Page) => page.getByRole('region', { name: 'State and approval' });
const take = (page: Page, step: string) =>
  pressTwice(panel(page).getByRole('button', { name: step, exact: true }), panel(page).getByRole('button', { name: `Press again: ${step.toLowerCase()}: O0200, revision 1` }));
const state = (page: Page, word: string) => panel(page).locator('.pill', { hasText: word });

test('a programmer submits, and can do no more', async () => {
  const { page, complaints } = await visit('#/programs/O0200', { user: 'paul' });
  await state(page, 'Draft').waitFor();
  await panel(page).getByText('Machines run released revisions only; mill-9 also run others').waitFor();
  await page.getByLabel('Start on').selectOption('mill-1');
  await page.getByText('Machine mill-1 runs released revisions only.').waitFor();
  assert.ok(await page.getByRole('button', { name: 'Start', exact: true }).isDisabled());
  await panel(page).getByLabel('Comment').fill(kHostile);
  await take(page, 'Submit for review');
  await state(page, 'In review').waitFor();
  await panel(page).getByText(kHostile).waitFor();
  assert.equal(await page.locator('main img').count(), 0);
  await panel(page).getByText('Approve: Your role is Programmer: this needs Approver.').waitFor();
  assert.ok(await panel(page).getByRole('button', { name: 'Approve', exact: true }).isDisabled());
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('who pushed it does not approve it', async () => {
  const { page } = await visit('#/programs/O0200', { user: 'vera' });
  await panel(page).getByText('Approve: The policy asks for another user than the one who pushed this text.').waitFor();
  assert.ok(await panel(page).getByRole('button', { name: 'Approve', exact: true }).isDisabled());
});

test('another one approves and releases, the machine runs it, and the report says why', async () => {
  const { page, complaints } = await visit('#/programs/O0200');
  await take(page, 'Approve');
  await state(page, 'Approved').waitFor();
  await take(page, 'Release');
  await state(page, 'Released').waitFor();
  await page.getByRole('list', { name: 'Decisions' }).getByText('Submitted for review').waitFor();
  const [signed] = await Promise.all([page.waitForEvent('download'), panel(page).getByRole('button', { name: 'Download with signatures' }).click()]);
  assert.match(readFileSync((await signed.path())!, 'utf8'), /"signature": "[0-9a-f]{128}"/);
  // A newer draft changes nothing: the start takes the released revision.
  await shop.push('O0200', 'O0200\nG21 G90\nG1 X11. F100.\nM30\n', 'fanuc', undefined, 'paul');
  await page.goto(`${shop.url}/#/machine/mill-1`);
  await page.getByLabel('Program', { exact: true }).fill('O0200');
  await pressTwice(page.getByRole('button', { name: 'Start', exact: true }), page.getByRole('button', { name: 'Press again: start O0200, revision latest released, on mill-1' }));
  await until('the run has ended', async () => (await shop.api<{ runs: Array<{ state: string }> }>('GET', 'runs'))?.runs[0]?.state === 'completed');
  const { runs } = (await shop.api<{ runs: Array<{ id: string; revision: number }> }>('GET', 'runs'))!;
  assert.equal(runs[0]!.revision, 1);
  await page.goto(`${shop.url}/#/reports/${runs[0]!.id}`);
  await page.getByRole('link', { name: /released by step \d+/ }).waitFor();
  const [file] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Attestation' }).click()]);
  assert.match(readFileSync((await file.path())!, 'utf8'), /^dripline run attestation 1\n/);
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('a revision is withdrawn with a comment alone, and runs nowhere', async () => {
  const { page } = await visit('#/programs/O0200/1', { user: 'vera' });
  await panel(page).getByText('A comment is needed to: Withdraw.').waitFor();
  assert.ok(await panel(page).getByRole('button', { name: 'Withdraw', exact: true }).isDisabled());
  await panel(page).getByLabel('Comment').fill('cuts into the chuck');
  await take(page, 'Withdraw');
  await state(page, 'Withdrawn').waitFor();
  await page.getByLabel('Start on').selectOption('mill-1');
  await page.getByText('This revision is withdrawn: it runs nowhere.').waitFor();
  await page.goto(`${shop.url}/#/programs`);
  await page.getByRole('row', { name: /O0200/ }).getByText('Draft').waitFor();
});
