// The logic of the programs' view: names, pieces of long texts, parts of a block, search.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { searchPrograms } from '../../src/programs/list';
import { holdsPlace, nextOf, pieceOf, rangeAround, rangeBefore, rangeFrom, type Range } from '../../src/programs/pieces';
import { findingsByLine, sortFindings } from '../../src/programs/findings';
import { partsOf } from '../../src/programs/syntax';
import { programNameOf } from '../../src/programs/upload';
import type { Program } from '../../generated/api';

test('a program is called as its file, without the ending', () => {
  assert.deepEqual(['O0100.nc', '15.H', 'part.v2.nc', 'O0100', '.nc', 'a.longending'].map(programNameOf), ['O0100', '15', 'part.v2', 'O0100', '.nc', 'a.longending']);
});

const kLines = Array.from({ length: 999 }, (_, i) => `N${i + 1} X${'9'.repeat(i % 40)}`);
const kText = new TextEncoder().encode(kLines.join('\r\n'));
/// As the server gives it, shorter ranges than the page asks for too.
const load = (range: Range, length = Infinity) => pieceOf(kText.slice(range.first, Math.min(range.end, range.first + length)), range, kText.length);

test('pieces one after the other are the whole text, with its line numbers', () => {
  for (const length of [100, 333, 5000, 1_000_000]) {
    const read: string[] = [];
    let place = { offset: 0, line: 1 };
    while (place.offset < kText.length) {
      const piece = load(rangeFrom(place, kText.length), length);
      assert.equal(piece.line, read.length + 1);
      assert.ok(piece.end > place.offset);
      read.push(...piece.lines);
      place = nextOf(piece);
    }
    assert.deepEqual(read, kLines, `pieces of ${length}`);
  }
});

test('a line that is longer than a piece comes in several', () => {
  const bytes = new TextEncoder().encode('X'.repeat(50));
  assert.equal(pieceOf(bytes.slice(0, 20), rangeFrom({ offset: 0, line: 1 }, 50), 50).end, 20);
});

test('an empty program has no line', () => {
  assert.deepEqual(pieceOf(new Uint8Array(), rangeFrom({ offset: 0, line: 1 }, 0), 0).lines, []);
});

test('a block is gone to with its number, and the piece before it is numbered back', () => {
  const line = 700;
  const offset = new TextEncoder().encode(`${kLines.slice(0, line - 1).join('\r\n')}\r\n`).length;
  const range = { ...rangeAround({ offset, line }, kText.length), first: offset - 1000 };
  const piece = load(range);
  assert.ok(holdsPlace(piece, offset));
  assert.equal(piece.lines[line - piece.line], kLines[line - 1]);
  const before = load({ ...rangeBefore(piece), first: piece.offset - 2000 });
  assert.deepEqual(nextOf(before), { offset: piece.offset, line: piece.line });
  assert.equal(before.lines[0], kLines[before.line - 1]);
  assert.ok(!holdsPlace(before, offset));
});

test('findings are at their lines, those of called programs at none; the alarm is listed first', () => {
  const found = (line: number, changed: object = {}) => ({ severity: 'warning', id: 'W', text: '', program: null, line, column: 1, offset: 0, times: 1, ...changed }) as const;
  const diagnostics = [found(5), found(2, { program: 'O0002' }), found(5, { column: 0 }), found(9, { severity: 'alarm' })];
  const byLine = findingsByLine({ diagnostics } as never);
  assert.deepEqual([...byLine].map(([line, list]) => [line, list.length]), [[5, 2], [9, 1]]);
  assert.deepEqual(sortFindings(diagnostics as never).map(({ line, column }) => [line, column]), [[9, 1], [5, 0], [5, 1], [2, 1]]);
});

for (const block of ['N10 G1 X1. (A (B) F100', '15 CYCL DEF 1.0 PECKING', '<img src=x onerror=alert(1)>', '#500=[#1+2.]', '', 'O0100 ; rest']) {
  test(`the parts of "${block}" are all of it`, () => {
    assert.equal(partsOf(block).map((part) => part.text).join(''), block);
  });
}

test('comments, numbers, codes and words are distinguished', () => {
  const kinds = partsOf('N10 G1 X1.5 (GO) M3').filter((part) => part.kind !== 'text').map((part) => `${part.kind}:${part.text}`);
  assert.deepEqual(kinds, ['number:N10', 'code:G1', 'word:X1.5', 'comment:(GO)', 'code:M3']);
});

test('a search fits all words, wherever they are', () => {
  const programs = [{ name: 'O0100', title: 'PLATE' }, { name: 'O0200', title: 'SHAFT' }] as Program[];
  assert.deepEqual(searchPrograms(programs, 'o0 shaft').map((p) => p.name), ['O0200']);
  assert.equal(searchPrograms(programs, '').length, 2);
});
