// What can be seen of a job by its numbers, and where in the queue it may go. Pure.
import type { Job } from '../../../generated/api';

/// Of its parts, 0 to 1. A last run may make more than are wanted.
export function fractionOf({ completed, quantity }: Job): number {
  return Math.min(1, completed / quantity);
}

/// Runs that are still to be started, the one that has not ended included.
export function runsLeft({ completed, quantity, parts_per_run }: Job): number {
  return Math.ceil(Math.max(0, quantity - completed) / parts_per_run);
}

/// The parts that its next run makes: "3" or "3 to 6"; the first is 1.
export function nextParts({ completed, parts_per_run }: Job): { first: number; last: number } {
  return { first: completed + 1, last: completed + parts_per_run };
}

export interface Moves {
  /// Places from 1; null: it is there already.
  first: number | null;
  up: number | null;
  down: number | null;
}

export function movesOf(index: number, count: number): Moves {
  return { first: index > 1 ? 1 : null, up: index > 0 ? index : null, down: index < count - 1 ? index + 2 : null };
}

export interface JobText {
  program: string;
  revision: string;
  quantity: number;
  partsPerRun: number;
  isFirst: boolean;
  comment: string;
}

/// What is asked of the server; what says nothing is left out.
export function requestOf({ program, revision, quantity, partsPerRun, isFirst, comment }: JobText) {
  return {
    program: program.trim(), quantity, parts_per_run: partsPerRun, ...(revision !== '' && { revision: Number(revision) }), ...(isFirst && { place: 1 }),
    ...(comment.trim() !== '' && { comment: comment.trim() }),
  };
}
