// What a role may do, and the search in the audit trail.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { test } from 'node:test';
import { searchEntries } from '../../src/administration/audit_search';
import { kLowestRoles, kRoles, refusalOf, type Permission } from '../../src/api/permissions';
import type { AuditEntry, Session } from '../../generated/api';

const session = (role: Session['role']): Session => ({ user: 'anna', role, groups: ['cell-1'], credential: 'page-1', kind: 'page', expires: null, address: '127.0.0.1' });

test('each role may do what a lower one may', () => {
  for (const permission of Object.keys(kLowestRoles) as Permission[]) {
    const may = kRoles.map((role) => refusalOf(session(role), null, permission) === null);
    assert.deepEqual(may, [...may].sort(), permission);
    assert.ok(may.at(-1), permission);
  }
});

test('the lowest roles are those of the server\'s table', () => {
  const table = readFileSync(path.join(process.env.WEB!, '../../server/identity/permission.cpp'), 'utf8');
  for (const [permission, role] of Object.entries(kLowestRoles)) {
    assert.match(table, new RegExp(`\\{"${permission}", ${role}\\}`, 'i'));
  }
});

test('a machine outside the groups is refused, and the reason names it', () => {
  const machines = new Set(['mill-1']);
  assert.equal(refusalOf(session('operator'), machines, 'operate', 'mill-1'), null);
  assert.deepEqual(refusalOf(session('operator'), machines, 'operate', 'mill-2'), { machine: 'mill-2' });
  assert.deepEqual(refusalOf(session('viewer'), machines, 'operate', 'mill-2'), { needs: 'operator' });
  assert.equal(refusalOf(session('operator'), null, 'operate', 'mill-2'), null);
});

test('an entry is found by words in any of its fields', () => {
  const entry = (who: string, action: string, subject: string): AuditEntry => ({ time: '', who, action, subject, detail: '', credential: '', address: '10.0.0.1' });
  const entries = [entry('anna', 'user.add', 'otto'), entry('otto', 'run.start', 'mill-1')];
  assert.deepEqual(searchEntries(entries, 'OTTO add'), [entries[0]]);
  assert.deepEqual(searchEntries(entries, '10.0 otto'), entries);
  assert.deepEqual(searchEntries(entries, 'stranger'), []);
});
