// A machine's state that comes whole once and then by its changes.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { changedMachine, type MachineChange } from '../../src/live/machine_change';
import { machine } from './samples';

const change = (members: object): MachineChange => ({ name: 'lathe-1', after: 1, version: 2, ...members });

test('members of objects are replaced one by one, everything else as a whole', () => {
  const before = { version: 1, ...machine({ notices: ['a', 'b'] }, { line: 1, position: { X: 1, Z: 2 } }) };
  const now = changedMachine(before, change({ notices: ['c'], status: { line: 2, position: { Z: 3 }, message: null } }))!;
  assert.deepEqual(now, { ...before, version: 2, notices: ['c'], status: { ...before.status, line: 2, position: { X: 1, Z: 3 }, message: null } });
});

test('what was known stays as it was, so that who holds it sees that there is something new', () => {
  const before = { version: 1, ...machine({}, { line: 1 }) };
  const now = changedMachine(before, change({ status: { line: 2 } }))!;
  assert.equal(before.status!.line, 1);
  assert.notEqual(now.status, before.status);
  assert.equal(now.starts, before.starts, 'and nothing is copied that is the same');
});

test('an object takes the place of null, and null of an object', () => {
  const hold = { who: 'anna', reason: 'tool', since: '2026-11-23T12:00:00Z' };
  const held = changedMachine({ version: 1, ...machine() }, change({ held: hold }))!;
  assert.deepEqual(held.held, hold);
  assert.equal(changedMachine({ ...held, version: 1 }, change({ held: null }))!.held, null);
});

test('a change of another version, or of a machine that is not known, is none', () => {
  assert.equal(changedMachine({ version: 2, ...machine() }, change({})), null);
  assert.equal(changedMachine(machine(), change({})), null, 'one that was asked for has no version');
  assert.equal(changedMachine(undefined, change({})), null);
});
