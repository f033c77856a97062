// The feed against a server in this test's hands: what it knows when answers and events overtake each other.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Feed } from '../../src/live/feed';
import { importOf, machine, offset, run } from './samples';

/// Answers requests when the test says so; events go to the readers of the stream.
class FakeServer {
  opened = 0;
  private events!: ReadableStreamDefaultController<Uint8Array>;
  private readonly waiting: Array<() => void> = [];

  constructor(machines: unknown[], runs: unknown[], imports: unknown[] = [], offsets: unknown[] = []) {
    const answer = (body: unknown) => new Response(JSON.stringify(body));
    globalThis.fetch = (async (path: string, init: RequestInit) => {
      if (path.endsWith('/events?changes=yes')) {
        ++this.opened;
        init.signal!.addEventListener('abort', () => this.events.error(new Error('aborted')));
        return new Response(new ReadableStream({ start: (controller) => { this.events = controller; } }));
      }
      await new Promise<void>((done) => this.waiting.push(done));
      return answer(path.includes('/machines') ? { machines } : path.includes('/imports') ? { imports } : path.includes('/offsets') ? { offsets } : { runs });
    }) as typeof fetch;
  }

  send(name: string, data: unknown): void {
    this.events.enqueue(new TextEncoder().encode(`event: ${name}\ndata: ${JSON.stringify(data)}\n\n`));
  }

  async isAsked(): Promise<void> {
    await until(() => this.waiting.length >= 4);
  }

  answerAll(): void {
    this.waiting.splice(0).forEach((answer) => answer());
  }
}

(globalThis as { document?: unknown }).document = { hidden: true };

/// Waits for a minute at most: a busy computer is slow, and a wait without an end would keep the process.
async function until(holds: () => boolean): Promise<void> {
  const end = Date.now() + 60_000;
  while (!holds()) {
    if (Date.now() > end) throw new Error(`not within a minute: ${holds}`);
    await new Promise((done) => setTimeout(done, 1));
  }
}

test('an answer that an event has overtaken changes nothing', async () => {
  const server = new FakeServer([machine({}, { execution: 'ACTIVE' })], [run({ state: 'active' })]);
  const feed = new Feed();
  feed.begin();
  await server.isAsked();
  server.send('run', run({ state: 'alarmed' }));
  server.send('machine', machine({}, { execution: 'STOPPED' }));
  await until(() => feed.machines.size === 1);
  server.answerAll();
  await until(() => feed.link.state === 'live');
  assert.equal(feed.stateOf(feed.machines.get('lathe-1')!).word, 'alarm');
  feed.end();
});

test('more machines than one answer holds are asked for page by page', async () => {
  const names = Array.from({ length: 1001 }, (_, number) => `m${String(number).padStart(4, '0')}`);
  const server = new FakeServer([], []);
  const inner = globalThis.fetch;
  globalThis.fetch = (async (path: string, init: RequestInit) => {
    if (!path.includes('/machines')) return inner(path, init);
    const query = new URL(path, 'http://server').searchParams;
    const rest = names.filter((name) => name > (query.get('after') ?? '')).slice(0, Number(query.get('limit') ?? 100));
    return new Response(JSON.stringify({ machines: rest.map((name) => ({ ...machine({}, {}), name })) }));
  }) as typeof fetch;
  const feed = new Feed();
  feed.begin();
  await until(() => { server.answerAll(); return feed.link.state === 'live'; });
  assert.equal(feed.machines.size, 1001);
  feed.end();
});

test('what no event has brought comes from the answers', async () => {
  const server = new FakeServer([machine({}, { execution: 'STOPPED' })], [run({ state: 'alarmed' })]);
  const feed = new Feed();
  feed.begin();
  await server.isAsked();
  server.answerAll();
  await until(() => feed.link.state === 'live');
  assert.equal(feed.stateOf(feed.machines.get('lathe-1')!).word, 'alarm');
  feed.end();
});

