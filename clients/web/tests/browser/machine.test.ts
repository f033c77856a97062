// An operator's day at one machine: hold, resume, overrides, abort, start, an answer, the setup, a restart; and a server that is lost
// while a command is on its way.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Page } from 'playwright-core';
import { LineControl } from './line_control';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';
import { longProgram, until } from './shop';

const kHostileLine = '<script>alert(1)</script>';

const { shop, visit } = shopForTests(async (shop) => {
  await shop.startMachine('mill-1', { control: 'fanuc', description: 'Vertical' });
  await shop.startMachine('lathe-1', { control: 'centurion' });
  await shop.push('O0100', longProgram('O0100', 2000), 'fanuc');
  await shop.push('O0300', `O0300\nG20 G93 G98\nINPUT (<B>DIAMETER</B>) P1\nPOPEN P0\nDPRNT [${kHostileLine}]\nPCLOS\nM30\n`, 'centurion');
});

const state = (page: Page, word: string) => page.locator('.machine-head .pill', { hasText: word });

test('a program is started, held, continued, slowed down and aborted', async () => {
  const { page, complaints } = await visit('#/machine/mill-1');
  await page.getByLabel('Program', { exact: true }).fill('O0100');
  await pressTwice(page.getByRole('button', { name: 'Start', exact: true }), page.getByRole('button', { name: 'Press again: start O0100, revision 1, on mill-1' }));
  await state(page, 'Running').waitFor();
  const executing = page.locator('.blocks [aria-current="step"] .number');
  const first = await executing.textContent();
  await page.waitForFunction((old) => document.querySelector('.blocks [aria-current="step"] .number')?.textContent !== old, first);
  assert.match((await page.locator('.blocks [aria-current="step"] .text').textContent()) ?? '', /^N\d+ G1 X/);
  assert.match((await page.locator('.screen-blocks [aria-current="step"]').textContent()) ?? '', /^N\d+ G1 X/, 'as the gateway has it');
  await page.getByRole('button', { name: 'Feed hold' }).click();
  await state(page, 'Feed hold').waitFor();
  await page.getByText(/^Held by \S+ since /).waitFor();
  await page.getByRole('button', { name: 'Resume' }).click();
  await state(page, 'Running').waitFor();
  await page.getByText(/^Held by /).waitFor({ state: 'detached' });
  await page.getByRole('group', { name: 'Feed', exact: true }).getByRole('button', { name: 'Less' }).click();
  await page.getByRole('group', { name: 'Feed', exact: true }).getByText('90 %', { exact: true }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await pressTwice(page.getByRole('button', { name: 'Abort' }), page.getByRole('button', { name: 'Press again: abort O0100' }));
  await state(page, 'Stopped').waitFor();
  assertNoComplaints(complaints);
});

test('one press aborts nothing', async () => {
  const { page } = await visit('#/machine/mill-1');
  const id = await shop.start('mill-1', 'O0100');
  await state(page, 'Running').waitFor();
  await page.getByRole('button', { name: 'Abort' }).click();
  await page.getByRole('button', { name: 'Abort', exact: true }).waitFor(); // disarmed by itself
  assert.equal((await shop.api<{ state: string }>('GET', `runs/${id}`))?.state, 'active');
  await shop.api('POST', `runs/${id}/commands`, { action: 'abort' });
  await state(page, 'Stopped').waitFor();
});

test('a question of the control is answered, and what it prints is shown as text', async () => {
  const { page, complaints } = await visit('#/machine/lathe-1');
  await shop.start('lathe-1', 'O0300');
  const answer = page.getByLabel(/The control asks: <B>DIAMETER<\/B>/);
  await answer.fill('2.5');
  assert.deepEqual(await findBarriers(page), []);
  await answer.press('Enter');
  await page.locator('.records').getByText(kHostileLine).waitFor();
  await state(page, 'Completed').waitFor();
  assertNoComplaints(complaints);
});

test('a block is keyed in, named before it runs, and refused while a program runs', async () => {
  await shop.startMachine('mill-3', { control: 'tnc155', speed: 'max' });
  const { page, complaints } = await visit('#/machine/mill-3');
  const part = page.getByRole('region', { name: 'MDI' });
  await part.getByLabel('One block').fill('X+31.25 R0 F9000');
  await part.getByRole('button', { name: 'Run' }).click();
  assert.equal((await shop.api<{ runs: unknown[] }>('GET', 'runs?machine=mill-3'))?.runs.length, 0, 'one press runs nothing');
  await part.getByRole('button', { name: 'Run', exact: true }).waitFor(); // disarmed by itself
  await pressTwice(part.getByRole('button', { name: 'Run', exact: true }), part.getByRole('button', { name: 'Press again: X+31.25 R0 F9000 on mill-3' }));
  await page.locator('.position').getByText('31.250').first().waitFor();
  await part.getByRole('status').getByText(/without a tool: nothing has run since/).waitFor();
  await part.getByLabel('One block').fill('X+1 R0 F9000\nX+2 R0 F9000');
  await assert.rejects(part.getByRole('button', { name: 'Run' }).click({ timeout: 500 }), 'the control takes one');
  assert.deepEqual(await findBarriers(page), []);
  await part.getByLabel('One block').fill('FOO');
  await pressTwice(part.getByRole('button', { name: 'Run' }), part.getByRole('button', { name: 'Press again: FOO on mill-3' }));
  await page.locator('.machine-head .message').waitFor();
  assertNoComplaints(complaints);
});

test('a datum is set from the position, and the position is taken as a block', async () => {
  const { page, complaints } = await visit('#/machine/mill-3');
  const part = page.getByRole('region', { name: 'Set from the position' });
  await part.getByRole('button', { name: 'Position as a block' }).click();
  await page.waitForFunction(() => /^L X\+31\.250 Y\+0\.000 Z\+0\.000.* R0$/.test(document.querySelector<HTMLInputElement>('input[readonly]')?.value ?? ''));
  await part.getByLabel('Axis').selectOption('X');
  await part.getByLabel('The position becomes (mm)').fill('1,25');
  await pressTwice(part.getByRole('button', { name: 'Set', exact: true }), part.getByRole('button', { name: 'Press again: X = 1.25 mm on mill-3' }));
  await part.getByText('datum.X is 30.000 mm, it was 0.000').waitFor();
  await part.getByLabel('The position becomes (mm)').fill('about 3');
  assert.equal(await part.getByRole('button', { name: 'Set', exact: true }).isDisabled(), true);
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('link', { name: 'Memory' }).click();
  await page.getByText(/datum X 1\.25 mm/).waitFor();
  assertNoComplaints(complaints); // the next view asks for rules that this machine does not have
  await page.goto(`${shop.url}/#/corrections/mill-3`);
  await page.getByRole('region', { name: 'Set at the machine' }).getByText(/^datum\.X: 0\.000\s*mm → 30\.000\s*mm$/).waitFor();
  await shop.stopMachine('mill-3');
});

test('an axis is jogged by buttons that are enabled first, and a step is stopped', async () => {
  await shop.startMachine('mill-4', { control: 'fanuc' });
  const { page, complaints } = await visit('#/machine/mill-4');
  const part = page.getByRole('region', { name: 'Jog', exact: true });
  const plus = part.getByRole('button', { name: 'X +1 mm', exact: true });
  await part.getByLabel('Step').selectOption('1');
  assert.equal(await plus.isDisabled(), true, 'not enabled yet');
  await pressTwice(part.getByRole('button', { name: 'Enable the buttons' }), part.getByRole('button', { name: 'Press again: the buttons move mill-4' }));
  await plus.click();
  await part.getByRole('status').getByText('X 1 mm').waitFor();
  await page.locator('.position').getByText('1.000').first().waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await part.getByLabel('Feed').selectOption('0.1');
  await part.getByRole('button', { name: 'X −1 mm', exact: true }).click();
  await part.getByRole('button', { name: 'Stop', exact: true }).click();
  await part.getByRole('status').getByText(/^X \S+ mm, stopped by command/).waitFor();
  await shop.api('POST', 'machines/mill-4/commands', { action: 'switch', name: 'emergency_stop', value: 1 });
  await part.getByText(/the emergency stop is pressed/).waitFor();
  assert.equal(await plus.isDisabled(), true, 'and the reason is shown');
  assertNoComplaints(complaints);
  await shop.stopMachine('mill-4');
});

test('an aborted run is continued where it was', async () => {
  const { page } = await visit('#/machine/mill-1/runs');
  await page.getByText('Restart').first().click();
  await pressTwice(page.getByRole('button', { name: 'Restart' }).first(), page.getByRole('button', { name: 'Press again: restart O0100' }));
  await page.locator('.run').first().getByText('Running').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('link', { name: 'Now' }).click();
  await state(page, 'Waits for cycle start').waitFor();
  await page.getByRole('button', { name: 'Resume' }).click();
  await state(page, 'Running').waitFor();
});

test('a tool is added in the table, and a change that another one overtook is refused and shown', async () => {
  const { page } = await visit('#/machine/mill-1/setup');
  await page.getByRole('button', { name: 'Add a tool' }).click();
  await page.getByRole('textbox', { name: 'Text' }).fill('# by hand\n[[tool]]\nnumber = 1\nlength = 100.0\n');
  await page.getByLabel('Tools, row 1, length').fill('101.5');
  assert.equal(await page.getByRole('textbox', { name: 'Text' }).inputValue(), '# by hand\n[[tool]]\nnumber = 1\nlength = 101.5\n');
  await page.getByRole('button', { name: 'Store as a new revision' }).click();
  await page.getByText(/^Revision 1,/).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await shop.api('PUT', 'machines/mill-1/setup', '[[tool]]\nnumber = 7\n');
  await page.getByLabel('Tools, row 1, length').fill('102');
  await page.getByRole('button', { name: 'Store as a new revision' }).click();
  await page.getByText('admin has stored revision 2 meanwhile').waitFor();
  await page.getByRole('button', { name: /Continue with my text/ }).click();
  await page.getByRole('button', { name: 'Store as a new revision' }).click();
  await page.getByText(/^Revision 3,/).waitFor();
  await page.getByRole('button', { name: 'Compare' }).last().click();
  await page.getByText('From revision 1 to 3').waitFor();
});

test('which setup is in a control at the end of a line is said by anyone who loaded it', async () => {
  const control = await LineControl.listen();
  await shop.api('PUT', 'ports/line-5', { machine: 'mill-5', address: control.address, template: 'tnc155' });
  await shop.api('PUT', 'machines/mill-5/setup?control=tnc155', '[[tool]]\nnumber = 1\nlength = 100.0\n');
  const { page } = await visit('#/machine/mill-5/setup');
  const part = page.getByRole('region', { name: 'In the control' });
  await part.getByText('Which setup is in the control is not known.').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await pressTwice(part.getByRole('button', { name: 'Revision 1 is in the control' }), part.getByRole('button', { name: 'Press again: revision 1 has been loaded into the control of mill-5' }));
  await part.getByText(/^Revision 1 is in the control\. Said admin, /).waitFor();
  await shop.api('PUT', 'machines/mill-5/setup', '[[tool]]\nnumber = 1\nlength = 100.1\n');
  await page.reload();
  await part.getByText('Until the newest one is in it').waitFor();
  await part.getByRole('button', { name: 'It is not known any more' }).click();
  await part.getByText(/^Which setup is in the control is not known\. Said admin, /).waitFor();
  control.end();
});

test('a command whose answer is lost is reported and never sent again', async () => {
  const { page } = await visit('#/machine/mill-1');
  await state(page, 'Running').waitFor();
  const commands: string[] = [];
  page.on('request', (request) => { if (request.method() !== 'GET') commands.push(request.url()); });
  await shop.stopServer();
  await page.getByText(/Server lost since/).waitFor();
  await page.getByRole('button', { name: 'Feed hold' }).click();
  await page.getByRole('alert').getByText('may have been carried out').waitFor();
  await shop.startServer();
  await page.getByText('Live', { exact: true }).waitFor();
  await state(page, 'Running').waitFor();
  await until('the machine runs on', async () => (await shop.api<{ status: { execution: string } }>('GET', 'machines/mill-1'))?.status.execution === 'ACTIVE');
  assert.equal(commands.length, 1);
});

test('the path of a running program shows how far it is, and where the tool is', async () => {
  await shop.startMachine('mill-2', { control: 'fanuc' });
  const { page, complaints } = await visit('#/machine/mill-2');
  await shop.start('mill-2', 'O0100');
  const panel = page.locator('section[data-executed]');
  await page.locator('section[data-executed][data-complete=true]').waitFor();
  const first = Number(await panel.getAttribute('data-executed'));
  await page.waitForFunction((old) => Number(document.querySelector('section[data-executed]')?.getAttribute('data-executed')) > old + 3, first);
  await page.locator('.tool-mark').waitFor();
  // The executing line and the place on the path are of one status.
  const [line, point] = await page.evaluate(() => [
    Number(document.querySelector('.blocks [aria-current="step"] .number')?.textContent), Number(document.querySelector('section[data-executed]')?.getAttribute('data-executed'))]);
  assert.ok(Math.abs(line! - 3 - point!) <= 1, `line ${line} is executed, ${point} points are past`); // the first move is in line 3
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('region', { name: 'Tool path' }).getByRole('link', { name: 'Open' }).click();
  await page.getByRole('heading', { name: 'Tool path of O0100' }).waitFor();
  assertNoComplaints(complaints);
});

test('a lathe shows X as a diameter, in the unit of its program', async () => {
  const { page, complaints } = await visit('#/machine/lathe-1');
  await page.getByRole('heading', { name: 'Position (inch)' }).waitFor();
  await page.getByRole('rowheader', { name: 'X ⌀ diameter' }).waitFor();
  await shop.push('O0310', 'O0310\nG21 G93 G98\nG0 X30. Z-2.\nM0\nM30\n', 'centurion');
  await shop.start('lathe-1', 'O0310');
  await state(page, 'Program stop').waitFor();
  await page.getByRole('heading', { name: 'Position (mm)' }).waitFor();
  await page.locator('.position').getByRole('cell', { name: '30.000', exact: true }).first().waitFor();
  const position = (await shop.api<{ status: { position: { X: number } } }>('GET', 'machines/lathe-1'))!.status.position;
  assert.equal(position.X, 15, 'the API has the radius');
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});

test('a start in the middle has the options of its machine: memory and pass at a gateway, skipped words on a line', async () => {
  await shop.startMachine('lathe-3', { control: 'centurion' });
  await shop.push('O0320', `O0320\nG20 G93 G98\n${Array.from({ length: 200 }, (_, i) => `N${(i + 1) * 10} G1 X${i % 2} F2.`).join('\n')}\nM30\n`, 'centurion');
  const control = await LineControl.listen();
  await shop.api('PUT', 'ports/line-9', { machine: 'mill-9', address: control.address, template: 'fanuc' });
  const { page, complaints } = await visit('#/machine/lathe-3');
  await page.getByLabel('Program', { exact: true }).fill('O0320');
  assert.equal(await page.getByLabel('Memory for the skipped part').count(), 0);
  await page.getByLabel(/^From/).fill('N1000');
  await page.getByRole('combobox', { name: 'Memory for the skipped part' }).selectOption('now');
  await page.getByLabel('Pass').fill('1');
  assert.deepEqual(await findBarriers(page), []);
  const [request] = await Promise.all([
    page.waitForRequest((one) => one.method() === 'POST' && one.url().endsWith('/runs')),
    pressTwice(page.getByRole('button', { name: 'Start', exact: true }), page.getByRole('button', { name: 'Press again: start O0320, revision 1, on lathe-3 from N1000' })),
  ]);
  assert.deepEqual(request.postDataJSON(), { machine: 'lathe-3', program: 'O0320', revision: 1, from: 'N1000', memory: 'now', pass: 1 });
  await until('it has begun', async () => (await shop.api<{ runs: Array<{ state: string }> }>('GET', 'runs?machine=lathe-3'))?.runs[0]?.state === 'active');
  await page.goto(`${shop.url}/#/machine/mill-9`);
  await page.getByLabel(/^From/).fill('N1000');
  await page.getByRole('combobox', { name: /^Skipped words/ }).selectOption('send');
  assert.deepEqual(await findBarriers(page), []);
  await control.end();
  assertNoComplaints(complaints);
});

test('a control that does not search through a program is offered no start in the middle, and one that does no place that it lacks', async () => {
  await shop.startMachine('mill-8', { control: 'fanuc' });
  await shop.startMachine('mill-10', { control: 'tnc155' });
  const { page, complaints } = await visit('#/machine/mill-8');
  await page.getByText('This control does not search through a program: a run begins at the beginning.').waitFor();
  assert.equal(await page.getByLabel(/^From/).count(), 0);
  await page.goto(`${shop.url}/#/machine/mill-10`);
  const from = page.getByLabel(/^From/);
  assert.equal(await from.getAttribute('placeholder'), 'N120 (block)');
  await from.fill('T3');
  await page.getByText('“T3” is no place that this machine goes to. It has: N120 (block).').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await from.fill('N400');
  await page.getByText('The control searches the program up to the block, without motion.').waitFor();
  assert.equal(await page.getByLabel('Pass').count(), 1);
  assert.equal(await page.getByLabel('Memory for the skipped part').count(), 0);
  assertNoComplaints(complaints);
});

test('what the variables and outputs of a control are now is shown while its program runs', async () => {
  await shop.startMachine('lathe-9', { control: 'centurion' });
  await shop.push('O0990', 'O0990\nP10=7.5\nSET X 3\nM0\nP10=9\nM30\n', 'centurion');
  const run = await shop.start('lathe-9', 'O0990');
  const { page, complaints } = await visit('#/machine/lathe-9/memory');
  await page.getByText('Outputs: X 3 on').waitFor();
  await page.getByLabel('Names that begin with').fill('P1');
  await page.getByRole('row', { name: 'P10 7.5' }).waitFor();
  await shop.api('POST', `runs/${run}/commands`, { action: 'resume' });
  await page.getByRole('row', { name: 'P10 9' }).first().waitFor();
  assert.deepEqual(await findBarriers(page), []);
  assertNoComplaints(complaints);
});
