// The import queue: the class of an edit, also while it is not known.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { classOf, toneOf } from '../../src/imports/class_text';
import { importOf } from './samples';

test('what the server has not looked at yet is being compared, what it could not compare is not known', () => {
  assert.equal(classOf(importOf({ class: null, compared: null })), 'comparing');
  assert.equal(classOf(importOf({ class: null })), 'unknown');
  assert.equal(classOf(importOf({ class: null, compared: null, state: 'rejected' })), 'unknown');
  assert.equal(classOf(importOf({ class: 'geometry' })), 'geometry');
});

test('what cuts differently warns, and what is not known warns most', () => {
  assert.deepEqual((['comment', 'feed_and_speed', 'geometry', 'unknown'] as const).map(toneOf), ['ready', 'waiting', 'alarm', 'alarm']);
});
