// The state of a machine: a word on a color.
import type { MachineState } from '../live/machine_state';
import { texts } from '../texts/texts';

export function StatePill({ state }: { state: MachineState }) {
  return <span class={`pill ${state.tone}`}>{texts().states[state.word]}</span>;
}
