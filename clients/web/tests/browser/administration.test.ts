// Who looks after the server: backups, certificates, the release policy, the audit trail's verification, ports with templates, control memory.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { after, test } from 'node:test';
import { LineControl } from './line_control';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';

let control: LineControl;
const { shop, visit } = shopForTests(async (shop) => {
  control = await LineControl.listen();
  await shop.push('O0300', 'O0300\nG21\nM30\n', 'fanuc');
  await shop.addUser('otto', 'operator', ['all']);
}, (shop) => ['--backups', path.join(shop.folder, 'backups'), '--backup-every-hours', '0']);
after(() => control.end());

test('a backup is made, verified and removed', async () => {
  const { page, complaints } = await visit('#/administration/backups');
  await page.getByRole('button', { name: 'Make a backup now' }).click();
  await page.getByText(/Backup \S+ is made/).waitFor();
  const row = page.locator('tbody tr').first();
  await row.getByText('never', { exact: true }).waitFor();
  assert.ok(await row.getByRole('button', { name: 'Remove' }).isDisabled(), 'the only one stays');
  await row.getByRole('button', { name: /^Verify/ }).click();
  await page.getByText(/Backup \S+ is good/).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('button', { name: 'Make a backup now' }).click();
  await page.locator('tbody tr').nth(1).waitFor();
  await pressTwice(row.getByRole('button', { name: 'Remove' }), row.getByRole('button', { name: /Press again: remove backup/ }));
  await page.locator('tbody tr').nth(1).waitFor({ state: 'detached' });
  assert.ok(existsSync(path.join(shop.folder, 'backups')) && readdirSync(path.join(shop.folder, 'backups')).length > 0);
  assertNoComplaints(complaints);
});

test('the audit trail is verified again, exported, and its checkpoint kept', async () => {
  const { page, complaints } = await visit('#/administration/audit');
  await page.getByRole('button', { name: 'Verify now' }).click();
  await page.getByText('The trail is as it was written.').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  const [trail] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Export the trail' }).click()]);
  assert.match(readFileSync((await trail.path())!, 'utf8'), /^dripline audit 1\t/);
  assertNoComplaints(complaints);
});

