// What a report template makes of a line, and on which runs it can be tried.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { runsFor } from '../../src/templates/runs_for';
import { eventText, fieldsText } from '../../src/templates/trial_text';
import { versionsUpTo } from '../../src/templates/use_templates';
import { run } from './samples';

test('events are in words', () => {
  assert.equal(eventText({ event: 'measurement', characteristic: 'D12', actual: 12.01, unit: 'mm', verdict: 'good' }), 'D12 = 12.01 mm: Good');
  assert.equal(eventText({ event: 'finding', kind: 'missing', text: 'lines 3 to 4' }), 'Missing: lines 3 to 4');
  assert.equal(eventText({ event: 'part_begun' }), 'A part begins.');
  assert.equal(eventText({ event: 'part_ended', part_number: '', serial: 'S7', verdict: 'scrap' }), 'The part S7 ends: Scrap.');
  assert.equal(fieldsText({ actual: '12.010', n: '7' }), 'actual 12.010, n 7');
});

test('every version can be chosen, the newest first', () => {
  assert.deepEqual(versionsUpTo(3), [3, 2, 1]);
});

test('a template is tried on its own runs first, and on none that reported nothing', () => {
  const of = (id: string, program: string, machine: string, outputs: number) => run({ id, program, machine, outputs });
  const runs = [of('a', 'O1', 'mill-1', 3), of('b', 'O2', 'mill-1', 3), of('c', 'O2', 'mill-2', 0), of('d', 'O3', 'mill-2', 1)];
  const assigned = (scope: 'program' | 'machine' | 'macro', subject: string) => [{ scope, subject, template: 't', version: null, author: 'admin', created: '' }];
  assert.deepEqual(runsFor(runs, assigned('program', 'O2')).map(({ id }) => id), ['b', 'a', 'd']);
  assert.deepEqual(runsFor(runs, assigned('machine', 'mill-2')).map(({ id }) => id), ['d', 'a', 'b']);
  assert.deepEqual(runsFor(runs, assigned('macro', 'O2')).map(({ id }) => id), ['a', 'b', 'd']);
});
