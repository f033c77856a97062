// An administrator looks after what comes in and goes out: hot folders with their files, and webhooks.
import assert from 'node:assert/strict';
import { mkdirSync, renameSync, writeFileSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';

const kHostile = '<img src=x onerror=alert(1)>';
let receiver: Server;
let received = 0;

const { shop, visit } = shopForTests(async (shop) => {
  await shop.addUser('paul', 'programmer', ['all']);
}, (shop) => {
  const folder = path.join(shop.folder, 'cam');
  mkdirSync(folder);
  const file = path.join(shop.folder, 'dncd.toml');
  writeFileSync(file, `[[folder]]\nname = "cam-mills"\npath = ${JSON.stringify(folder)}\ncontrol = "fanuc"\nunchanged_seconds = 1\npoll_seconds = 1\n`);
  return ['--config', file];
});
before(async () => {
  receiver = createServer((request, response) => {
    ++received;
    request.resume();
    response.writeHead(204).end();
  });
  await new Promise<void>((done) => receiver.listen(0, '127.0.0.1', done));
});
after(() => receiver.close());

/// As a post-processor should: complete by a rename.
function post(name: string, text: string): void {
  const hidden = path.join(shop.folder, 'cam', '.new');
  writeFileSync(hidden, text);
  renameSync(hidden, path.join(shop.folder, 'cam', name));
}

test('what became of the files of a hot folder is shown, with the reason of a refusal', async () => {
  const { page, complaints } = await visit('#/administration/folders', { user: 'paul' });
  const card = page.locator('li.panel', { hasText: 'cam-mills' });
  await card.locator('.pill', { hasText: 'Ready' }).waitFor();
  post('O0200.nc', 'O0200 (PLATE)\nG21 G90\nG1 X10. F100.\nM30\n');
  post(`${kHostile}.nc`, 'O0201\nM30\n');
  await card.getByText('1 stored, 1 refused.').waitFor();
  await card.getByRole('button', { name: 'Files' }).click();
  await card.getByRole('row', { name: /O0200\.nc Stored O0200 1/ }).waitFor();
  await card.getByRole('row', { name: /Refused/ }).getByText(`${kHostile}.nc`, { exact: true }).waitFor();
  assert.equal(await page.locator('main img').count(), 0);
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('a webhook is added, its secret is shown once, it is tested and removed', async () => {
  const { page, complaints } = await visit('#/administration/webhooks');
  await page.getByText('There is none yet.').waitFor();
  await page.locator('summary', { hasText: 'Add a webhook' }).click();
  await page.getByLabel('Name').fill('mes');
  await page.getByLabel('Address').fill(`http://127.0.0.1:${(receiver.address() as AddressInfo).port}/dripline`);
  await page.getByLabel('Alarms').uncheck();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('button', { name: 'Add a webhook' }).click();
  await page.getByText('Webhook mes: copy its secret now.').waitFor();
  const secret = (await page.locator('.secret').textContent())!;
  assert.ok(secret.length > 20);
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('button', { name: 'Done' }).click();
  await page.reload();
  const card = page.locator('li.panel', { hasText: 'mes' });
  await card.getByText('Runs, Imports, Jobs').waitFor();
  assert.equal(await page.getByText(secret).count(), 0);
  await card.getByRole('button', { name: 'Test mes' }).click();
  await card.getByText('The test event was taken.').waitFor();
  assert.ok(received > 0);
  await pressTwice(card.getByRole('button', { name: 'Remove' }), card.getByRole('button', { name: 'Press again: remove mes' }));
  await page.getByText('There is none yet.').waitFor();
  assertNoComplaints(complaints);
});

test('webhooks are the administrator\'s', async () => {
  const { page } = await visit('#/administration/webhooks', { user: 'paul' });
  await page.getByText('Your role is Programmer: this needs Administrator.').waitFor();
  assert.equal(await page.getByText('Add a webhook').count(), 0);
});

test('in German too', async () => {
  const { page } = await visit('#/administration/folders', { language: 'de-DE' });
  await page.getByText('1 gespeichert, 1 abgelehnt.').waitFor();
  assert.deepEqual(await findBarriers(page), []);
});
