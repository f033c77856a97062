// The commands that the API has for a machine and for its run.
import type { CommandRequest, Run } from '../../generated/api';
import { pathOf, send } from '../api/request';

/// Needs a run: hold, resume, abort, answer.
export function commandRun(run: string, command: CommandRequest): Promise<unknown> {
  return send('POST', pathOf('runs', run, 'commands'), { json: command });
}

/// The machine's panel: switches and overrides, with or without a run.
export function commandMachine(machine: string, command: CommandRequest): Promise<unknown> {
  return send('POST', pathOf('machines', machine, 'commands'), { json: command });
}

export interface StartRequest {
  machine: string;
  program: string;
  revision: number | null;
  /// N120, L7, B4096, T3 or +25; empty: from the beginning.
  from: string;
}

export function startRun({ machine, program, revision, from }: StartRequest): Promise<Run> {
  const request = { machine, program, ...(revision !== null && { revision }), ...(from !== '' && { from }) };
  return send<Run>('POST', pathOf('runs'), { json: request });
}

/// `at` empty: after the block executed last.
export function restartRun(run: string, at: string): Promise<Run> {
  return send<Run>('POST', pathOf('runs', run, 'restart'), { json: at === '' ? {} : { at } });
}
