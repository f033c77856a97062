// Report templates: one is written, tried on a run line by line, stored, assigned; and what a viewer sees of it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { addMeasuringLathe, kHostile, makePart } from './measured_shop';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';

let run = '';

const { shop, visit } = shopForTests(async (shop) => {
  await addMeasuringLathe(shop);
  run = await makePart(shop, { length: 1.02, diameter: 2.001, more: kHostile });
  await shop.addUser('paul', 'programmer', ['all']);
  await shop.addUser('vera', 'viewer');
});

test('templates are listed with what they are for', async () => {
  const { page, complaints } = await visit('#/measurements/findings');
  await page.getByRole('link', { name: 'Templates' }).click();
  await page.getByRole('row', { name: /^shaft 1 Program O0900 admin/ }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('link', { name: 'shaft' }).click();
  await page.getByRole('heading', { name: 'shaft', level: 1 }).waitFor();
  await page.getByRole('link', { name: 'Program O0900' }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('a text is tried on a run before it is stored, line by line', async () => {
  const { page, complaints } = await visit('#/templates/shaft', { user: 'paul' });
  await page.getByRole('button', { name: 'Try it' }).click();
  await page.getByText('3 lines, 1 not understood, 2 measurements').waitFor();
  const lines = page.getByRole('region', { name: 'Try it on a run' }).getByRole('row');
  await lines.filter({ hasText: 'L 1.0200' }).getByText('L = 1.02 inch: Scrap').waitFor();
  await lines.filter({ hasText: kHostile }).getByText('not understood').waitFor();
  assert.equal(await page.locator('main img').count(), 0);
  assert.deepEqual(await findBarriers(page), []);
  await page.getByLabel('Only lines that are not understood').check();
  await lines.filter({ hasText: 'L 1.0200' }).waitFor({ state: 'detached' });
  const text = page.getByRole('textbox', { name: 'Text of the template (TOML)' });
  await text.fill(`${await text.inputValue()}[[line]]\npattern = '<img .*'\nignore = true\n`);
  await page.getByText('The text was changed since: try it again.').waitFor();
  await page.getByRole('button', { name: 'Try it' }).click();
  await page.getByText(/3 lines, 0 not understood/).waitFor();
  await page.getByText('Every line was understood.').waitFor();
  assert.equal((await shop.api<{ version: number }>('GET', 'report-templates/shaft'))!.version, 1, 'nothing was stored');
  await text.fill('[[line]]\n');
  await page.getByRole('button', { name: 'Try it' }).click();
  await page.getByRole('alert').getByText('line 1').waitFor();
  assertNoComplaints(complaints, [400]);
});

test('a new version is stored, compared, and one of another user between is named', async () => {
  const { page } = await visit('#/templates/shaft', { user: 'paul' });
  const text = page.getByRole('textbox', { name: 'Text of the template (TOML)' });
  await page.waitForFunction(() => (document.querySelector('textarea')?.value ?? '').length > 20);
  const before = await text.inputValue();
  await text.fill(`${before}# second\n`);
  await page.getByRole('button', { name: 'Store as a new version' }).click();
  await page.getByText('Stored as version 2.').waitFor();
  await page.getByText(/^Version 2, paul/).waitFor();
  await shop.api('PUT', 'report-templates/shaft', `${before}# of another user\n`);
  await text.fill(`${before}# third\n`);
  await page.getByRole('button', { name: 'Store as a new version' }).click();
  await page.getByText(/^Stored as version 4\. Versions after 2/).waitFor();
  await page.getByRole('combobox', { name: 'Version' }).first().selectOption('3');
  await page.getByText('This is an older version; the newest is 4.').waitFor();
  assert.match(await page.getByLabel('Differences').first().innerText(), /− # of another user/);
  assert.deepEqual(await findBarriers(page), []);
});

test('a template is begun, assigned to a machine, taken back and removed', async () => {
  const { page, complaints } = await visit('#/templates', { user: 'paul' });
  await page.getByText('Make a template').click();
  await page.getByLabel('Template', { exact: true }).fill('load');
  await page.getByRole('button', { name: 'Begin' }).click();
  await page.getByText('Nothing is stored under this name yet.').waitFor();
  await page.getByRole('textbox', { name: 'Text of the template (TOML)' }).fill("[[line]]\nform = 'LOAD {actual}'\ncharacteristic = 'load'\n");
  await page.getByRole('button', { name: 'Store as a new version' }).click();
  await page.getByText('It is for nothing yet').waitFor();
  await page.getByRole('combobox', { name: 'For', exact: true }).selectOption('machine');
  await page.getByLabel('Name', { exact: true }).fill('lathe-3');
  await page.getByRole('button', { name: 'Assign' }).click();
  await page.getByRole('link', { name: 'Machine lathe-3' }).waitFor();
  const assigned = (await shop.api<{ assignments: Array<{ scope: string; template: string }> }>('GET', 'report-template-assignments'))!.assignments;
  assert.ok(assigned.some(({ scope, template }) => scope === 'machine' && template === 'load'));
  assert.deepEqual(await findBarriers(page), []);
  await pressTwice(page.getByRole('button', { name: 'Take back' }), page.getByRole('button', { name: 'Press again: no longer for Machine lathe-3' }));
  await page.getByText('It is for nothing yet').waitFor();
  await pressTwice(page.getByRole('button', { name: 'Remove' }), page.getByRole('button', { name: /Press again: remove load/ }));
  await page.getByRole('row', { name: /^shaft/ }).waitFor();
  assert.equal(await page.getByRole('link', { name: 'load', exact: true }).count(), 0);
  assertNoComplaints(complaints, [404]);
});

test('a viewer tries and changes nothing; in German too', async () => {
  const { page } = await visit(`#/templates/shaft?run=${run}`, { user: 'vera', language: 'de-DE' });
  await page.getByText(/Rolle .*Betrachter|Rolle .*Programmierer/).first().waitFor();
  assert.ok(await page.getByRole('button', { name: 'Als neue Version speichern' }).isDisabled());
  assert.ok(await page.getByRole('button', { name: 'Zuordnen' }).isDisabled());
  await page.getByRole('button', { name: 'Erproben' }).click();
  await page.getByText('3 Zeilen, 1 nicht verstanden, 2 Messwerte').waitFor();
  assert.deepEqual(await findBarriers(page), []);
});
