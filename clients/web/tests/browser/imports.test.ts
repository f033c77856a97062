// What an operator changed at a control: it waits in the queue, is compared, accepted, accepted as another program, or rejected with a reason.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { LineControl } from './line_control';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';
import { until } from './shop';

const kHostile = '<IMG SRC=X ONERROR=ALERT>';
const program = (number: string, feed: number, to = 10) => `${number}(${kHostile})\nG21G90\nG1X${to}.F${feed}.\nY5.\nM30\n`;
let control: LineControl;

const { shop, visit } = shopForTests(async (shop) => {
  control = await LineControl.listen();
  await shop.api('PUT', 'ports/line-2', { machine: 'mill-2', address: control.address, template: 'fanuc' });
  await shop.push('O0200', program('O0200', 100), 'fanuc');
  await shop.addUser('vera', 'viewer');
});
after(() => control.end());

const waiting = async () => (await shop.api<{ imports: Array<{ class: string | null }> }>('GET', 'imports'))!.imports;

test('what a control sends is counted in the bar at once, and listed with its class', async () => {
  const { page, complaints } = await visit('#/imports');
  await page.getByText('Nothing waits.').waitFor();
  await control.punch(`%\n${program('O0200', 120)}%\n`);
  await page.getByRole('link', { name: 'Imports 1 waiting' }).waitFor();
  const row = page.getByRole('row', { name: /^O0200 2 mill-2/ });
  await row.getByText('feeds and speeds').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await row.getByRole('link').click();
  await page.getByText('The motion differs at 2 places').waitFor();
  await page.getByRole('button', { name: /feed.*G1X10/ }).click();
  await page.getByRole('heading', { name: 'Revision 1', level: 3 }).waitFor();
  await page.getByText(kHostile).first().waitFor();
  assert.equal(await page.locator('main img').count(), 0);
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('a viewer sees what waits and decides nothing', async () => {
  const { page } = await visit('#/imports/O0200/2', { user: 'vera' });
  await page.getByText('Your role is Viewer: this needs Approver.').waitFor();
  assert.ok(await page.getByRole('button', { name: 'Accept', exact: true }).isDisabled());
});

test('a revision is accepted with a comment, from the program as well', async () => {
  const { page, complaints } = await visit('#/programs/O0200/2');
  await page.getByRole('link', { name: 'What it changes' }).waitFor();
  await page.getByLabel('Comment or reason').fill('measured on the part');
  await pressTwice(page.getByRole('button', { name: 'Accept', exact: true }), page.getByRole('button', { name: 'Press again: accept O0200, revision 2' }));
  await page.getByRole('region', { name: 'State and approval' }).getByText('Draft').waitFor();
  await page.getByRole('link', { name: 'Imports', exact: true }).click();
  await page.getByRole('link', { name: 'Decided' }).click();
  await page.getByRole('row', { name: /O0200 2 .*Accepted.*admin.*measured on the part/ }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('another one becomes a revision of another program, and one is rejected for a reason', async () => {
  await control.punch(`%\n${program('O0200', 120, 11)}%\n`);
  await until('it waits and is compared', async () => (await waiting())[0]?.class === 'geometry');
  const { page } = await visit('#/imports/O0200/3');
  await page.locator('.machine-head').getByText('geometry').waitFor();
  await page.getByLabel('As another program').fill('O0201');
  await pressTwice(page.getByRole('button', { name: 'Accept', exact: true }), page.getByRole('button', { name: 'Press again: accept O0200, revision 3 as O0201' }));
  await page.getByText('Accepted as O0201, revision 1').waitFor();
  await control.punch(`%\n${program('O0200', 9999)}%\n`);
  await page.getByRole('link', { name: 'Imports 1 waiting' }).click();
  await page.getByRole('row', { name: /^O0200/ }).getByRole('link').click();
  await page.getByText('To reject it, state a reason.').waitFor();
  assert.ok(await page.getByRole('button', { name: 'Reject', exact: true }).isDisabled());
  await page.getByLabel('Comment or reason').fill('feed is too high');
  await pressTwice(page.getByRole('button', { name: 'Reject', exact: true }), page.getByRole('button', { name: /Press again: hide O0200/ }));
  await page.getByText('Rejected', { exact: true }).waitFor();
  await page.getByText('feed is too high').waitFor();
  await page.getByRole('link', { name: 'Imports', exact: true }).waitFor(); // nothing is counted any more
});

test('in German too', async () => {
  const { page } = await visit('#/imports/decided', { language: 'de-DE' });
  await page.getByRole('heading', { name: 'Programme von Maschinen' }).waitFor();
  await page.getByRole('row', { name: /O0200 .*Abgelehnt/ }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
});