test('what waits is what was listed and has come since, without what was decided', async () => {
  const server = new FakeServer([], [], [importOf({ revision: 1 }), importOf({ revision: 2 })]);
  const feed = new Feed();
  const waiting = () => [...feed.imports.values()].map(({ revision }) => revision).sort();
  feed.begin();
  await server.isAsked();
  server.send('import', importOf({ revision: 2, state: 'rejected' }));
  server.send('import', importOf({ revision: 3 }));
  await until(() => feed.imports.size === 1);
  server.answerAll();
  await until(() => feed.link.state === 'live');
  assert.deepEqual(waiting(), [1, 3]);
  server.send('import', importOf({ revision: 3, state: 'accepted_as' }));
  await until(() => feed.imports.size === 1);
  assert.deepEqual(waiting(), [1]);
  feed.end();
});

test('pending corrections are what was listed and has come since; a measured part is noted', async () => {
  const server = new FakeServer([], [], [], [offset({ id: 1 }), offset({ id: 2 })]);
  const feed = new Feed();
  let parts = 0;
  feed.on('parts', () => ++parts);
  feed.begin();
  await server.isAsked();
  server.send('offset', offset({ id: 2, state: 'superseded' }));
  server.send('offset', offset({ id: 3 }));
  server.send('part', { id: 7 });
  await until(() => feed.offsets.size === 1);
  server.answerAll();
  await until(() => feed.link.state === 'live');
  assert.deepEqual([...feed.offsets.keys()].sort(), [1, 3]);
  await until(() => parts > 0);
  feed.end();
});

test('a change of a queue, and a run, are told to those of that machine alone', async () => {
  const server = new FakeServer([machine(), machine({ name: 'mill-1' })], []);
  const feed = new Feed();
  const told: string[] = [];
  for (const topic of ['jobs:lathe-1', 'jobs:mill-1', 'runs:lathe-1', 'runs:mill-1'] as const) feed.on(topic, () => told.push(topic));
  feed.begin();
  await server.isAsked();
  server.answerAll();
  await until(() => feed.link.state === 'live');
  server.send('job', { machine: 'mill-1', change: 'held', job: null, hold: null });
  await until(() => told.length === 1);
  server.send('run', run());
  await until(() => told.length === 2);
  assert.deepEqual(told, ['jobs:mill-1', 'runs:lathe-1']);
  feed.end();
});

test('what has changed of a machine is joined with what is known of it', async () => {
  const server = new FakeServer([], []);
  const feed = new Feed();
  feed.begin();
  await server.isAsked();
  server.send('machine', { version: 4, ...machine({}, { execution: 'ACTIVE', line: 1 }) });
  server.send('change', { after: 4, version: 6, name: 'lathe-1', status: { line: 2 } });
  await until(() => feed.machines.get('lathe-1')?.version === 6);
  assert.deepEqual(feed.machines.get('lathe-1'), { version: 6, ...machine({}, { execution: 'ACTIVE', line: 2 }) });
  assert.equal(server.opened, 1);
  feed.end();
});

test('a change after a missed one is not joined: the stream begins again', async () => {
  const server = new FakeServer([], []);
  const feed = new Feed();
  feed.begin();
  await server.isAsked();
  server.send('machine', { version: 4, ...machine({}, { line: 1 }) });
  server.send('change', { after: 5, version: 6, name: 'lathe-1', status: { line: 2 } });
  await until(() => server.opened === 2);
  assert.equal(feed.machines.get('lathe-1')?.status?.line, 1);
  server.send('machine', { version: 6, ...machine({}, { line: 3 }) });
  await until(() => feed.machines.get('lathe-1')?.status?.line === 3);
  feed.end();
});

test('views are notified of a round together, and again only after a pause', async () => {
  const server = new FakeServer([], []);
  const feed = new Feed();
  const notified: number[] = [];
  feed.on('machine:lathe-1', () => notified.push(performance.now()));
  feed.begin();
  await server.isAsked();
  for (let line = 1; line <= 40; ++line) {
    server.send('machine', machine({}, { line }));
    await new Promise((done) => setTimeout(done, 10));
  }
  await until(() => feed.machines.get('lathe-1')?.status?.line === 40 && notified.length >= 2);
  const pauses = notified.slice(1).map((at, i) => at - notified[i]!);
  assert.ok(pauses.every((ms) => ms >= 119), `pauses of ${pauses.join(', ')} ms`);
  assert.ok(notified.length <= 6, `${notified.length} notifications of 40 changes within 0.4 s`);
  feed.end();
});
