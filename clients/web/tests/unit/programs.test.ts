// The logic of the programs' view: names, pieces of long texts, parts of a block, search.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { searchPrograms } from '../../src/programs/list';
import { pieceOf } from '../../src/programs/pieces';
import { partsOf } from '../../src/programs/syntax';
import { programNameOf } from '../../src/programs/upload';
import type { Program } from '../../generated/api';

test('a program is called as its file, without the ending', () => {
  assert.deepEqual(['O0100.nc', '15.H', 'part.v2.nc', 'O0100', '.nc', 'a.longending'].map(programNameOf), ['O0100', '15', 'part.v2', 'O0100', '.nc', 'a.longending']);
});

test('pieces one after the other are the whole text, with its line numbers', () => {
  const lines = Array.from({ length: 999 }, (_, i) => `N${i + 1} X${'9'.repeat(i % 40)}`);
  const bytes = new TextEncoder().encode(lines.join('\r\n'));
  for (const length of [100, 333, 5000, 1_000_000]) {
    const read: string[] = [];
    let offset = 0;
    while (offset < bytes.length) {
      const piece = pieceOf(bytes.slice(offset, offset + length), offset, read.length + 1, bytes.length);
      assert.equal(piece.line, read.length + 1);
      assert.ok(piece.end > offset);
      read.push(...piece.lines);
      offset = piece.end;
    }
    assert.deepEqual(read, lines, `pieces of ${length}`);
  }
});

test('a line that is longer than a piece comes in several', () => {
  const bytes = new TextEncoder().encode('X'.repeat(50));
  assert.equal(pieceOf(bytes.slice(0, 20), 0, 1, 50).end, 20);
});

test('an empty program has no line', () => {
  assert.deepEqual(pieceOf(new Uint8Array(), 0, 1, 0).lines, []);
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
