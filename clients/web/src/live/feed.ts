// What the page knows of the shop, kept current by one event stream: every machine, each one's latest run, and what machines sent that
// is not decided yet, and corrections that wait for a decision. Views read it and are notified when their part has changed, at most eight times a second,
// so that a thousand busy machines stay fluid. Of measured parts and job queues it keeps nothing: a view loads
// what it shows when one has changed.
import type { Import, Imports, JobChange, Machine, Machines, Offset, Offsets, Part, Record as ReportRecord, Run, Runs } from '../../generated/api';
import { ApiError, get, pathOf } from '../api/request';
import type { StreamEvent } from './event_parser';
import { readEvents } from './event_stream';
import { changedMachine, type KnownMachine, type MachineChange } from './machine_change';
import { stateOf, type MachineState } from './machine_state';

export type Link = { state: 'connecting' } | { state: 'live' } | { state: 'lost' | 'signedOut'; since: Date };

/// What a view listens to: the list of machines and their states, the link, the import queue, pending corrections,
/// measured parts; or of one machine its status, its runs, its job queue, its measured parts.
export type Topic = 'machines' | 'link' | 'runs' | 'imports' | 'offsets' | 'parts' | `${'machine' | 'runs' | 'jobs' | 'parts'}:${string}`;

/// A server reports what moves on in rounds, with a thousand machines a fifth of a second from one to the next. Views are notified when a round has come in, which
/// is when nothing more has come for a moment, and not again before the next one can have.
const kQuietMs = 25;
const kLongestGatherMs = 100;
const kShortestPauseMs = 120;
const kDelaysMs = [250, 500, 1000, 2000, 4000];
const kMaxRuns = 1000;
const kMaxImports = 1000;
const kMaxOffsets = 1000;
const kMachinesAtOnce = 1000;

/// Page by page: the server gives no more at once.
async function allMachines(signal: AbortSignal): Promise<Machine[]> {
  const all: Machine[] = [];
  for (;;) {
    const { machines } = await get<Machines>(pathOf('machines'), { limit: kMachinesAtOnce, after: all.at(-1)?.name }, signal);
    all.push(...machines);
    if (machines.length < kMachinesAtOnce) return all;
  }
}

export const importKey = (import_: { program: string; revision: number }) => `import ${import_.revision} ${import_.program}`;

const offsetKey = (id: number) => `offset ${id}`;

export class Feed {
  readonly machines = new Map<string, KnownMachine>();
  /// By machine.
  readonly runs = new Map<string, Run>();
  /// Pending ones, by importKey.
  readonly imports = new Map<string, Import>();
  /// Pending corrections, by id.
  readonly offsets = new Map<number, Offset>();
  link: Link = { state: 'connecting' };
  /// How often views were notified: a view that is drawn and does not listen yet sees by it that it missed something.
  notified = 0;

  private readonly listeners = new Map<Topic, Set<() => void>>();
  private readonly recordListeners = new Set<(record: ReportRecord) => void>();
  private readonly changed = new Set<Topic>();
  /// Machines, ids of runs, keys of imports and of corrections of which an event has come since the stream was opened: newer than any answer to a request.
  private readonly fresh = new Set<string>();
  private flushing = false;
  /// When the views were notified last, are at the latest, and when something was noted last (ms, of performance.now()).
  private flushed = 0;
  private flushUntil = 0;
  private noted = 0;
  private ending: AbortController | null = null;

  /// Until pause() or end(): reads, and reconnects whenever the stream ends.
  begin(): void {
    if (this.ending) return;
    this.ending = new AbortController();
    void this.follow(this.ending.signal);
  }

  /// The session has ended: what is known stays, and is old.
  pause(): void {
    this.stop();
    this.setLink({ state: 'signedOut', since: new Date() });
  }

  end(): void {
    this.stop();
    this.machines.clear();
    this.runs.clear();
    this.imports.clear();
    this.offsets.clear();
    this.link = { state: 'connecting' };
  }

  private stop(): void {
    this.ending?.abort();
    this.ending = null;
  }

  on(topic: Topic, listener: () => void): () => void {
    const set = this.listeners.get(topic) ?? new Set();
    this.listeners.set(topic, set.add(listener));
    return () => {
      set.delete(listener);
      if (set.size === 0) this.listeners.delete(topic);
    };
  }

  /// Every record as it comes.
  onRecord(listener: (record: ReportRecord) => void): () => void {
    this.recordListeners.add(listener);
    return () => this.recordListeners.delete(listener);
  }

  stateOf(machine: Machine): MachineState {
    return stateOf(machine, this.runOf(machine));
  }

  /// The run that the machine's status is about.
  runOf(machine: Machine): Run | undefined {
    const run = this.runs.get(machine.name);
    return machine.status?.run && run?.id !== machine.status.run ? undefined : run;
  }

  private async follow(signal: AbortSignal): Promise<void> {
    for (let failures = 0; !signal.aborted; ++failures) {
      let wasOpen = false;
      try {
        const open = () => {
          wasOpen = true;
          this.fresh.clear();
          void this.load(signal);
        };
        await readEvents(`${pathOf('events')}?changes=yes`, signal, open, (event) => this.take(event));
      } catch (failure) {
        if (failure instanceof ApiError && failure.status === 401) return; // the session has ended
      }
      if (signal.aborted) return;
      if (this.link.state !== 'lost') this.setLink({ state: 'lost', since: new Date() });
      if (wasOpen) failures = 0;
      await pause(kDelaysMs[Math.min(failures, kDelaysMs.length - 1)]!, signal);
    }
  }

