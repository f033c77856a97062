// What can be seen of a job by its numbers, and where in the queue it may go. Pure.
import type { Job } from '../../../generated/api';

/// What is counted up to the quantity: parts that were made, or good ones.
export function countedOf({ counts, completed, good }: Job): number {
  return counts === 'good' ? good : completed;
}

/// Of its parts, 0 to 1. A last run may make more than are wanted.
export function fractionOf(job: Job): number {
  return Math.min(1, countedOf(job) / job.quantity);
}

/// Runs that are still to be started, the one that has not ended included, if all their parts count.
export function runsLeft(job: Job): number {
  return Math.ceil(Math.max(0, job.quantity - countedOf(job)) / job.parts_per_run);
}

/// Nothing to say of a job whose parts are not measured.
export function isMeasured({ counts, good, rework, scrap }: Job): boolean {
  return counts === 'good' || good + rework + scrap > 0;
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
  counts: Job['counts'];
  isFirst: boolean;
  comment: string;
}

/// What is asked of the server; what says nothing is left out.
export function requestOf({ program, revision, quantity, partsPerRun, counts, isFirst, comment }: JobText) {
  return {
    program: program.trim(), quantity, parts_per_run: partsPerRun, ...(revision !== '' && { revision: Number(revision) }), ...(counts !== 'made' && { counts }), ...(isFirst && { place: 1 }),
    ...(comment.trim() !== '' && { comment: comment.trim() }),
  };
}
