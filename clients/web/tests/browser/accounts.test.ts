// Who uses the page: signing in and out, what each role sees and may do, a session that ends, users, groups, tokens.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Page } from 'playwright-core';
import { assertNoComplaints, findBarriers, pressTwice, shopForTests } from './page';
import { kPassword, longProgram } from './shop';

const { shop, visit } = shopForTests(async (shop) => {
  await shop.startMachine('mill-1', { control: 'fanuc' });
  await shop.startMachine('mill-2', { control: 'fanuc' });
  await shop.push('O0100', longProgram('O0100', 2000), 'fanuc');
  await shop.api('PUT', 'machine-groups/cell-1');
  await shop.api('PUT', 'machine-groups/cell-1/machines/mill-1');
  await shop.addUser('vera', 'viewer');
  await shop.addUser('otto', 'operator', ['cell-1']);
});

const storages = (page: Page) => page.evaluate(() => JSON.stringify([{ ...localStorage }, { ...sessionStorage }, document.cookie]));

async function signIn(page: Page, user: string, password: string): Promise<void> {
  await page.getByLabel('User', { exact: true }).fill(user);
  await page.getByLabel('Password', { exact: true }).fill(password);
  await page.getByRole('button', { name: 'Sign in', exact: true }).click();
}

test('the first administrator sets a password by the token of the state folder', async () => {
  const { page, complaints } = await visit('', { user: null });
  await page.getByText('First sign-in').click();
  await page.getByLabel('Token', { exact: true }).fill('wrong token');
  await page.getByLabel(/New password/).fill(kPassword);
  await page.getByRole('button', { name: 'Set the password and sign in' }).click();
  await page.getByRole('alert').getByText('This is not a token.').waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByLabel('Token', { exact: true }).fill(shop.token);
  await page.getByRole('button', { name: 'Set the password and sign in' }).click();
  await page.getByRole('link', { name: 'Open machine mill-1', exact: true }).waitFor();
  await page.getByRole('link', { name: 'admin Administrator' }).waitFor();
  assert.doesNotMatch(await storages(page), new RegExp(shop.token));
  assertNoComplaints(complaints, [401]);
});

test('a wrong password is refused, the right one opens the floor, and nothing that proves it can be read', async () => {
  const { page, complaints } = await visit('', { user: null });
  await signIn(page, 'otto', 'not the password');
  await page.getByRole('alert').waitFor();
  await signIn(page, 'otto', kPassword);
  await page.getByRole('link', { name: 'otto Operator' }).waitFor();
  assert.equal(await storages(page), '[{},{},""]');
  await page.reload();
  await page.getByRole('link', { name: 'otto Operator' }).waitFor();
  await page.getByText('Settings').click();
  await page.getByRole('button', { name: 'Sign out' }).click();
  await page.getByRole('button', { name: 'Sign in', exact: true }).waitFor();
  await page.reload();
  await page.getByRole('button', { name: 'Sign in', exact: true }).waitFor();
  assertNoComplaints(complaints, [401]);
});

test('a viewer sees everything and can command nothing, with the reason', async () => {
  const { page, complaints } = await visit('#/machine/mill-1', { user: 'vera' });
  await page.getByText('Your role is Viewer: this needs Operator.').first().waitFor();
  await page.getByLabel('Program', { exact: true }).isDisabled();
  for (const name of ['Software stop', 'Less', 'Start']) assert.ok(await page.getByRole('button', { name, exact: true }).first().isDisabled(), name);
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('link', { name: 'Programs' }).click();
  await page.getByText('Your role is Viewer: this needs Programmer.').waitFor();
  assert.ok(await page.getByRole('button', { name: 'Choose files' }).isDisabled());
  await page.getByRole('link', { name: 'Administration' }).click();
  await page.getByRole('link', { name: 'Users' }).click();
  await page.getByText('Your role is Viewer: this needs Administrator.').waitFor();
  await page.getByRole('link', { name: 'Audit trail' }).click();
  await page.getByText('Your role is Viewer: this needs Approver.').waitFor();
  assertNoComplaints(complaints);
});

test('an operator commands the machines of the own groups alone', async () => {
  const { page } = await visit('#/machine/mill-1', { user: 'otto' });
  await page.getByRole('button', { name: 'Less' }).first().waitFor();
  assert.ok(await page.getByRole('button', { name: 'Less' }).first().isEnabled());
  await page.goto(`${shop.url}/#/machine/mill-2`);
  await page.getByText('None of your groups has machine mill-2.').first().waitFor();
  assert.ok(await page.getByRole('button', { name: 'Less' }).first().isDisabled());
});

