// What an edit of a machine is about, in a word, and how sure a decision about it is: the tone warns of what cuts differently. Pure.
import type { Import } from '../../generated/api';
import type { Tone } from '../live/machine_state';

type EditClass = NonNullable<Import['class']>;

const kTones: Record<EditClass, Tone> = {
  none: 'ready', comment: 'ready', same_motion: 'ready', feed_and_speed: 'waiting', offsets: 'waiting', geometry: 'alarm', other: 'alarm',
};

/// `comparing`: the server has not looked yet; `unknown`: it could not.
export type ShownClass = EditClass | 'comparing' | 'unknown';

export function classOf(import_: Pick<Import, 'class' | 'compared' | 'state'>): ShownClass {
  if (import_.class !== null) return import_.class;
  return import_.compared === null && import_.state === 'pending' ? 'comparing' : 'unknown';
}

export function toneOf(shown: ShownClass): Tone {
  if (shown === 'comparing') return 'offline';
  return shown === 'unknown' ? 'alarm' : kTones[shown];
}
