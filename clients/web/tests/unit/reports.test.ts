// The logic of reports and administration: measured values, limits, the characters of a line, the settings of a port.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { readableBytes } from '../../src/administration/bytes_text';
import { readSettings } from '../../src/administration/port_settings';
import { readLimit, seriesOf, summaryOf } from '../../src/reports/series';
import { record } from './samples';

const output = (text: string) => record({ kind: 'output', text });

test('the numbers of report lines are series by their letters', () => {
  const series = seriesOf([output('TURNED PROFILE'), output('G1X10.5 Z-.25'), output('G1 X11 Z-0.5'), output('ALONE 5')]);
  assert.deepEqual(series, [{ name: 'X', values: [10.5, 11] }, { name: 'Z', values: [-0.25, -0.5] }]);
});

test('names with digits and signs of equality are read', () => {
  assert.deepEqual(seriesOf([output('DIA_1=19.998 OK'), output('DIA_1: +20.002')]), [{ name: 'DIA_1', values: [19.998, 20.002] }]);
});

test('what only looks like a number is none', () => {
  assert.deepEqual(seriesOf([output('X1.2.3 T5A'), output('X1.2.3 T5A')]), []);
});

test('probings that met something are series by axis', () => {
  const probe = (z: number, tripped: boolean) => record({ kind: 'probe', text: JSON.stringify({ to: {}, until: 'contact', tripped, at: { Z: z } }) });
  assert.deepEqual(seriesOf([probe(1, true), probe(9, false), probe(2, true)]), [{ name: 'probe Z', values: [1, 2] }]);
});

test('a limit is a number or none', () => {
  assert.deepEqual(['1.5', '-2,5', '', ' ', 'x', null].map(readLimit), [1.5, -2.5, null, null, null, null]);
});

test('a summary counts what is outside, and a value on the limit is inside', () => {
  assert.deepEqual(summaryOf([1, 2, 3], { lower: 1, upper: 2 }), { count: 3, smallest: 1, largest: 3, mean: 2, outside: 1 });
  assert.equal(summaryOf([1, 2, 3], { lower: null, upper: null }).outside, 0);
});

test('the characters of a line are readable, whatever they are', () => {
  assert.equal(readableBytes('11473100ff0d0a7f3c'), '⟨DC1⟩G1⟨NUL⟩⟨ff⟩⟨CR⟩⟨LF⟩⟨DEL⟩<');
  assert.equal(readableBytes(''), '');
});

test('settings are lines of key and value, and what is none is named', () => {
  assert.deepEqual(readSettings('line = 9600e72\n\nxon = "DC1"\n', String), { line: '9600e72', xon: 'DC1' });
  assert.throws(() => readSettings('baud 4800', (line) => `no: ${line}`), /no: baud 4800/);
});
