// The rows of archives: records, and what is inside those of measurements. Nothing is left out.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { lineOf } from '../../src/administration/archive_row';

test('a record is a line with its kind in words', () => {
  assert.deepEqual(lineOf({ machine: 'lathe-1', run: 'run-1', time: '2026-11-23T12:00:00Z', kind: 'output', text: 'L 1.001' }),
    { time: '2026-11-23T12:00:00Z', machine: 'lathe-1', run: 'run-1', kind: 'Output', text: 'L 1.001' });
  assert.equal(lineOf({ kind: 'later_kind', text: 'x' }).kind, 'later_kind');
  assert.equal(lineOf({ kind: 'output', text: 'x', run: null }).run, '');
});

test('a measurement, a finding and a part are what is inside the row', () => {
  assert.equal(lineOf({ measurement: { machine: 'lathe-1', characteristic: 'L', actual: 1.001, unit: 'in', time: '2026-11-23T12:00:00Z' } }).text, 'L = 1.001 in');
  assert.equal(lineOf({ finding: { machine: 'lathe-1', text: 'LOAD 3' } }).text, 'LOAD 3');
  assert.equal(lineOf({ part: { machine: 'lathe-1', ended: '2026-11-23T12:00:00Z' } }).time, '2026-11-23T12:00:00Z');
});

test('a row that is not known is shown as it is', () => {
  assert.equal(lineOf({ odd: [1, 2] }).text, '{"odd":[1,2]}');
});
