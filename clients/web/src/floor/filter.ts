// Which machines the floor shows, and in which order. Pure.
import type { Machine, Run } from '../../generated/api';
import { stateOf, type Tone } from '../live/machine_state';

/// In the order of the buttons: what needs a person first.
export const kTones: Tone[] = ['alarm', 'waiting', 'running', 'ready', 'done', 'offline'];

export interface FloorFilter {
  text: string;
  /// null: every state.
  tone: Tone | null;
}

export function readFilter(query: URLSearchParams): FloorFilter {
  const tone = query.get('state') as Tone | null;
  return { text: query.get('filter') ?? '', tone: tone && kTones.includes(tone) ? tone : null };
}

export function filterQuery(filter: FloorFilter): Record<string, string> {
  return { filter: filter.text, state: filter.tone ?? '' };
}

export interface FloorList {
  /// By name, numbers as numbers: lathe-2 before lathe-10.
  names: string[];
  all: number;
  /// Of the machines that fit the text.
  counts: Record<Tone, number>;
}

const byName = new Intl.Collator('en', { numeric: true });

export function listFloor(machines: ReadonlyMap<string, Machine>, runOf: (machine: Machine) => Run | undefined, filter: FloorFilter): FloorList {
  const words = filter.text.toLowerCase().split(/\s+/).filter((word) => word !== '');
  const counts: Record<Tone, number> = { alarm: 0, waiting: 0, running: 0, ready: 0, done: 0, offline: 0 };
  const names: string[] = [];
  for (const machine of machines.values()) {
    const about = [machine.name, machine.control, machine.description, machine.status?.program].join(' ').toLowerCase();
    if (!words.every((word) => about.includes(word))) continue;
    const { tone } = stateOf(machine, runOf(machine));
    ++counts[tone];
    if (filter.tone === null || filter.tone === tone) names.push(machine.name);
  }
  return { names: names.sort(byName.compare), all: machines.size, counts };
}
