// The commands that the API has for a machine and for its run.
import type { CommandRequest, DatumRequest, JogDone, JogRequest, BegunRun, PositionSet, Run, RunRequest } from '../../generated/api';
import { pathOf, send } from '../api/request';

/// The server answers in 6 s, or 16 s where its database hangs. No second command is sent before: a hold or an abort must not wait for a server that is frozen.
const kLimitMs = 20_000;

/// Needs a run: hold, resume, abort, answer.
export function commandRun(run: string, command: CommandRequest): Promise<unknown> {
  return send('POST', pathOf('runs', run, 'commands'), { json: command }, kLimitMs);
}

/// The machine's panel: switches and overrides, with or without a run.
export function commandMachine(machine: string, command: CommandRequest): Promise<unknown> {
  return send('POST', pathOf('machines', machine, 'commands'), { json: command }, kLimitMs);
}

/// How a run begins that does not begin at the beginning. `ask`: the server refuses what would have to be decided, and names it.
export interface StartOptions {
  /// On a serial line: the skipped words on which the rest depends are sent first, or are in force at the control.
  head: 'ask' | 'send' | 'set';
  /// At a gateway: with which memory the skipped part is interpreted.
  memory: 'ask' | 'begin' | 'now';
  /// At a gateway: of a block that is executed more than once, from 1.
  pass: string;
}

export const kNoOptions: StartOptions = { head: 'ask', memory: 'ask', pass: '' };

export interface StartRequest {
  machine: string;
  program: string;
  revision: number | null;
  /// N120, L7, B4096, T3 or +25; empty: from the beginning.
  from: string;
  options?: StartOptions;
}

/// From the beginning nothing is skipped: the options say nothing then.
export function startBody({ machine, program, revision, from, options = kNoOptions }: StartRequest): RunRequest {
  const { head, memory, pass } = from === '' ? kNoOptions : options;
  return {
    machine, program, ...(revision !== null && { revision }), ...(from !== '' && { from }), ...(head !== 'ask' && { head }), ...(memory !== 'ask' && { memory }),
    ...(pass !== '' && { pass: Number(pass) }),
  };
}

export function startRun(request: StartRequest): Promise<Run> {
  return send<Run>('POST', pathOf('runs'), { json: startBody(request) });
}

/// Blocks keyed in at an idle machine (MDI), one a line.
export function keyIn(machine: string, text: string): Promise<BegunRun> {
  return send<BegunRun>('POST', pathOf('machines', machine, 'mdi'), { json: { text } });
}

/// `tool`: its length is set, else the datum.
export type PositionToSet = DatumRequest & { tool?: number };

/// From where the axes of a machine without a run are.
export function setPosition(machine: string, setting: PositionToSet): Promise<PositionSet> {
  return send<PositionSet>('POST', pathOf('machines', machine, setting.tool === undefined ? 'datum' : 'touch-off'), { json: setting });
}

/// One step of one axis of a machine without a run; the answer comes when it rests.
export function jog(machine: string, step: JogRequest): Promise<JogDone> {
  return send<JogDone>('POST', pathOf('machines', machine, 'jog'), { json: step }, kLimitMs);
}

/// `at` empty: after the block executed last.
export function restartRun(run: string, at: string): Promise<Run> {
  return send<Run>('POST', pathOf('runs', run, 'restart'), { json: at === '' ? {} : { at } });
}
