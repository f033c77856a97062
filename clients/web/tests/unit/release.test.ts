// Which steps a revision can take by policy and role, and which revision a start names.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Program, ReleasePolicy, Revision, Session } from '../../generated/api';
import { revisionToStart, runRefusalOf, stepsOf } from '../../src/programs/release_steps';
import type { Role } from '../../src/api/permissions';

const kPolicy: ReleasePolicy = {
  runs: 'release', prove_out: { machines: ['lathe-9'], role: 'programmer' }, imports: { accept_at_once: [] }, sha256: '', public_key: '',
  steps: {
    submit: { from: ['draft'], role: 'programmer', four_eyes: false, comment: false },
    approve: { from: ['in_review'], role: 'approver', four_eyes: true, comment: false },
    reject: { from: ['in_review', 'approved'], role: 'approver', four_eyes: false, comment: true },
    release: { from: ['approved'], role: 'administrator', four_eyes: false, comment: false },
    withdraw: { from: ['draft', 'in_review', 'approved', 'released'], role: 'approver', four_eyes: false, comment: true },
  },
};

const caller = (role: Role, user = 'anna') => ({ role, user }) as Session;
const revision = (state: Revision['state'], changed: Partial<Revision> = {}) =>
  ({ program: 'O0200', revision: 3, state, held: false, sha256: 'a', author: 'paul', ...changed }) as Revision;
const steps = (one: Revision, by: Session, all = [one]) => stepsOf(kPolicy, one, all, by);

test('a step is offered from the states of the policy alone', () => {
  assert.deepEqual(steps(revision('draft'), caller('administrator')).map(({ step }) => step), ['submit', 'withdraw']);
  assert.deepEqual(steps(revision('in_review'), caller('administrator')).map(({ step }) => step), ['approve', 'reject', 'withdraw']);
  assert.deepEqual(steps(revision('withdrawn'), caller('administrator')), []);
});

test('what a machine has sent takes no step before it is accepted', () => {
  assert.deepEqual(steps(revision('draft', { held: true }), caller('administrator')), []);
});

test('a role that is too low is refused with the role that is needed, and a comment is asked for', () => {
  assert.deepEqual(steps(revision('approved'), caller('approver')), [
    { step: 'reject', needsComment: true, refusal: null }, { step: 'release', needsComment: false, refusal: { needs: 'administrator' } },
    { step: 'withdraw', needsComment: true, refusal: null }]);
});

test('four eyes are not those of who pushed these bytes, also as another revision', () => {
  const own = revision('in_review', { author: 'anna' });
  const same = revision('in_review', { revision: 4 });
  const approval = (one: Revision, by: Session) => steps(one, by, [own, same])[0]!.refusal;
  assert.deepEqual(approval(own, caller('approver')), { isOwn: true });
  assert.deepEqual(approval(same, caller('approver')), { isOwn: true });
  assert.equal(approval(same, caller('approver', 'vera')), null);
});

test('a machine runs what is released, and one for proving out runs drafts that the role starts', () => {
  assert.equal(runRefusalOf(kPolicy, 'released', 'lathe-1', caller('operator')), null);
  assert.deepEqual(runRefusalOf(kPolicy, 'approved', 'lathe-1', caller('administrator')), { why: 'notReleased' });
  assert.deepEqual(runRefusalOf(kPolicy, 'draft', 'lathe-9', caller('operator')), { why: 'proveOut', needs: 'programmer' });
  assert.equal(runRefusalOf(kPolicy, 'draft', 'lathe-9', caller('programmer')), null);
  assert.deepEqual(runRefusalOf({ ...kPolicy, runs: 'open' }, 'withdrawn', 'lathe-9', caller('administrator')), { why: 'withdrawn' });
});

test('a start names the newest revision only where the machine runs it', () => {
  const program = { revision: 7, state: 'draft', held: false } as Program;
  assert.equal(revisionToStart(kPolicy, program, 'lathe-1', caller('operator')), null);
  assert.equal(revisionToStart(kPolicy, program, 'lathe-9', caller('programmer')), 7);
  assert.equal(revisionToStart({ ...kPolicy, runs: 'open' }, program, 'lathe-1', caller('operator')), 7);
  assert.equal(revisionToStart(null, program, 'lathe-1', caller('operator')), 7);
  assert.equal(revisionToStart(kPolicy, { ...program, held: true }, 'lathe-9', caller('programmer')), null);
});