test('a session that ends keeps what was typed and repeats no command', async () => {
  await shop.addUser('paul', 'programmer', ['all']);
  const { page } = await visit('#/machine/mill-1/setup', { user: 'paul' });
  await page.getByRole('textbox', { name: 'Text' }).fill('# typed for an hour\n');
  // The session ends while the command is on its way.
  let hasEnded = false;
  await page.route('**/machines/mill-1/setup?*', async (route) => {
    if (route.request().method() === 'PUT' && !hasEnded) {
      hasEnded = true;
      const { tokens } = (await shop.api<{ tokens: Array<{ name: string }> }>('GET', 'users/paul/tokens'))!;
      for (const { name } of tokens) await shop.api('DELETE', `users/paul/tokens/${name}`);
    }
    await route.continue();
  });
  const commands: string[] = [];
  page.on('request', (request) => { if (request.method() !== 'GET') commands.push(new URL(request.url()).pathname); });
  await page.getByRole('button', { name: 'Store as a new revision' }).click();
  const dialog = page.getByRole('dialog', { name: 'Your session has ended' });
  await dialog.waitFor();
  await page.keyboard.press('Escape');
  await page.keyboard.press('Escape');
  await dialog.waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await signIn(page, 'paul', kPassword);
  await dialog.waitFor({ state: 'hidden' });
  assert.equal(await page.getByRole('textbox', { name: 'Text' }).inputValue(), '# typed for an hour\n');
  await page.getByRole('alert').getByText('the server carried out nothing').waitFor();
  await page.getByText('Live', { exact: true }).waitFor();
  assert.deepEqual(commands, ['/api/v1/machines/mill-1/setup', '/api/v1/session']);
  await page.getByRole('button', { name: 'Store as a new revision' }).click();
  await page.getByText(/^Revision 1,.*paul/).waitFor();
});

test('a user is added, promoted, locked and removed', async () => {
  const { page, complaints } = await visit('#/administration/users');
  await page.getByText('Add a user').first().click();
  await page.getByLabel('User', { exact: true }).fill('nina');
  await page.getByLabel('cell-1').check();
  await page.getByLabel(/^Password/).fill(kPassword);
  await page.getByRole('button', { name: 'Add a user' }).click();
  await page.getByRole('link', { name: 'Manage nina' }).click();
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('region', { name: 'nina', exact: true }).getByLabel('Role').selectOption('approver');
  await page.getByRole('button', { name: 'Store', exact: true }).click();
  await page.getByRole('row', { name: /nina/ }).getByText('Approver').waitFor();
  await pressTwice(page.getByRole('button', { name: 'Lock', exact: true }), page.getByRole('button', { name: 'Press again: lock nina' }));
  await page.getByRole('row', { name: /nina/ }).getByText('Locked').waitFor();
  await pressTwice(page.getByRole('button', { name: 'Remove', exact: true }), page.getByRole('button', { name: /Press again: remove nina/ }));
  await page.getByRole('link', { name: 'Manage nina' }).waitFor({ state: 'detached' });
  assertNoComplaints(complaints);
});

test('a group of machines is made, filled and removed', async () => {
  const { page } = await visit('#/administration/groups');
  await page.getByLabel('Name').fill('cell-2');
  await page.getByRole('button', { name: 'Add a group' }).click();
  const card = page.locator('li.panel', { hasText: 'cell-2' });
  await card.getByLabel('Machine to add').fill('mill-2');
  await card.getByRole('button', { name: 'Add to cell-2' }).click();
  await card.getByRole('button', { name: 'Remove mill-2 from cell-2' }).waitFor();
  assert.deepEqual(await findBarriers(page), []);
  await card.getByRole('button', { name: 'Remove mill-2 from cell-2' }).click();
  await card.getByText('no machine').waitFor();
  await pressTwice(card.getByRole('button', { name: 'Remove the group' }), card.getByRole('button', { name: 'Press again: remove the group cell-2' }));
  await card.waitFor({ state: 'detached' });
});

test('a token is made, shown once, works and is revoked', async () => {
  const { page } = await visit('#/account', { user: 'otto' });
  await page.getByText('Make a token').first().click();
  await page.getByLabel('Name').fill('robot');
  await page.getByRole('button', { name: 'Make a token' }).click();
  const secret = (await page.locator('.secret').textContent())!;
  const status = async () => (await fetch(`${shop.url}/api/v1/machines`, { headers: { Authorization: `Bearer ${secret}` } })).status;
  assert.equal(await status(), 200);
  assert.doesNotMatch(await storages(page), new RegExp(secret));
  assert.deepEqual(await findBarriers(page), []);
  await page.getByRole('button', { name: 'Done' }).click();
  await page.locator('.secret').waitFor({ state: 'detached' });
  const row = page.getByRole('row', { name: /^robot/ });
  await pressTwice(row.getByRole('button', { name: 'Revoke' }), row.getByRole('button', { name: 'Press again: revoke robot' }));
  await row.waitFor({ state: 'detached' });
  assert.equal(await status(), 401);
});

test('a password is changed, and the audit trail finds who did what', async () => {
  await shop.addUser('rita', 'viewer');
  const { page } = await visit('#/account', { user: 'rita' });
  await page.getByLabel('Current password').fill(kPassword);
  await page.getByLabel('New password (').fill('a longer password');
  await page.getByLabel('New password again').fill('another password');
  await page.getByRole('button', { name: 'Change the password' }).click();
  await page.getByRole('alert').getByText('not the same').waitFor();
  await page.getByLabel('New password again').fill('a longer password');
  await page.getByRole('button', { name: 'Change the password' }).click();
  await page.getByText('The password is changed.').waitFor();
  const { page: trail } = await visit('#/administration/audit');
  await trail.getByRole('searchbox').fill('user.password rita');
  await trail.getByRole('row', { name: /rita user\.password rita/ }).waitFor();
  assert.equal(await trail.locator('tbody tr').count(), 1);
  await trail.getByRole('searchbox').fill('nothing of this kind');
  await trail.locator('tbody tr').waitFor({ state: 'detached' });
});
