// What a revision calls, and whether it can be released with it. Pure.
import type { Closure } from '../../generated/api';

/// How the calls are read: the setup that binds codes to programs, and what a run computes.
export interface ClosureChoice {
  machine: string;
  /// As it is typed: "O0210, O0220@3".
  with: string;
}

export const kNoChoice: ClosureChoice = { machine: '', with: '' };

export function namesOf(typed: string): string[] {
  return typed.split(/[,\s]+/).filter((name) => name !== '');
}

/// Nothing is missing, and what is called is released already or can be with it.
export function canPin(closure: Closure): boolean {
  return closure.calls.length > 0 && closure.missing.length === 0 && closure.calls.every(({ state }) => state === 'approved' || state === 'released');
}

export function releaseOf(isPinning: boolean, { machine, with: typed }: ClosureChoice) {
  if (!isPinning) return {};
  const names = namesOf(typed);
  return { closure: true, ...(machine !== '' && { machine }), ...(names.length > 0 && { with: names }) };
}
