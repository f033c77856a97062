// Values between their limits, and what is asked of the server for a list and for a chart.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { changeOf, stepLine, targetsOf, type PastValue } from '../../src/corrections/steps';
import { chartOf, choicesOf, filterOf, placeOf, utcOf } from '../../src/measurements/tolerance';
import { measurement } from './samples';

test('the limits are at a quarter and three quarters, and a value on one is in', () => {
  assert.deepEqual(placeOf(measurement({ lower: 0, upper: 2, nominal: 1, actual: 2 })), { actual: 0.75, nominal: 0.5, isOut: false });
  assert.deepEqual(placeOf(measurement({ lower: 0, upper: 2, nominal: null, actual: -100 })), { actual: 0, nominal: null, isOut: true });
});

test('a value without both limits has no place', () => {
  assert.deepEqual([{ lower: null }, { upper: null }, { lower: 1, upper: 1 }].map((limits) => placeOf(measurement(limits))), [null, null, null]);
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
  assert.equal(stepLine([1], { width: 100, height: 10 }), null);
});
