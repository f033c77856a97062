// The logic of the machine's view: the window of a program's text, the tables of a setup, differences, units, records.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { probingOf, recordText } from '../../src/live/record_text';
import { startBody } from '../../src/machine/commands';
import { stepsOf } from '../../src/machine/jog';
import { addRow, columnsOf, readTables, setCell } from '../../src/machine/setup/setup_tables';
import { holds, numberLines, rangeAround, type TextWindow } from '../../src/machine/text_window';
import { blocksOf, hasField, positionsOf, usedValues } from '../../src/machine/screen';
import { axisText, isDiameter, kInch, kMillimeter, lengthText, sortAxes, unitOf } from '../../src/machine/units';
import { canStartAt, placeOf } from '../../src/machine/start_places';
import { diffLines, foldDiff } from '../../src/parts/diff';
import { record, status } from './samples';

const program = Array.from({ length: 5000 }, (_, i) => `N${i + 1} X${i}\r\n`).join('');
const bytes = new TextEncoder().encode(program);

function windowAt(offset: number): TextWindow {
  const { first, last } = rangeAround(offset, bytes.length);
  return { offset: first, bytes: bytes.slice(first, last + 1), size: bytes.length };
}

for (const line of [1, 2, 700, 2500, 4999, 5000]) {
  test(`line ${line} has its number and its text, wherever the window was cut`, () => {
    const offset = program.indexOf(`N${line} `);
    const lines = numberLines(windowAt(offset), offset, line);
    assert.equal(lines.find((l) => l.number === line)?.text, `N${line} X${line - 1}`);
    for (const l of lines) assert.equal(l.text, `N${l.number} X${l.number - 1}`);
  });
}

test('a window is kept while the block is well inside it', () => {
  const window = windowAt(30_000);
  assert.equal(holds(window, 30_000), true);
  assert.equal(holds(window, window.offset + window.bytes.length - 10), false);
  assert.equal(holds(window, window.offset + 10), false);
  assert.equal(holds(window, bytes.length + 10), false);
  assert.equal(holds(windowAt(0), 0), true);
  assert.equal(holds(windowAt(bytes.length - 5), bytes.length - 5), true);
});

const setup = `units = "mm"

[[tool]]   # face mill
number = 1
length = 142.3   # measured, "cold"

[control]
number = 9
[[ tool ]]
number = 2
wear = { X = 0.1 }
[[offset]]
name = "G54 # not a comment"
`;

test('tables are found where they are written, and nothing else is', () => {
  const rows = readTables(setup);
  assert.deepEqual(rows.map((row) => [row.table, ...row.cells.map((c) => `${c.key}=${c.text}`)]), [
    ['tool', 'number=1', 'length=142.3'], ['tool', 'number=2', 'wear={ X = 0.1 }'], ['offset', 'name="G54 # not a comment"']]);
  assert.deepEqual(columnsOf(rows.filter((row) => row.table === 'tool')), ['number', 'length', 'wear']);
});

test('a cell changes its own bytes and no others', () => {
  const [first] = readTables(setup);
  assert.equal(setCell(setup, first!, 'length', ' 150 '), setup.replace('142.3', '150'));
  assert.equal(setCell(setup, first!, 'length', '  '), setup);
});

test('a cell that was missing is written after the last line of its table', () => {
  const [, second] = readTables(setup);
  assert.equal(setCell(setup, second!, 'length', '80'), setup.replace('{ X = 0.1 }', '{ X = 0.1 }\nlength = 80'));
});

test('a new tool has the next number', () => {
  const rows = readTables(addRow(setup, 'tool', ['number', 'length']));
  assert.equal(rows.at(-1)?.cells[0]?.text, '3');
  assert.equal(readTables(addRow('', 'variable', [])).length, 1);
});

test('a difference can be read in both directions', () => {
  const before = 'a\nb\nc\nd\ne';
  const after = 'a\nc\nx\nd\ne\nf';
  const lines = diffLines(before, after);
  assert.equal(lines.filter((l) => l.kind !== 'added').map((l) => l.text).join('\n'), before);
  assert.equal(lines.filter((l) => l.kind !== 'removed').map((l) => l.text).join('\n'), after);
  assert.deepEqual(lines.filter((l) => l.kind !== 'same').map((l) => l.kind[0] + l.text), ['rb', 'ax', 'af']);
});

test('what did not change is folded, and no difference is nothing', () => {
  const many = Array.from({ length: 100 }, (_, i) => `line ${i}`);
  const changed = many.map((line, i) => (i === 50 ? 'x' : line));
  const folded = foldDiff(diffLines(many.join('\n'), changed.join('\n')), 2);
  assert.equal(folded.length, 6);
  assert.deepEqual(foldDiff(diffLines('a', 'a')), []);
});

test('lengths are in the unit that the control shows, X of its lathe as a diameter, angles in degrees', () => {
  const mm = unitOf(null);
  const lathe = { units: 'inch' as const, x: 'diameter' as const, fields: [] };
  const inch = unitOf(lathe);
  assert.equal(axisText('X', 12.7, inch, isDiameter('X', lathe)), '1.0000');
  assert.equal(axisText('Z', 12.7, inch, isDiameter('Z', lathe)), '0.5000');
  assert.ok(!isDiameter('X', null) && !isDiameter('X', { units: 'mm', x: 'radius', fields: [] }));
  assert.equal(lengthText(25.4, inch), '1.0000');
  assert.equal(lengthText(-0.0001, mm), '0.000');
  assert.equal(axisText('B', 90, inch), '90.000°');
  assert.equal(axisText('X', undefined, mm), '–');
  assert.deepEqual(sortAxes(['C', 'Z', 'X']), ['X', 'Z', 'C']);
});

