// A programmer's day: programs are dropped, searched, read, compared, started and removed; their names and texts are hostile.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Page } from 'playwright-core';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';

const kHostile = '"><img src=x onerror=alert(1)>';

const { shop, visit } = shopForTests(async (shop) => {
  await shop.startMachine('mill-1', { control: 'fanuc' });
  await shop.push('O0666', 'O0666 (<script>alert(1)</script>)\nG21\nM30\n', 'fanuc', kHostile);
});

/// As a file manager does it: the browser makes the event, the page gets the file.
async function drop(page: Page, name: string, text: string): Promise<void> {
  const transfer = await page.evaluateHandle(([file, content]) => {
    const data = new DataTransfer();
    data.items.add(new File([content!], file!));
    return data;
  }, [name, text]);
  await page.dispatchEvent('[data-testid=drop]', 'drop', { dataTransfer: transfer });
}

test('a dropped file becomes a program, and again a revision', async () => {
  const { page, complaints } = await visit('#/programs');
  await drop(page, 'O0700.nc', 'O0700 (BRACKET)\nG21 G90\nG1 X10. F100.\nM30\n');
  await page.locator('.upload').getByText(/stored as revision 1|Upload again/).waitFor();
  if (await page.getByRole('button', { name: 'Upload again' }).isVisible()) { // two dialects could have written this text
    await page.locator('.upload').getByLabel('Control').selectOption('fanuc');
    await page.getByRole('button', { name: 'Upload again' }).click();
  }
  await page.getByText('is stored as revision 1.').waitFor();
  await page.getByRole('rowheader', { name: 'O0700' }).waitFor();
  await shop.push('O0700', 'O0700 (BRACKET)\nG21 G90\nG1 X12. F100.\nM30\n', 'fanuc');
  assertNoComplaints(complaints, [400, 409]);
  assert.deepEqual(await findBarriers(page), []);
});

test('a file of several pieces arrives whole', async () => {
  const { page } = await visit('#/programs');
  const lines = Array.from({ length: 250_000 }, (_, i) => `N${i + 1} G1 X${i}.5`).join('\n');
  await page.getByLabel('Choose files').setInputFiles({ name: 'O0800.nc', mimeType: 'text/plain', buffer: Buffer.from(`O0800\nG21 G90 G94 G17 G40 G49 G80\n${lines}\nM30\n`) });
  const row = page.locator('.upload');
  await row.getByText(/stored as revision 1|Upload again/).waitFor();
  if (await row.getByRole('button', { name: 'Upload again' }).isVisible()) {
    await row.getByLabel('Control').selectOption('fanuc');
    await row.getByRole('button', { name: 'Upload again' }).click();
  }
  await row.getByText('is stored as revision 1.').waitFor();
  await page.getByRole('rowheader', { name: 'O0800' }).getByRole('link').click();
  await page.getByText('N1 G1').first().waitFor();
  await page.getByRole('button', { name: 'Next part' }).click();
  await page.getByText(/Lines 2[\d,]+ to/).waitFor();
  const number = Number(await page.locator('.blocks .number').first().textContent());
  assert.equal(await page.locator('.blocks .text').first().textContent(), `N${number - 2} G1 X${number - 3}.5`);
});

test('names and texts that others wrote are shown and do nothing', async () => {
  const { page, complaints } = await visit('#/programs');
  await drop(page, `${kHostile}.nc`, 'O1\nM30\n');
  await page.locator('.upload .message', { hasText: kHostile }).waitFor(); // the server allows no such name, and says so
  await page.getByRole('searchbox').fill('onerror');
  await page.locator('.hit', { hasText: 'O0666' }).getByRole('link').click();
  await page.getByRole('heading', { name: 'O0666', level: 1 }).waitFor();
  await page.getByText(kHostile).waitFor();
  await page.getByText('(<script>alert(1)</script>)').first().waitFor();
  assert.equal(await page.locator('img, main script').count(), 0);
  assertNoComplaints(complaints, [400]);
});

