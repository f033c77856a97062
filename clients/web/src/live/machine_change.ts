// A machine's state as the event stream brings it: whole once, then what has changed (GET /api/v1/events?changes=yes). Pure.
import type { Machine } from '../../generated/api';

/// `version` grows with each change; a machine that was asked for by itself has none.
export type KnownMachine = Machine & { version?: number };

/// What has changed since version `after`: members of the machine, and of the objects in it.
export interface MachineChange {
  name: string;
  after: number;
  version: number;
  [member: string]: unknown;
}

type Members = { [member: string]: unknown };

const isObject = (value: unknown): value is Members => typeof value === 'object' && value !== null && !Array.isArray(value);

/// Objects are joined member by member; any other value, null too, takes the place of the one there.
function joined(before: Members, change: Members): Members {
  const now = { ...before };
  for (const name in change) {
    const value = change[name];
    const old = before[name];
    now[name] = isObject(value) && isObject(old) ? joined(old, value) : value;
  }
  return now;
}

/// null: the change is about another version than this one, so one was missed.
export function changedMachine(machine: KnownMachine | undefined, { after, ...change }: MachineChange): KnownMachine | null {
  return machine?.version === after ? (joined(machine, change) as KnownMachine) : null;
}
