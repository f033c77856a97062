// A quality engineer's day: parts with their verdicts, values with their chart, what was not understood; and a correction that is approved.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { addMeasuringLathe, kHostile, makePart } from './measured_shop';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';
import { until } from './shop';

let run = '';

const { shop, visit } = shopForTests(async (shop) => {
  await addMeasuringLathe(shop);
  await makePart(shop, { length: 1.001, diameter: 2.0 });
  await makePart(shop, { length: 1.004, diameter: 2.011 });
  run = await makePart(shop, { length: 1.02, diameter: 2.001, more: kHostile });
  await shop.addUser('paul', 'programmer', ['all']);
  await shop.addUser('vera', 'approver', ['all']);
  await until('a correction is proposed', async () => (await shop.api<{ offsets: unknown[] }>('GET', 'offsets?state=pending'))?.offsets.length === 1);
});

test('parts are listed with their verdicts, a new one at once', async () => {
  const { page, complaints } = await visit('#/measurements/parts');
  await page.getByRole('row', { name: /Scrap lathe-3 O0900/ }).waitFor();
  await page.getByRole('row', { name: /Rework lathe-3/ }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('group', { name: 'Verdict' }).getByRole('button', { name: 'Good' }).click();
  await page.getByRole('row', { name: /Scrap/ }).waitFor({ state: 'detached' });
  const before = await page.getByRole('row', { name: /Good lathe-3/ }).count();
  await makePart(shop, { length: 1.003, diameter: 2.0 });
  await page.waitForFunction((count) => document.querySelectorAll('tbody tr').length === count + 1, before);
  assertNoComplaints(complaints);
});

test('a part has every value with its limits, and its findings; it is exported', async () => {
  const { page, complaints } = await visit(`#/reports/${run}`);
  const parts = page.getByRole('region', { name: 'Parts' });
  await parts.first().getByRole('link', { name: /^Part/ }).click();
  await page.locator('.machine-head .pill', { hasText: 'Scrap' }).waitFor();
  await page.getByRole('row', { name: /^L 1\.0200.inch \+0\.0200.inch Scrap 1\.0000.inch 0\.9900 … 1\.0100 T3/ }).waitFor();
  await page.getByText('1 not good').waitFor();
  await page.getByRole('region', { name: 'Findings' }).getByText(kHostile).waitFor();
  assert.equal(await page.locator('main img').count(), 0);
  assert.deepEqual(await findBarriers(page), []);
  const [file] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'CSV' }).click()]);
  assert.match(readFileSync((await file.path())!, 'utf8'), /1\.02/);
  assertNoComplaints(complaints);
});

