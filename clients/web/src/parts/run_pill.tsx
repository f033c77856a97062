// The state of a run: a word on a color.
import type { Run } from '../../generated/api';
import type { Tone } from '../live/machine_state';
import { texts } from '../texts/texts';

const kTones: Record<Run['state'], Tone> = {
  ordered: 'waiting', active: 'running', completed: 'done', aborted: 'offline', alarmed: 'alarm', interrupted: 'waiting', refused: 'alarm', tested: 'ready',
};

export function RunPill({ state }: { state: Run['state'] }) {
  return <span class={`pill ${kTones[state]}`}>{texts().runStates[state]}</span>;
}
