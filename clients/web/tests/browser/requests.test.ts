// What the page asks for it asks for once: with a filter beside a page of a list, with another revision, with a queue; and nothing for what is not opened.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Page, Request } from 'playwright-core';
import { addMeasuringLathe, makePart } from './measured_shop';
import { shopForTests, type Visit } from './page';

const kParts = 101; // more than a page

const { shop, visit } = shopForTests(async (shop) => {
  await addMeasuringLathe(shop);
  await shop.startMachine('mill-1', { control: 'fanuc', speed: 'max' });
  await shop.startMachine('mill-2', { control: 'fanuc', speed: 'max' });
  await shop.push('O0200', 'O0200 (PLATE)\nG21 G90\nG1 X10. F6000.\nM30\n', 'fanuc');
  await shop.push('O0210', 'O0210\nG21 G90\nM98 P200\nM30\n', 'fanuc');
  await shop.push('O0210', 'O0210\nG21 G90\nG1 X1. F100.\nM30\n', 'fanuc');
  await makePart(shop, { length: 1.02, diameter: 2.0, more: 'LOAD 3' });
});

/// The requests from here on that go to `path`, as the part after it.
function requestsOf(page: Page, path: string): string[] {
  const seen: string[] = [];
  page.on('request', (request: Request) => {
    const url = new URL(request.url());
    if (request.method() === 'GET' && url.pathname === `/api/v1/${path}`) seen.push(url.search);
  });
  return seen;
}

/// Nothing more is asked for, and all is answered: what an event causes comes within the page's quarter of a second. A busy computer takes longer to
/// ask and to answer, so that the second begins again with every request.
async function isQuiet({ page, requests }: Visit): Promise<void> {
  const kQuietMs = 1000;
  for (let asked = -1; asked !== requests.asked || requests.waiting > 0;) {
    asked = requests.asked;
    await page.waitForTimeout(kQuietMs);
  }
}

/// Answers a list as if it were longer than a page.
async function answerPages(page: Page, path: string, name: string): Promise<void> {
  await page.route(`**/api/v1/${path}?**`, async (route) => {
    const answer = (await (await route.fetch()).json()) as Record<string, Array<{ id: number }>>;
    const [one] = answer[name]!;
    const rows = one === undefined ? [] : Array.from({ length: kParts - 1 }, (_, id) => ({ ...one, id: id + 1 }));
    await route.fulfill({ json: { [name]: rows } });
  });
}

test('parts are asked for once when a filter is chosen on a later page', async () => {
  const opened = await visit('#/measurements/parts');
  const { page } = opened;
  await answerPages(page, 'parts', 'parts');
  await page.reload();
  await page.getByRole('button', { name: 'Older' }).click();
  await isQuiet(opened);
  const seen = requestsOf(page, 'parts');
  await page.getByRole('group', { name: 'Verdict' }).getByRole('button', { name: 'Scrap' }).click();
  await isQuiet(opened);
  assert.deepEqual(seen, ['?verdict=scrap&limit=100&offset=0']);
});

test('findings are asked for once when a machine is chosen on a later page', async () => {
  const opened = await visit('#/measurements/findings');
  const { page } = opened;
  await answerPages(page, 'report-findings', 'findings');
  await page.reload();
  await page.getByRole('button', { name: 'Older' }).click();
  await isQuiet(opened);
  const seen = requestsOf(page, 'report-findings');
  await page.getByRole('combobox', { name: 'Machine' }).selectOption('lathe-3');
  await isQuiet(opened);
  assert.deepEqual(seen, ['?machine=lathe-3&limit=100&offset=0']);
});