test('an archive that is missing or was changed is named beside the trail', async () => {
  const { page, complaints } = await visit('#/administration/audit');
  const state = await shop.api('GET', 'audit/verification') as object;
  const archives = { time: '2026-11-21T07:40:06Z', archives: 2, intact: false, faults: [{ file: 'records-lathe-1-7-1.jsonl.zst', what: 'it is missing' }] };
  await page.route('**/api/v1/audit/verification', (route) => route.fulfill({ json: { ...state, archives } }));
  await page.reload();
  await page.getByText('Archives are missing or were changed.').waitFor();
  await page.getByText('records-lathe-1-7-1.jsonl.zst: it is missing').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('the state of the MQTT broker is shown, also without one', async () => {
  const { page, complaints } = await visit('#/administration/server');
  await page.getByText('No broker is configured').waitFor();
  const server = await shop.api('GET', 'server') as object;
  const mqtt = { broker: 'tls://broker:8883', connected: false, since: '2026-11-21T07:40:06Z', fault: 'connection refused', records_waiting: 1200, records_published: 7, states_published: 9, records_missing: 3, sparkplug: null };
  await page.route('**/api/v1/server', (route) => route.fulfill({ json: { ...server, mqtt } }));
  await page.reload();
  await page.getByText('Not connected since').waitFor();
  await page.getByText('connection refused').waitFor();
  await page.getByText('1,200', { exact: true }).waitFor();
  await page.getByText('3 records went into archives before they were published').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.unroute('**/api/v1/server');
  await page.route('**/api/v1/server', (route) => route.fulfill({ json: { ...server, mqtt: { ...mqtt, connected: true, records_missing: 0 } } }));
  await page.reload();
  await page.getByText('Connected since').waitFor();
  await page.getByText('Last fault').waitFor();
  await page.unroute('**/api/v1/server');
  const sparkplug = { node: 'shop/dncd-1', connected: false, since: '2026-11-21T07:40:06Z', fault: 'no host is online', messages_published: 40, rebirths: 2 };
  await page.route('**/api/v1/server', (route) => route.fulfill({ json: { ...server, mqtt: { ...mqtt, connected: true, records_missing: 0, sparkplug } } }));
  await page.reload();
  await page.getByText('shop/dncd-1').waitFor();
  await page.getByText('no host is online').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('the servers that wait are shown, and one gets the library by two presses', async () => {
  const { page, complaints } = await visit('#/administration/server');
  await page.getByText('The library is a SQLite file of this server alone').waitFor();
  const server = await shop.api('GET', 'server') as object;
  const cache = { size_bytes: 1 << 30, used_bytes: 3 << 20, hits: 1200, misses: 4, fetched: 7, damaged: 2, fault: 'disk full' };
  const answer = (standbys: string[]) => ({ ...server, sharing: { term: 1764000000, standbys }, program_cache: cache });
  await page.route('**/api/v1/server', (route) => route.fulfill({ json: answer([]) }));
  await page.reload();
  const part = page.getByRole('region', { name: 'Servers of the library' });
  await part.getByText('None: when this one is lost').waitFor();
  assert.ok(await part.getByRole('button', { name: 'Hand over' }).isDisabled());
  await part.getByText('3.0 MiB of 1.0 GiB').waitFor();
  await part.getByText('1,200 were there, 4 came from the database').waitFor();
  await part.getByRole('alert').getByText('disk full').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.unroute('**/api/v1/server');
  await page.route('**/api/v1/server', (route) => route.fulfill({ json: answer(['dncd 8 on srv-2']) }));
  await page.reload();
  await pressTwice(part.getByRole('button', { name: 'Hand over', exact: true }), part.getByRole('button', { name: 'Press again: hand the library over to dncd 8 on srv-2' }));
  await part.getByRole('alert').getByText(/is a SQLite file, which no other server can take over/).waitFor(); // what this server says of it
  await page.route('**/api/v1/server/drain', (route) => route.fulfill({ status: 202, json: { term: 1764000000, standbys: ['dncd 8 on srv-2'] } }));
  await pressTwice(part.getByRole('button', { name: 'Hand over', exact: true }), part.getByRole('button', { name: 'Press again: hand the library over to dncd 8 on srv-2' }));
  await part.getByText('Handed over to dncd 8 on srv-2').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints, [422]);
});

test('certificates and the release policy are shown', async () => {
  const { page, complaints } = await visit('#/administration/certificates');
  await page.getByText('Nothing is encrypted').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('link', { name: 'Release policy' }).click();
  await page.getByText('every revision that is not withdrawn').waitFor();
  await page.getByRole('row', { name: /Withdraw .*Draft, In review, Approved, Released .*Approver/ }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('a port is added by a template, and each of its settings is explained', async () => {
  const { page, complaints } = await visit('#/administration/ports');
  await page.getByText('Add a port').click();
  await page.getByLabel('Name').fill('line-3');
  await page.getByLabel('Machine').fill('mill-3');
  await page.getByLabel('Address').fill(control.address);
  await page.getByText(`dnc port doctor ${control.address}`).waitFor();
  await page.getByRole('combobox', { name: 'Template' }).selectOption('fanuc');
  await page.getByText('What each setting decides').click();
  await page.getByRole('row', { name: /^baud \d+ the template/ }).waitFor();
  await page.getByLabel(/Settings/).fill('eob = lf');
  await page.getByRole('row', { name: /^eob lf here/ }).waitFor();
  await page.getByLabel(/Settings/).fill('eob = lf\nspeed = 3');
  await page.getByText('No setting is called so: speed.').waitFor();
  await page.getByLabel(/Settings/).fill('eob = lf');
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('button', { name: 'Store and reopen the line' }).click();
  await page.locator('li.panel', { hasText: 'line-3' }).locator('.pill', { hasText: 'Open' }).waitFor();
  assertNoComplaints(complaints);
});

test('a program goes into the control\'s memory by an operator, and the transfer is followed', async () => {
  const { page, complaints } = await visit('#/administration/ports', { user: 'otto' });
  const card = page.locator('li.panel', { hasText: 'line-3' });
  await card.getByRole('button', { name: 'Control memory' }).click();
  await card.getByLabel('Programs to be sent, in this order').fill('O0300');
  assert.deepEqual(await findBarriers(page), []);
  await pressTwice(card.getByRole('button', { name: 'Send', exact: true }), card.getByRole('button', { name: 'Press again: send O0300 to mill-3' }));
  await card.getByText(/Sending|Sent/).first().waitFor();
  await control.punch('\x11'); // DC1: the control is ready
  await card.getByText('Sent', { exact: true }).waitFor();
  assert.match(control.text, /O0300/);
  assertNoComplaints(complaints);
});