test('a characteristic has a chart, of each kind, and the values fit the choices', async () => {
  const { page, complaints } = await visit('#/measurements');
  await page.getByText('8 values').waitFor();
  await page.getByRole('combobox', { name: 'Characteristic' }).selectOption('L');
  const chart = page.getByRole('img', { name: /^Individuals of L/ });
  await chart.waitFor();
  assert.ok(await chart.evaluate((image: HTMLImageElement) => image.decode().then(() => image.naturalWidth > 100)));
  await page.getByText('4 values', { exact: true }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('combobox', { name: 'Chart' }).selectOption('histogram');
  await page.getByRole('img', { name: /^Histogram of L/ }).waitFor();
  await page.getByRole('combobox', { name: 'Verdict' }).selectOption('scrap');
  await page.getByText('1 value', { exact: true }).waitFor();
  await page.getByLabel('To', { exact: true }).fill('2020-01-01T00:00');
  await page.getByLabel('To', { exact: true }).press('Tab');
  await page.getByText('Nothing fits these choices.').waitFor();
  await page.reload();
  await page.getByText('Nothing fits these choices.').waitFor();
  assertNoComplaints(complaints, [400, 404, 409, 413, 422]);
});

test('what was not understood is listed as text', async () => {
  const { page, complaints } = await visit('#/measurements/findings');
  await page.getByRole('row', { name: new RegExp('Not known') }).getByText(kHostile).waitFor();
  assert.equal(await page.locator('main img').count(), 0);
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('a correction that waits is counted, explained, and approved by who may', async () => {
  const { page: programmers } = await visit('#/corrections', { user: 'paul' });
  await programmers.getByText('Your role is Programmer: this needs Approver.').waitFor();
  assert.ok(await programmers.getByRole('button', { name: 'Approve', exact: true }).isDisabled());
  const { page, complaints } = await visit('#/measurements', { user: 'vera' });
  await page.getByRole('link', { name: 'Reports 1 waiting' }).waitFor();
  await page.getByRole('link', { name: 'Corrections (1)' }).click();
  await page.getByRole('heading', { name: 'T3.wear.Z lathe-3' }).waitFor();
  assert.ok((await page.getByRole('list', { name: 'Reasons' }).getByRole('listitem').count()) > 0);
  assert.ok(await page.getByRole('button', { name: 'Reject', exact: true }).isDisabled());
  assert.deepEqual(await findBarriers(page), []);
  await page.getByLabel('Comment or reason').fill('checked with a gauge');
  await pressTwice(page.getByRole('button', { name: 'Approve', exact: true }), page.getByRole('button', { name: /Press again: T3\.wear\.Z of lathe-3 becomes/ }));
  await page.getByText('No correction waits.').waitFor();
  await page.getByRole('row', { name: /T3\.wear\.Z lathe-3 .*vera checked with a gauge/ }).getByRole('link').click();
  await page.getByRole('row', { name: /T3\.wear\.Z .*setup 2 vera/ }).waitFor();
  await page.getByRole('row', { name: /setup 1 .*2 of 4/ }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await programmers.getByText('No correction waits.').waitFor();
  assertNoComplaints(complaints);
});

test('rules are evaluated with reasons in words, and changed by who may', async () => {
  const { page } = await visit('#/corrections/lathe-3', { user: 'vera' });
  await page.getByRole('button', { name: 'Evaluate now' }).click();
  await page.getByRole('status').locator('.reasons li').first().waitFor();
  await page.getByText('Change the rules').click();
  const rules = page.getByLabel('Rules (TOML)');
  await rules.fill((await rules.inputValue()).replace('min_count = 3', 'min_count = 0'));
  await page.getByRole('button', { name: 'Store as a new version' }).click();
  await page.getByRole('alert').waitFor();
  await rules.fill((await rules.inputValue()).replace('min_count = 0', 'min_count = 5').replace('window = 3', 'window = 5'));
  await page.getByRole('button', { name: 'Store as a new version' }).click();
  await page.getByText(/Version 2, vera/).waitFor();
  assert.deepEqual(await findBarriers(page), []);
});

test('in German too', async () => {
  const { page } = await visit('#/measurements/parts', { language: 'de-DE' });
  await page.getByRole('row', { name: /Ausschuss/ }).waitFor();
  await page.getByRole('link', { name: 'Korrekturen' }).click();
  await page.getByRole('heading', { name: 'Warten auf Entscheidung' }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
});

test('a characteristic has its capability with intervals, and a gauge study that says what it needs', async () => {
  for (const length of [1.002, 1.0, 0.999, 1.001]) await makePart(shop, { length, diameter: 2.0 });
  const { page, complaints } = await visit('#/measurements?characteristic=L');
  const study = page.getByRole('region', { name: 'Capability' });
  await study.getByText('Cpk', { exact: true }).waitFor();
  const { cpk } = (await shop.api<{ cpk: { value: number; low: number; high: number } }>('GET', 'measurements/capability?characteristic=L'))!;
  const two = (value: number) => value.toLocaleString('en', { minimumFractionDigits: 2, maximumFractionDigits: 2 });
  await study.getByText(`${two(cpk.value)} (${two(cpk.low)} to ${two(cpk.high)})`).first().waitFor();
  await page.getByText('Gauge study (R&R)').click();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('button', { name: 'Compute' }).click();
  await page.getByRole('alert').getByText(/appraiser/).waitFor();
  await study.getByRole('combobox', { name: 'Distribution' }).selectOption('empirical');
  await study.getByText('Fewer than 741 values').waitFor();
  assert.equal(await study.getByText('Cpk', { exact: true }).count(), 0);
  await page.reload();
  await study.getByText('Fewer than 741 values').waitFor();
  assertNoComplaints(complaints, [413]);
});

test('a gauge study of two machines has its components', async () => {
  const { page } = await visit('#/measurements?characteristic=L');
  const component = { deviation: 0.00123, study_percent: 12.3, contribution_percent: 1.5 };
  await page.route('**/api/v1/measurements/gauge?**', (route) => {
    assert.match(route.request().url(), /characteristic=L.*method=ranges&tolerance=0\.02/);
    return route.fulfill({ json: { repeatability: component, reproducibility: component, gauge: { ...component, study_percent: 17.4 }, parts: component, total: 0.01, distinct_categories: 8, tolerance_percent: 22.1, interaction_kept: false } });
  });
  await page.getByText('Gauge study (R&R)').click();
  await page.getByRole('combobox', { name: 'Method' }).selectOption('ranges');
  await page.getByLabel('Width of the tolerance').fill('0.02');
  await page.getByRole('button', { name: 'Compute' }).click();
  await page.getByRole('row', { name: 'Gauge R&R 0.00123 17.4 % 1.5 %' }).waitFor();
  await page.getByText('8 distinct categories. Gauge R&R is 22.1 % of the tolerance.').waitFor();
  assert.deepEqual(await findBarriers(page), []);
});

test('measurements are saved as files for quality systems and for people', async () => {
  const { page, complaints } = await visit('#/measurements?characteristic=L');
  await page.getByText('More formats').click();
  assert.deepEqual(await findBarriers(page), []);
  const save = async (button: string) => {
    const [file] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: button }).click()]);
    return { name: file.suggestedFilename(), text: readFileSync((await file.path())!, 'latin1') };
  };
  const dfq = await save('AQDEF (.dfq)');
  assert.equal(dfq.name, 'L.dfq');
  assert.match(dfq.text, /^K0100 \d+\r\n/);
  assert.match((await save('QIF 3.0')).text, /<QIFDocument/);
  assert.match((await save('Part report')).text, /^<!DOCTYPE html>/i);
  await page.getByRole('button', { name: 'Points (CSV)' }).click();
  await page.getByRole('alert').getByText(/X, Y or Z/).waitFor();
  assertNoComplaints(complaints, [404]);
});

test('a run shows the offsets in force, and a value what was cut under it', async () => {
  const { page, complaints } = await visit(`#/reports/${run}`);
  await page.locator('summary', { hasText: 'Tools and offsets in force' }).click();
  await page.getByText(/^In force at every block of the run, 1 to \d+\. Setup 1 of the machine\.$/).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('row', { name: /T3\.wear\.Z 0\.00000.in/ }).getByRole('link').click();
  await page.getByRole('heading', { name: 'Tools and offsets of lathe-3' }).waitFor();
  const cell = page.getByRole('row', { name: /setup 1 / }).getByRole('button', { name: /of \d+$/ });
  await cell.click();
  const cut = page.getByRole('region', { name: /^Cut under T3\.wear\.Z/ }).first();
  await cut.getByRole('row', { name: /Scrap lathe-3/ }).first().waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await cut.getByRole('button', { name: 'Close' }).click();
  await cut.waitFor({ state: 'detached' });
  assertNoComplaints(complaints);
});