  /// The whole state, once the stream is open: what changes meanwhile arrives as an event, which is newer.
  private async load(signal: AbortSignal): Promise<void> {
    try {
      const [machines, { runs }, { imports }, { offsets }] = await Promise.all([
        allMachines(signal), get<Runs>(pathOf('runs'), { limit: kMaxRuns }, signal),
        get<Imports>(pathOf('imports'), { limit: kMaxImports }, signal), get<Offsets>(pathOf('offsets'), { state: 'pending', limit: kMaxOffsets }, signal)]);
      const present = new Set(machines.map((machine) => machine.name));
      for (const name of this.machines.keys()) if (!present.has(name)) this.machines.delete(name);
      for (const machine of machines) if (!this.fresh.has(machine.name)) this.takeMachine(machine);
      for (const run of runs.reverse()) if (!this.fresh.has(run.id)) this.takeRun(run);
      for (const key of this.imports.keys()) if (!this.fresh.has(key)) this.imports.delete(key);
      for (const import_ of imports) if (!this.fresh.has(importKey(import_))) this.takeImport(import_);
      for (const id of this.offsets.keys()) if (!this.fresh.has(offsetKey(id))) this.offsets.delete(id);
      for (const offset of offsets) if (!this.fresh.has(offsetKey(offset.id))) this.takeOffset(offset);
      this.note('machines');
      this.note('imports');
      this.note('offsets');
      this.setLink({ state: 'live' });
    } catch {
      // The stream ends too, and both begin again.
    }
  }

  private take(event: StreamEvent): void {
    if (event.name === 'machine') {
      const machine = JSON.parse(event.data) as KnownMachine;
      this.fresh.add(machine.name);
      this.takeMachine(machine);
    }
    if (event.name === 'change') {
      const change = JSON.parse(event.data) as MachineChange;
      const machine = changedMachine(this.machines.get(change.name), change);
      if (!machine) throw new Error(`${change.name}: a change of version ${change.after} was missed`); // the stream begins again, with whole states
      this.takeMachine(machine);
    }
    if (event.name === 'run') {
      const run = JSON.parse(event.data) as Run;
      this.fresh.add(run.id);
      this.takeRun(run);
    }
    if (event.name === 'import') {
      const import_ = JSON.parse(event.data) as Import;
      this.fresh.add(importKey(import_));
      this.takeImport(import_);
    }
    if (event.name === 'offset') {
      const offset = JSON.parse(event.data) as Offset;
      this.fresh.add(offsetKey(offset.id));
      this.takeOffset(offset);
    }
    if (event.name === 'part') {
      this.note('parts');
      this.note(`parts:${(JSON.parse(event.data) as Part).machine}`);
    }
    if (event.name === 'job') this.note(`jobs:${(JSON.parse(event.data) as JobChange).machine}`);
    if (event.name !== 'record') return;
    const record = JSON.parse(event.data) as ReportRecord;
    for (const listener of this.recordListeners) listener(record);
  }

  private takeMachine(machine: KnownMachine): void {
    const before = this.machines.get(machine.name);
    this.machines.set(machine.name, machine);
    this.note(`machine:${machine.name}`);
    if (!before || this.stateOf(before).word !== this.stateOf(machine).word) this.note('machines');
  }

  private takeRun(run: Run): void {
    const before = this.runs.get(run.machine);
    if (before && before.created > run.created) return;
    this.runs.set(run.machine, run);
    this.note(`machine:${run.machine}`);
    this.note('runs');
    this.note(`runs:${run.machine}`);
    if (before?.state !== run.state) this.note('machines');
  }

  private takeImport(import_: Import): void {
    if (import_.state === 'pending') this.imports.set(importKey(import_), import_);
    else this.imports.delete(importKey(import_));
    this.note('imports');
  }

  private takeOffset(offset: Offset): void {
    if (offset.state === 'pending') this.offsets.set(offset.id, offset);
    else this.offsets.delete(offset.id);
    this.note('offsets');
  }

  private setLink(link: Link): void {
    this.link = link;
    this.note('link');
  }

  private note(topic: Topic): void {
    const now = performance.now();
    this.changed.add(topic);
    this.noted = now;
    if (this.flushing) return;
    this.flushing = true;
    this.flushUntil = Math.max(now + kLongestGatherMs, this.flushed + kShortestPauseMs);
    setTimeout(() => this.flushWhenQuiet(), Math.max(kQuietMs, this.flushed + kShortestPauseMs - now));
  }

  private flushWhenQuiet(): void {
    const now = performance.now();
    const due = Math.min(this.noted + kQuietMs, this.flushUntil);
    if (now + 1 < due) setTimeout(() => this.flushWhenQuiet(), due - now);
    else this.flush();
  }

  private flush(): void {
    this.flushing = false;
    this.notified += 1;
    this.flushed = performance.now();
    const topics = [...this.changed];
    this.changed.clear();
    for (const topic of topics) for (const listener of [...(this.listeners.get(topic) ?? [])]) listener();
  }
}

function pause(ms: number, signal: AbortSignal): Promise<void> {
  return new Promise((done) => {
    const timer = setTimeout(done, ms);
    signal.addEventListener('abort', () => { clearTimeout(timer); done(); }, { once: true });
  });
}

export const feed = new Feed();
