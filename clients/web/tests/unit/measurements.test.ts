// Values between their limits, and what is asked of the server for a list and for a chart.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { changeOf, latestRuns, stepLine, targetsOf, type PastValue } from '../../src/corrections/steps';
import { fileNameOf } from '../../src/measurements/exports';
import { indexText, remarksOf, rowsOf } from '../../src/measurements/study';
import { capabilityOf, chartOf, choicesOf, filterOf, gaugeOf, placeOf, utcOf } from '../../src/measurements/tolerance';
import { capability, measurement } from './samples';

test('the limits are at a quarter and three quarters, and a value on one is in', () => {
  assert.deepEqual(placeOf(measurement({ lower: 0, upper: 2, nominal: 1, actual: 2 })), { actual: 0.75, nominal: 0.5, isOut: false });
  assert.deepEqual(placeOf(measurement({ lower: 0, upper: 2, nominal: null, actual: -100 })), { actual: 0, nominal: null, isOut: true });
});

test('a value without both limits has no place', () => {
  assert.deepEqual([{ lower: null }, { upper: null }, { lower: 1, upper: 1 }, { lower: -1e308, upper: 1e308 }].map((limits) => placeOf(measurement(limits))), [null, null, null, null]);
  assert.equal(placeOf(measurement({ lower: 0, upper: 2, nominal: 1e308, actual: 1e308 }))?.actual, 1);
});

test('a time of the page is sent in UTC, and what is none is left out', () => {
  assert.equal(utcOf('2026-11-24T20:05'), new Date(2026, 10, 24, 20, 5).toISOString());
  assert.deepEqual(['', 'soon'].map(utcOf), ['', '']);
});

test('a chart takes what is for its kind', () => {
  const choices = choicesOf(new URLSearchParams('characteristic=D12&kind=histogram&rules=nelson&subgroup=4&verdict=scrap'));
  assert.equal(filterOf(choices).verdict, 'scrap');
  assert.deepEqual([chartOf(choices).rules, chartOf(choices).subgroup], ['', '']);
  assert.deepEqual([chartOf({ ...choices, kind: 'xbar-r' }).rules, chartOf({ ...choices, kind: 'xbar-r' }).subgroup], ['nelson', '4']);
});

const past = (target: string, value: number, setup: number) => ({ target, value, setup, unit: 'mm' }) as PastValue;

test('a change is from the value that the same target had before', () => {
  const history = [past('T3.wear.Z', 3, 4), past('T3.wear.X', 1, 3), past('T3.wear.Z', 1, 2)];
  assert.deepEqual(history.map((_, i) => changeOf(history, i)), [2, null, null]);
  assert.deepEqual(targetsOf(history), ['T3.wear.X', 'T3.wear.Z']);
});

test('values are steps from the oldest to the newest', () => {
  assert.deepEqual(stepLine([2, 0], { width: 100, height: 10 }), { points: '0,10 50,10 50,0 100,0', lowest: 0, highest: 2 });
  assert.equal(stepLine([1, 1], { width: 100, height: 10 })?.points, '0,5 50,5 50,5 100,5');
  assert.equal(stepLine([-1e308, 1e308], { width: 100, height: 10 })?.points, '0,5 50,5 50,5 100,5');
  assert.equal(stepLine([1], { width: 100, height: 10 }), null);
});

test('a study is of the values of the chart: sigma within is that of its subgroups', () => {
  const choices = choicesOf(new URLSearchParams('characteristic=D12&kind=histogram&machine=mill-1&verdict=scrap&shape=lognormal'));
  assert.deepEqual(capabilityOf(choices), { characteristic: 'D12', machine: 'mill-1', run: '', since: '', until: '', shape: 'lognormal', subgroup: '' });
  assert.equal(chartOf(choices).shape, 'lognormal');
  assert.equal(chartOf({ ...choices, kind: 'individuals' }).shape, '');
  assert.equal(capabilityOf({ ...choices, kind: 'xbar-s', subgroup: '' }).subgroup, '5');
  assert.deepEqual(gaugeOf(choices, { method: 'ranges', tolerance: '0.04' }), { characteristic: 'D12', machine: 'mill-1', run: '', since: '', until: '', method: 'ranges', tolerance: '0.04' });
});

test('an index has its interval where there is one', () => {
  assert.equal(indexText({ value: 1.333, low: 1.018, high: 1.649 }), '1.33 (1.02 to 1.65)');
  assert.equal(indexText({ value: 1.333, low: null, high: null }), '1.33');
  assert.equal(indexText(null), '–');
});

test('a study remarks what its numbers do not say', () => {
  assert.deepEqual(remarksOf(capability()), []);
  const unlikely = { statistic: 2, adjusted: 2, p_value: 0.001 };
  assert.match(remarksOf(capability({ anderson_darling: unlikely }))[0]!, /p = 0\.001/);
  assert.deepEqual(remarksOf(capability({ shape: 'lognormal', anderson_darling: unlikely })), []);
  assert.equal(remarksOf(capability({ shape: 'empirical', percentiles_reached: false })).length, 1);
  assert.equal(remarksOf(capability({ upper: null })).length, 1);
});

test('a study of another shape has percentiles and no sigma within', () => {
  const names = (shape: 'normal' | 'empirical') => rowsOf(capability({ shape })).map(([name]) => name);
  assert.ok(names('normal').includes('Sigma within') && !names('normal').some((name) => name.startsWith('Percentiles')));
  assert.ok(!names('empirical').includes('Sigma within') && names('empirical').some((name) => name.startsWith('Percentiles')));
});

test('files of two formats that end alike have names of their own', () => {
  assert.deepEqual((['csv', 'points', 'dfq', 'html'] as const).map((format) => fileNameOf('D12', format)), ['D12.csv', 'D12-points.csv', 'D12.dfq', 'D12.html']);
});

test('the latest runs under a value come first', () => {
  assert.deepEqual(latestRuns(['a', 'b', 'c'], 2), ['c', 'b']);
  assert.deepEqual(latestRuns(['a'], 10), ['a']);
});
