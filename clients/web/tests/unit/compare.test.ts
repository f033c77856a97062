// The rows of two texts beside each other.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { ComparedHunk } from '../../generated/api';
import { rowsOf, type Row } from '../../src/compare/rows';

function hunk(before: string[], first: [number, string[]], second: [number, string[]], after: string[]): ComparedHunk {
  const lines = ([line, rows]: [number, string[]]) => ({ line, count: rows.length, lines: rows });
  return { change: 'other', before, first: lines(first), second: lines(second), after };
}

const shown = (rows: Row[]) => rows.map((row) => `${row.kind} ${row.first ? `${row.first.line}:${row.first.text}` : '-'} ${row.second ? `${row.second.line}:${row.second.text}` : '-'}`);

test('a changed line is beside the one it was', () => {
  assert.deepEqual(shown(rowsOf([hunk(['a'], [2, ['b']], [2, ['x', 'y']], ['c'])])), ['same 1:a 1:a', 'changed 2:b 2:x', 'added - 3:y', 'same 3:c 4:c']);
});

test('lines that are taken out or put in have nothing beside them', () => {
  assert.deepEqual(shown(rowsOf([hunk([], [1, ['a']], [1, []], ['b'])])), ['removed 1:a -', 'same 2:b 1:b']);
  assert.deepEqual(shown(rowsOf([hunk([], [1, []], [1, ['a']], ['b'])])), ['added - 1:a', 'same 1:b 2:b']);
});

test('what is left out between two places is a gap, where something is', () => {
  const rows = rowsOf([hunk(['b'], [3, ['c']], [3, ['C']], ['d']), hunk([], [5, ['e']], [5, ['E']], []), hunk(['g'], [8, ['h']], [8, ['H']], [])]);
  assert.deepEqual(rows.map((row) => row.kind), ['gap', 'same', 'changed', 'same', 'changed', 'gap', 'same', 'changed']);
  assert.deepEqual(rowsOf([]), []);
});
