// The logic of the programs' view: names, pieces of long texts, parts of a block, search.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { canPin, releaseOf } from '../../src/programs/calls';
import { changeOf, fieldsOf } from '../../src/programs/fields';
import { holdsPlace, nextOf, pieceOf, rangeAround, rangeBefore, rangeFrom, type Range } from '../../src/programs/pieces';
import { findingsByLine, sortFindings } from '../../src/programs/findings';
import { beforeName, markWords, wordsToSend } from '../../src/programs/search';
import { partsOf } from '../../src/programs/syntax';
import { programNameOf } from '../../src/programs/upload';

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

test('the beginning of a word is searched for while it is typed, of letters alone', () => {
  assert.deepEqual(['brack', 'O07', 'po', ' pocket mill ', 'T1 rou*', 'G1', 'träger'].map(wordsToSend), ['brack*', 'O07', 'po', 'pocket mill*', 'T1 rou*', 'G1', 'träger*']);
});

test('names that begin so are those past the name before', () => {
  const names = ['O', 'O06', 'O0699', 'O07', 'O0700', 'O071', 'O08'];
  const bytes = (text: string) => Buffer.from(text);
  const past = names.filter((name) => Buffer.compare(bytes(name), bytes(beforeName('O07'))) > 0);
  assert.deepEqual(past, ['O07', 'O0700', 'O071', 'O08']);
});

for (const [text, words] of [['DEEP POCKET, POCKET 2', 'pocket* deep'], ['<img src=x>', 'img <'], ['İstanbul', 'i'], ['G01 X1', ''], ['', 'x']] as const) {
  test(`the marked parts of "${text}" are all of it`, () => {
    assert.equal(markWords(text, words).map((part) => part.text).join(''), text);
  });
}

test('words are marked wherever they are', () => {
  const found = markWords('DEEP POCKET, pocket 2', 'pocket* deep').filter((part) => part.isFound).map((part) => part.text);
  assert.deepEqual(found, ['DEEP', 'POCKET', 'pocket']);
});

test('only the fields that were changed are sent, an emptied one too', () => {
  const before = fieldsOf({ part: 'bracket', operation: null, material: 'steel', machine_group: null, cam_file: null });
  assert.equal(changeOf(before, { ...before, part: 'bracket ' }, 3), null);
  assert.deepEqual(changeOf(before, { ...before, material: '', operation: '2' }, 3), { operation: '2', material: '' });
  assert.deepEqual(changeOf(before, { ...before, cam_file: 'b.prt' }, 3), { cam_file: 'b.prt', revision: 3 });
});

test('what is called is pinned when all of it is there and approved', () => {
  const call = (state: string) => ({ name: '210', program: 'O0210', revision: 1, sha256: '', state, site: null });
  const closure = (calls: unknown[], missing: unknown[] = []) => ({ program: 'O0200', revision: 1, calls, missing, computed: [] }) as never;
  assert.deepEqual([closure([]), closure([call('draft')]), closure([call('approved'), call('released')]), closure([call('released')], [{}])].map(canPin), [false, false, true, false]);
  assert.deepEqual(releaseOf(false, { machine: 'mill-1', with: 'O0220' }), {});
  assert.deepEqual(releaseOf(true, { machine: '', with: 'O0220@3, O0230' }), { closure: true, with: ['O0220@3', 'O0230'] });
});