test('decided corrections are asked for once when another outcome is chosen on a later page', async () => {
  const opened = await visit('#/corrections');
  const { page } = opened;
  await page.route('**/api/v1/offsets?state=applied**', (route) => route.fulfill({
    json: { offsets: Array.from({ length: 50 }, (_, id) => ({
      id: id + 1, machine: 'lathe-3', rule: 'length', target: 'T3.wear.Z', unit: 'in', old_value: 0, new_value: 0.01, base: 1, state: 'applied', used: 3, left_out: 0, mean: 0.01,
      first: 1, last: 3, reasons: [], created: '2026-11-23T12:00:00Z', decided: '2026-11-23T12:00:00Z', who: 'vera', comment: null, automatic: false, setup: 2,
    })) },
  }));
  await page.reload();
  await page.getByRole('button', { name: 'Older' }).click();
  await isQuiet(opened);
  const seen = requestsOf(page, 'offsets');
  await page.getByRole('button', { name: 'Rejected' }).click();
  await isQuiet(opened);
  assert.deepEqual(seen, ['?state=rejected&limit=50&offset=0']);
});

test('what a revision calls is asked for once, and that of another is never shown as its own', async () => {
  const opened = await visit('#/programs/O0210/1');
  const { page } = opened;
  const calls = page.getByRole('region', { name: 'Called programs' });
  await calls.getByRole('link', { name: 'O0200' }).waitFor();
  await calls.getByRole('combobox').selectOption('mill-1'); // a choice that is of this revision
  await isQuiet(opened);
  const seen = requestsOf(page, 'programs/O0210/closure');
  let answer: () => void = () => {};
  await page.route('**/closure?revision=2**', async (route) => {
    await new Promise<void>((done) => { answer = done; });
    await route.continue();
  });
  await page.goto(`${shop.url}/#/programs/O0210/2`);
  await page.locator('.machine-head', { hasText: 'Revision 2' }).waitFor();
  await page.waitForTimeout(1000); // the answer is held back
  assert.equal(await calls.getByRole('link', { name: 'O0200' }).count(), 0, 'the calls of revision 1');
  answer();
  await calls.getByText('It calls no other program.').waitFor();
  assert.deepEqual(seen, ['?revision=2']);
});

test('groups of machines are asked for when a form that has them is opened, and once', async () => {
  const opened = await visit();
  const { page } = opened;
  const seen = requestsOf(page, 'machine-groups');
  for (const [place, button] of [['#/programs', /^Filter/], ['#/programs/O0200', /^Change/], ['#/account', 'Make a token'], ['#/administration/users', 'Add a user']] as const) {
    await page.goto(`${shop.url}/${place}`);
    await page.locator('summary').getByText(button).first().waitFor();
    await isQuiet(opened);
    seen.length = 0;
    await page.reload();
    await page.locator('summary').getByText(button).first().waitFor();
    await isQuiet(opened);
    const before = seen.length;
    await page.locator('summary').getByText(button).first().click();
    await isQuiet(opened);
    assert.deepEqual([before, seen.length - before], [0, 1], place);
  }
});

test('a queue is asked for once, and again when it or a run of its machine has changed', async () => {
  const opened = await visit('#/machine/mill-1/queue');
  const { page } = opened;
  await isQuiet(opened);
  const seen = requestsOf(page, 'machines/mill-1/jobs');
  await page.reload();
  await page.getByText('Nothing waits for this machine.').waitFor();
  await page.waitForTimeout(6000); // it is not asked for again and again
  assert.deepEqual(seen, ['?limit=1000']);
  seen.length = 0;
  await shop.start('mill-2', 'O0200');
  await makePart(shop, { length: 1, diameter: 2 });
  await isQuiet(opened);
  assert.deepEqual(seen, [], 'runs of other machines');
  await shop.api('POST', 'machines/mill-2/jobs', { program: 'O0200' });
  await shop.api('POST', 'machines/mill-1/jobs', { program: 'O0200', quantity: 3 });
  await page.getByText('0 of 3 parts').waitFor();
  await isQuiet(opened);
  assert.deepEqual(seen, ['?limit=1000']);
  await shop.api('PUT', 'machines/mill-1/job-hold', { reason: 'fixture is cracked' });
  await page.getByText('fixture is cracked').first().waitFor();
});
