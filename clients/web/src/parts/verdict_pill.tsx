// Whether a part, or a measurement of it, is good: a word on a color.
import type { Part } from '../../generated/api';
import type { Tone } from '../live/machine_state';
import { texts } from '../texts/texts';

export const kVerdicts: Array<Part['verdict']> = ['good', 'rework', 'scrap', 'unknown'];
export const kVerdictTones: Record<Part['verdict'], Tone> = { good: 'running', unknown: 'offline', rework: 'waiting', scrap: 'alarm' };

export function VerdictPill({ verdict }: { verdict: Part['verdict'] }) {
  return <span class={`pill ${kVerdictTones[verdict]}`}>{texts().measurements.verdicts[verdict]}</span>;
}
