// Archives: the rules, retention applied now, and the rows of an archive read back; a server without them says how to have them.
import assert from 'node:assert/strict';
import path from 'node:path';
import { test } from 'node:test';
import { addMeasuringLathe, kHostile, makePart } from './measured_shop';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';

const { shop, visit } = shopForTests(async (shop) => {
  await addMeasuringLathe(shop);
  for (let i = 0; i < 3; ++i) await makePart(shop, { length: 1.001, diameter: 2.0, more: kHostile });
  await shop.addUser('otto', 'operator', ['all']);
}, (shop) => ['--archives', path.join(shop.folder, 'archives'), '--archive-records-days', '30', '--archive-measurements-thousands', '5']);

test('the rules are shown, and nothing is moved that they keep', async () => {
  const { page, complaints } = await visit('#/administration/archives');
  await page.getByText('after 30 days').waitFor();
  await page.getByText('what is beyond 5,000 rows').waitFor();
  await page.getByText('There is no archive yet.').waitFor();
  await pressTwice(page.getByRole('button', { name: 'Apply now' }), page.getByRole('button', { name: /^Press again: move/ }));
  await page.getByText('Nothing was beyond the rules.').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('an archive is read back, searched, and known to be whole', async () => {
  const { page, complaints } = await visit('#/administration/archives');
  const archive = { id: 7, kind: 'records', machine: 'lathe-3', file: 'records-lathe-3.zst', sha256: 'ab'.repeat(32), rows: 3, bytes: 900, first: '2026-01-01T00:00:00Z', last: '2026-01-02T00:00:00Z', created: '2026-02-01T00:00:00Z', removed: true };
  const row = (text: string) => ({ machine: 'lathe-3', run: 'run-1', kind: 'output', time: '2026-01-01T00:00:00Z', text });
  const rule = { days: 30, rows: null };
  await page.route('**/api/v1/archives?**', (route) => route.fulfill({ json: { archives: [archive], retention: { folder: '/archives', records: rule, measurements: rule } } }));
  await page.route('**/api/v1/archives/7/rows?**', (route) => {
    const isSearch = route.request().url().includes('contains=DIA');
    return route.fulfill({ json: { archive, found: isSearch ? 1 : 2, rows: isSearch ? [row('DIA 2')] : [row('DIA 2'), row(kHostile)] } });
  });
  await page.reload();
  await page.getByRole('button', { name: 'Read back records-lathe-3.zst' }).click();
  await page.getByText('2 of 3 rows. The file is as it was written.').waitFor();
  await page.getByRole('row', { name: /lathe-3 run-1 Output/ }).filter({ hasText: kHostile }).waitFor();
  assert.equal(await page.locator('main img').count(), 0);
  assert.deepEqual(await findBarriers(page), []);
  await page.getByLabel('Only rows that contain').fill('DIA');
  await page.getByRole('button', { name: 'Search', exact: true }).click();
  await page.getByText('1 of 3 rows. The file is as it was written.').waitFor();
  assertNoComplaints(complaints);
});

test('who may not administer sees none; a server without archives says so', async () => {
  const { page } = await visit('#/administration/archives', { user: 'otto' });
  await page.getByText('Your role is Operator: this needs Administrator.').waitFor();
  const { page: admin } = await visit('#/administration/server');
  await admin.route('**/api/v1/archives?**', (route) => route.fulfill({ status: 404, json: { error: { code: 'not_found', message: 'none' } } }));
  await admin.getByRole('link', { name: 'Archives' }).click();
  await admin.getByText('This server makes no archives').waitFor();
  assert.ok(await shop.api('GET', 'archives'));
});
