// Addresses of views and paths of requests: names come from others and may hold anything. And every language says everything.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ApiError, pathOf, send, withQuery } from '../../src/api/request';
import { addressOf, parseRoute } from '../../src/app/route';
import { de } from '../../src/texts/de';
import { en } from '../../src/texts/en';

const kHostile = ['O0100', '../../server', 'a/b?c#d', '<img src=x onerror=alert(1)>', '%2e%2e', 'Länge 5 %', '"\'&'];

for (const name of kHostile) {
  test(`a view's address carries ${name}`, () => {
    const route = parseRoute(addressOf('programs', [name, '3'], { at: name }));
    assert.deepEqual([route.view, route.path, route.query.get('at')], ['programs', [name, '3'], name]);
  });
  test(`a request's path keeps ${name} in its segment`, () => {
    const segments = pathOf('programs', name, 'content').split('/');
    assert.deepEqual(segments.slice(1, 4), ['api', 'v1', 'programs']);
    assert.equal(decodeURIComponent(segments[4]!), name);
    assert.equal(segments.length, 6);
  });
}

test('an empty address is the floor, and a broken one does no harm', () => {
  assert.equal(parseRoute('').view, 'floor');
  assert.equal(parseRoute('#/floor?state=alarm').query.get('state'), 'alarm');
  assert.deepEqual(parseRoute('#/machine/50%').path, ['50%']);
});

test('a query leaves out what is not given', () => {
  assert.equal(withQuery('/x', { a: null, b: undefined, c: '' }), '/x');
  assert.equal(withQuery('/x', { a: 0, b: 'c d&' }), '/x?a=0&b=c+d%26');
});

function keysOf(value: unknown, path = ''): string[] {
  if (typeof value !== 'object' || value === null) return [`${path}:${typeof value}`];
  return Object.entries(value).flatMap(([key, member]) => keysOf(member, `${path}.${key}`));
}

test('every language has every text, and none is empty', () => {
  assert.deepEqual(keysOf(de).sort(), keysOf(en).sort());
  const empty = [de, en].flatMap((texts) => JSON.stringify(texts).match(/""/g) ?? []);
  assert.deepEqual(empty, []);
});

/// A server that is frozen takes a request, and never answers.
test('a command without an answer is given up after its limit, and is not sent again', async () => {
  let sent = 0;
  const awake = setInterval(() => undefined, 1000); // node does not wait for the limit by itself
  globalThis.fetch = ((_path: string, init: RequestInit) => new Promise((_answer, refuse) => {
    ++sent;
    init.signal!.addEventListener('abort', () => refuse(new Error('aborted')));
  })) as typeof fetch;
  await assert.rejects(send('POST', pathOf('runs', 'r', 'commands'), { json: { action: 'hold' } }, 20), (failure) => failure instanceof ApiError && failure.status === 0);
  clearInterval(awake);
  assert.equal(sent, 1);
});
