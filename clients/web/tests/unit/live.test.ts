// The logic of the floor: events from any pieces, a machine's state in a word, the progress of a run, the list and its filter.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { filterQuery, listFloor, readFilter } from '../../src/floor/filter';
import { EventParser } from '../../src/live/event_parser';
import { questionOf, stateOf } from '../../src/live/machine_state';
import { durationText, percentDigits, progressOf } from '../../src/live/progress';
import { bufferedText } from '../../src/texts/texts';
import { machine, run, status } from './samples';

test('an event stream may be cut anywhere', () => {
  const text = ': alive\n\nevent: machine\ndata: {"a":\ndata: 1}\n\nevent: run\r\ndata:x\r\n\r\ndata: alone\n\nevent: empty\n\n';
  const expected = [{ name: 'machine', data: '{"a":\n1}' }, { name: 'run', data: 'x' }, { name: 'message', data: 'alone' }];
  for (let length = 1; length <= text.length; ++length) {
    const parser = new EventParser();
    const events = [];
    for (let at = 0; at < text.length; at += length) events.push(...parser.take(text.slice(at, at + length)));
    assert.deepEqual(events, expected, `pieces of ${length}`);
  }
});

test('an event that is not complete is not given', () => {
  assert.deepEqual(new EventParser().take('event: machine\ndata: {}\n'), []);
});

test('a machine without connection is old news, whatever its status was', () => {
  assert.equal(stateOf(machine({ connected: false }, { execution: 'ACTIVE' })).word, 'disconnected');
  assert.equal(stateOf(machine({ stale: true }, { execution: 'ACTIVE' })).word, 'stale');
  assert.equal(stateOf({ ...machine(), status: null }).word, 'unknown');
});

test('the emergency stop comes before everything', () => {
  assert.deepEqual(stateOf(machine({}, { execution: 'STOPPED', emergency_stop: true, message: 'EMERGENCY STOP' })),
    { tone: 'alarm', word: 'emergencyStop', message: 'EMERGENCY STOP' });
});

test('only the run distinguishes an alarm from an abort', () => {
  const stopped = machine({}, { execution: 'STOPPED', message: null });
  assert.deepEqual(stateOf(stopped, run({ state: 'alarmed', reason: 'PS005' })), { tone: 'alarm', word: 'alarm', message: 'PS005' });
  assert.equal(stateOf(stopped, run({ state: 'interrupted' })).word, 'interruptedRun');
  assert.equal(stateOf(stopped, run({ state: 'aborted' })).tone, 'ready');
  assert.equal(stateOf(stopped).word, 'stopped');
});

for (const [waitsFor, word] of [['cycle_start', 'waitsForCycleStart'], ['answer', 'waitsForAnswer'], ['text', 'waitsForText'], ['disk', 'waitsForDisk'], [null, 'waits']] as const) {
  test(`WAIT for ${waitsFor} is shown as ${word}`, () => {
    assert.equal(stateOf(machine({}, { execution: 'WAIT', waits_for: waitsFor })).word, word);
  });
}

test('a question is the text after "asks: "', () => {
  assert.equal(questionOf(machine({}, { execution: 'WAIT', waits_for: 'answer', message: 'asks: DIAMETER' })), 'DIAMETER');
  assert.equal(questionOf(machine({}, { execution: 'WAIT', waits_for: 'text', message: 'asks: DIAMETER' })), null);
});

test('the time left follows from what was executed', () => {
  const now = status({ execution: 'ACTIVE', offset: 250, total_bytes: 1000, sent: 600, time: '2026-11-23T12:01:00Z', buffered_seconds: 2 });
  assert.deepEqual(progressOf(now, run({ started: '2026-11-23T12:00:00Z' })), { fraction: 0.25, secondsLeft: 180 });
});

test('the time left is not guessed before anything is known', () => {
  const now = status({ execution: 'ACTIVE', offset: 1, total_bytes: 1000, sent: 600, time: '2026-11-23T12:00:01Z' });
  assert.equal(progressOf(now, run({ started: '2026-11-23T12:00:00Z' }))?.secondsLeft, null);
  assert.equal(progressOf(now)?.secondsLeft, null);
  assert.equal(progressOf(status({ ...now, run: 'another' }), run({}))?.secondsLeft, null);
});

test('a program that is buffered to its end takes as long as its motion', () => {
  const now = status({ execution: 'ACTIVE', offset: 1, total_bytes: 1000, sent: 1000, buffered_seconds: 90 });
  assert.equal(progressOf(now, run({ started: now.time }))?.secondsLeft, 90);
});

test('a run that is held has no time left, and no run has no progress', () => {
  assert.equal(progressOf(status({ execution: 'FEED_HOLD', offset: 500, total_bytes: 1000 }), run({}))?.secondsLeft, null);
  assert.equal(progressOf(status({ run: null }), undefined), null);
});

test('durations are rounded as estimates', () => {
  assert.deepEqual([4.4, 59.4, 61, 3599, 3600, 11_100].map(durationText), ['4 s', '59 s', '1 min', '1 h 00 min', '1 h 00 min', '3 h 05 min']);
  assert.deepEqual([0, 0.004, 0.5].map(percentDigits), [0, 1, 0]);
});

test('the floor is sorted as people count, and its filter fits all words', () => {
  const machines = new Map(['lathe-10', 'lathe-2', 'mill-1'].map((name) => [name, machine({ name, description: name === 'mill-1' ? 'Five Axes' : null })]));
  const list = (text: string, tone: 'ready' | null = null) => listFloor(machines, () => undefined, { text, tone }).names;
  assert.deepEqual(list(''), ['lathe-2', 'lathe-10', 'mill-1']);
  assert.deepEqual(list('axes FIVE'), ['mill-1']);
  assert.deepEqual(list('axes lathe'), []);
});

test('counts are of what fits the text, whatever state is chosen', () => {
  const machines = new Map([
    ['a', machine({ name: 'a' }, { execution: 'ACTIVE' })], ['b', machine({ name: 'b' }, { execution: 'FEED_HOLD' })], ['c', machine({ name: 'c', connected: false })]]);
  const list = listFloor(machines, () => undefined, { text: '', tone: 'waiting' });
  assert.deepEqual(list.names, ['b']);
  assert.deepEqual(list.counts, { alarm: 0, waiting: 1, running: 1, ready: 0, done: 0, offline: 1 });
});

test('a filter survives its address, and a state that does not exist is none', () => {
  const filter = { text: 'a&b=<c>', tone: 'alarm' as const };
  assert.deepEqual(readFilter(new URLSearchParams(filterQuery(filter))), filter);
  assert.equal(readFilter(new URLSearchParams('state=broken')).tone, null);
});

test('what is buffered is seconds of motion, and minutes of a line', () => {
  assert.equal(bufferedText(7.25), '7.3 s');
  assert.equal(bufferedText(119.9), '119.9 s');
  assert.equal(bufferedText(606), '10.1 min');
});