test('revisions are compared, downloaded, and one is started on a machine', async () => {
  const { page, complaints } = await visit('#/programs/O0700');
  await page.getByLabel('Changes to revision 2 from').selectOption('1');
  await page.locator('.diff .added', { hasText: 'X12.' }).waitFor();
  await page.locator('.diff .removed', { hasText: 'X10.' }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  const [file] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Download' }).click()]);
  assert.equal(file.suggestedFilename(), 'O0700');
  await page.getByRole('link', { name: 'Revision 1' }).click();
  await page.getByText('X10.').first().waitFor();
  await page.getByLabel('Start on').selectOption('mill-1');
  await pressTwice(page.getByRole('button', { name: 'Start', exact: true }), page.getByRole('button', { name: 'Press again: start O0700, revision 1, on mill-1' }));
  await page.locator('.machine-head h1', { hasText: 'mill-1' }).waitFor();
  const { runs } = (await shop.api<{ runs: Array<{ program: string; revision: number }> }>('GET', 'runs'))!;
  assert.deepEqual([runs[0]?.program, runs[0]?.revision], ['O0700', 1]);
  assertNoComplaints(complaints);
});

test('what is wrong with a program is beside its lines, and a press on a finding goes there', async () => {
  const filler = Array.from({ length: 30_000 }, (_, i) => `N${i + 1} G1 X${i % 100}. Y${i % 90}.`).join('\n');
  await shop.push('O0900', `O0900\nG20 G90 F5.\nG1 X1. F5\n${filler}\nG1 X2. ZZ5.\nM30\n`, 'fanuc');
  const { page, complaints } = await visit('#/programs/O0900');
  const check = page.getByRole('region', { name: 'Check' });
  await check.getByText('The program raises an alarm.').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await check.getByRole('button', { name: /Alarm line 30,004/ }).click();
  const line = page.locator('.blocks li.alarm');
  await line.getByText('G1 X2. ZZ5.').waitFor();
  await line.getByText(/^Alarm \w+: /).waitFor();
  assert.equal(await line.locator('.number').textContent(), '■30004');
  await check.getByRole('button', { name: /Warning line 3/ }).click();
  await page.locator('.blocks li.warning').getByText('X1. F5').waitFor();
  await check.getByRole('row', { name: /^X / }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('a program is checked on the setup of the machine that is chosen', async () => {
  await shop.push('O0901', 'O0901\nG21 G90 G54\nG1 X10. F500.\nM30\n', 'fanuc');
  await shop.api('PUT', 'machines/mill-1/setup', '[[offset]]\nname = "G54"\nX = 500.0\n');
  const { page } = await visit('#/programs/O0901');
  const check = page.getByRole('region', { name: 'Check' });
  await check.getByText('The program reaches its end.').waitFor();
  assert.equal(await check.getByLabel('Setup of').inputValue(), 'mill-1', 'the only one of its control');
  await check.getByRole('row', { name: 'X 500.000 510.000' }).or(check.getByRole('row', { name: 'X 510.000 510.000' })).waitFor();
  await check.getByLabel('Setup of').selectOption('');
  await check.getByRole('row', { name: /^X .*10\.000$/ }).waitFor();
});

test('an opened program is checked once, and another revision is read once', async () => {
  await shop.push('O0902', 'O0902\nG21 G90 G54\nG1 X10. F500.\nM30\n', 'fanuc');
  await shop.push('O0902', 'O0902\nG21 G90 G54\nG1 X10. F500.\nG1 Y10.\nM30\n', 'fanuc');
  const { page } = await visit('#/programs/O0902');
  await page.getByText('The program reaches its end.').waitFor(); // nothing of this visit is on its way
  const asked: string[] = [];
  page.on('request', (request) => asked.push(request.url()));
  await page.reload();
  await page.getByText('The program reaches its end.').waitFor();
  assert.equal(asked.filter((url) => url.includes('/check?')).length, 1);
  await page.getByText('G1 Y10.').waitFor();
  asked.length = 0;
  await page.getByRole('link', { name: 'Revision 1', exact: true }).click();
  await page.getByText('G1 Y10.').waitFor({ state: 'detached' });
  assert.equal(asked.filter((url) => url.includes('/content?')).length, 1);
});

test('a program is copied and removed', async () => {
  const { page } = await visit('#/programs/O0800');
  await page.getByText('Copy, rename, remove').click();
  await page.getByLabel('New name').fill('O0801');
  await page.getByRole('button', { name: 'Copy', exact: true }).click();
  await page.getByRole('heading', { name: 'O0801', level: 1 }).waitFor();
  await page.getByText('Copy, rename, remove').click();
  await pressTwice(page.getByRole('button', { name: 'Remove' }), page.getByRole('button', { name: 'Press again: remove O0801 with 1 revisions' }));
  await page.getByRole('heading', { name: 'Programs', level: 1 }).waitFor();
  assert.equal(await shop.api('GET', 'programs/O0801'), null);
});
