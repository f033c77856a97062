// How far a revision is on its way to the machines: a word on a color.
import type { Revision } from '../../generated/api';
import type { Tone } from '../live/machine_state';
import { texts } from '../texts/texts';

const kTones: Record<Revision['state'], Tone> = { draft: 'offline', in_review: 'waiting', approved: 'ready', released: 'running', withdrawn: 'alarm' };

/// What a machine has sent is not even a draft before it is accepted.
export function RevisionPill({ revision }: { revision: { state: Revision['state']; held: boolean } }) {
  if (revision.held) return <span class="pill waiting">{texts().programs.pending(1)}</span>;
  return <span class={`pill ${kTones[revision.state]}`}>{texts().release.states[revision.state]}</span>;
}
