// The numbers of a job, and the places to which it can be moved.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { countedOf, fractionOf, isMeasured, movesOf, nextParts, requestOf, runsLeft } from '../../src/machine/jobs/job_steps';
import { job } from './samples';

test('a last run may make more parts than are wanted', () => {
  const almost = job({ quantity: 10, parts_per_run: 4, completed: 8 });
  assert.equal(runsLeft(almost), 1);
  assert.deepEqual(nextParts(almost), { first: 9, last: 12 });
  const done = job({ quantity: 10, parts_per_run: 4, completed: 12 });
  assert.deepEqual([runsLeft(done), fractionOf(done)], [0, 1]);
});

test('rework and scrap do not count up to the quantity of a job that counts good parts', () => {
  const made = job({ quantity: 4, completed: 3, good: 1, rework: 1, scrap: 1 });
  assert.deepEqual([countedOf(made), runsLeft(made), fractionOf(made), isMeasured(made)], [3, 1, 0.75, true]);
  const good = job({ ...made, counts: 'good' });
  assert.deepEqual([countedOf(good), runsLeft(good), fractionOf(good)], [1, 3, 0.25]);
  assert.equal(isMeasured(job({ completed: 3, unknown: 3 })), false);
  assert.equal(isMeasured(job({ counts: 'good' })), true);
});

test('a job moves by one place or to the first, and nowhere where it is already', () => {
  assert.deepEqual(movesOf(0, 1), { first: null, up: null, down: null });
  assert.deepEqual(movesOf(0, 3), { first: null, up: null, down: 2 });
  assert.deepEqual(movesOf(1, 3), { first: null, up: 1, down: 3 });
  assert.deepEqual(movesOf(2, 3), { first: 1, up: 2, down: null });
});

test('what was left empty is not sent', () => {
  const empty = { program: ' O0200 ', revision: '', quantity: 25, partsPerRun: 1, counts: 'made' as const, isFirst: false, comment: ' ' };
  assert.deepEqual(requestOf(empty), { program: 'O0200', quantity: 25, parts_per_run: 1 });
  assert.deepEqual(requestOf({ ...empty, counts: 'good' }), { program: 'O0200', quantity: 25, parts_per_run: 1, counts: 'good' });
  assert.deepEqual(requestOf({ ...empty, revision: '3', isFirst: true, comment: 'steel ' }),
    { program: 'O0200', quantity: 25, parts_per_run: 1, revision: 3, place: 1, comment: 'steel' });
});
