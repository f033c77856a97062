// What a machine's card and its page say about it in one word and one color. Pure.
import type { Machine, Run } from '../../generated/api';

/// Each tone is a color; the word beside it says the same to those who do not see the color.
export type Tone = 'running' | 'waiting' | 'alarm' | 'ready' | 'done' | 'offline';

export type StateWord =
  | 'disconnected' | 'stale' | 'unknown' | 'emergencyStop' | 'alarm' | 'interruptedRun' | 'stopped' | 'active' | 'feedHold' | 'programStopped'
  | 'optionalStop' | 'singleBlock' | 'completed' | 'ready' | 'waits' | 'waitsForCycleStart' | 'waitsForAnswer' | 'waitsForText' | 'waitsForDisk';

export interface MachineState {
  tone: Tone;
  word: StateWord;
  /// The control's own words: an alarm, a question, a reason.
  message: string | null;
}

const kWaits: Record<string, StateWord> = {
  cycle_start: 'waitsForCycleStart', answer: 'waitsForAnswer', text: 'waitsForText', disk: 'waitsForDisk',
};

/// `run`: the machine's latest one, if it is known. It alone distinguishes an alarm from an abort.
export function stateOf(machine: Machine, run?: Run): MachineState {
  const status = machine.status;
  if (!machine.connected) return { tone: 'offline', word: 'disconnected', message: null };
  if (machine.stale) return { tone: 'offline', word: 'stale', message: null };
  if (!status) return { tone: 'offline', word: 'unknown', message: null };
  const as = (tone: Tone, word: StateWord): MachineState => ({ tone, word, message: status.message });
  if (status.emergency_stop) return as('alarm', 'emergencyStop');
  switch (status.execution) {
    case 'ACTIVE': return as('running', 'active');
    case 'FEED_HOLD': return as('waiting', 'feedHold');
    case 'PROGRAM_STOPPED': return as('waiting', 'programStopped');
    case 'OPTIONAL_STOP': return as('waiting', 'optionalStop');
    case 'INTERRUPTED': return as('waiting', 'singleBlock');
    case 'WAIT': return as('waiting', kWaits[status.waits_for ?? ''] ?? 'waits');
    case 'PROGRAM_COMPLETED': return as('done', 'completed');
    case 'READY': return as('ready', 'ready');
    case 'STOPPED': return { ...as(...stopOf(run)), message: status.message ?? run?.reason ?? null };
  }
}

function stopOf(run?: Run): [Tone, StateWord] {
  if (run?.state === 'alarmed') return ['alarm', 'alarm'];
  if (run?.state === 'interrupted') return ['waiting', 'interruptedRun'];
  return ['ready', 'stopped'];
}

/// The text after "asks: " when the control waits for an answer.
export function questionOf(machine: Machine): string | null {
  const status = machine.status;
  if (!machine.connected || status?.waits_for !== 'answer') return null;
  return (status.message ?? '').replace(/^asks: /, '');
}