test('structured records become words, broken ones as they are', () => {
  assert.equal(recordText(record({ kind: 'alarm', text: '{"code":"FA0005","text":"PS005 NO DATA"}' })), 'PS005 NO DATA · FA0005');
  assert.equal(recordText(record({ kind: 'run_ended', text: '{"outcome":"completed","reason":"","sent":5}' })), 'completed');
  assert.equal(recordText(record({ kind: 'alarm', text: '{"code":' })), '{"code":');
  assert.equal(recordText(record({ kind: 'output', text: '[1,2]' })), '[1,2]');
  assert.equal(recordText(record({ kind: 'output', text: '{"a":1}' })), '{"a":1}');
});

test('a probing result is a point', () => {
  const probe = record({ kind: 'probe', text: '{"to":{"Z":-3},"until":"contact","tripped":true,"at":{"X":1.5,"Z":-0.25}}' });
  assert.deepEqual(probingOf(probe), { at: { X: 1.5, Z: -0.25 }, tripped: true });
  assert.equal(recordText(probe), 'X 1.5000  Z -0.2500');
  assert.equal(probingOf(record({ kind: 'output', text: probe.text })), null);
});

test('options of a start are sent with a place in the program alone', () => {
  const request = { machine: 'mill-1', program: 'O0200', revision: null, options: { head: 'send', memory: 'now', pass: '2' } } as const;
  assert.deepEqual(startBody({ ...request, from: '' }), { machine: 'mill-1', program: 'O0200' });
  assert.deepEqual(startBody({ ...request, from: 'N120' }), { machine: 'mill-1', program: 'O0200', from: 'N120', head: 'send', memory: 'now', pass: 2 });
  assert.deepEqual(startBody({ machine: 'mill-1', program: 'O0200', revision: 3, from: 'L7' }), { machine: 'mill-1', program: 'O0200', revision: 3, from: 'L7' });
});

test('a start can name what the machine\'s control goes to, and nothing else', () => {
  assert.deepEqual(['N120', '120', 'l7', 'B4096', 'T3', '+25', 'X3', 'N', ''].map(placeOf), ['block', 'block', 'line', 'byte', 'tool', 'count', null, null, null]);
  const tnc = { at: ['block' as const], head: false, memory: false, pass: false, mdi: 0 };
  assert.deepEqual(['', ' N400 ', '400', 'L7', 'T3', 'soon'].map((typed) => canStartAt(typed, tnc)), [true, true, true, false, false, false]);
  assert.equal(canStartAt('N1', { ...tnc, at: [] }), false);
});

const screen = { units: 'mm' as const, position: null, previous_block: null, block: 'N2 X2', next_block: 'N3 X3', further_block: null };
const coordinates = { target: { X: 9 }, distance_to_go: { X: 2 }, following_error: { X: 0 }, program: null };

test('the position that the operator of the control has chosen comes first', () => {
  const kinds = (position: NonNullable<Parameters<typeof positionsOf>[0]['screen']>['position']) =>
    positionsOf(status({ position: { X: 7 }, coordinates, screen: { ...screen, position } })).map(([kind]) => kind);
  assert.deepEqual(kinds(null), ['reference', 'distance_to_go', 'following_error'], 'without a program none is in its coordinates');
  assert.deepEqual(kinds('distance_to_go'), ['distance_to_go', 'reference', 'following_error']);
  assert.deepEqual(kinds('nominal'), ['nominal', 'reference', 'distance_to_go', 'following_error']);
  assert.deepEqual(kinds('actual'), ['reference', 'distance_to_go', 'following_error']);
  assert.deepEqual(positionsOf(status({ position: { X: 7 } })), [['reference', { X: 7 }]], 'an older gateway');
});

test('the blocks are those that the control shows', () => {
  assert.deepEqual(blocksOf(status({ screen })), [{ text: 'N2 X2', isExecuting: true }, { text: 'N3 X3', isExecuting: false }]);
  assert.deepEqual(blocksOf(status()), []);
});

test('a control has no fields of another', () => {
  const tnc = { units: 'mm' as const, x: 'radius' as const, fields: ['tool_length_z' as const] };
  assert.ok(hasField(tnc, 'tool_length_z') && !hasField(tnc, 'work_system'));
  assert.ok(hasField(null, 'work_system'), 'of a control that is not known nothing is left out');
});

test('of a control\'s values those are listed that are in use', () => {
  const one = (name: string, value: number | null) => ({ name, value });
  assert.deepEqual(usedValues([one('P1', 0), one('P2', -1), one('#5', null), one('P3', 0.1)]).map(({ name }) => name), ['P2', 'P3']);
});

test('steps of a jog are from the resolution of the display to what the gateway takes', () => {
  assert.deepEqual(stepsOf(kMillimeter, 1), [0.001, 0.01, 0.1, 1]);
  assert.deepEqual(stepsOf(kMillimeter, 50), [0.001, 0.01, 0.1, 1, 10]);
  assert.deepEqual(stepsOf(kInch, 1), [0.0001, 0.001, 0.01]);
  assert.deepEqual(stepsOf(kMillimeter, 0), []);
});
