// How far a run is, and how long it may still take. Pure.
import type { Run, Status } from '../../generated/api';

export interface Progress {
  /// 0 to 1, of the program's bytes: the server knows no time of a program before it has run.
  fraction: number;
  /// An estimate from what was executed so far; null while there is too little of it.
  secondsLeft: number | null;
}

const kFirstEstimateSeconds = 5;
const kFirstEstimateFraction = 0.01;

/// null without a run.
export function progressOf(status: Status, run?: Run): Progress | null {
  if (!status || status.run === null || status.total_bytes === 0) return null;
  if (status.execution === 'PROGRAM_COMPLETED') return { fraction: 1, secondsLeft: null };
  const fraction = Math.min(1, status.offset / status.total_bytes);
  return { fraction, secondsLeft: status.execution === 'ACTIVE' ? secondsLeft(status, fraction, run) : null };
}

/// What was executed shows how fast the rest may run; what is buffered lasts as long as it states, at least. Both times come from the shop,
/// so that this computer's clock does not matter.
function secondsLeft(status: NonNullable<Status>, fraction: number, run?: Run): number | null {
  const isAllThere = status.sent >= status.total_bytes;
  const estimate = estimateOf(status, fraction, run);
  if (estimate === null) return isAllThere && status.buffered_seconds > 0 ? status.buffered_seconds : null;
  return Math.max(estimate, status.buffered_seconds);
}

function estimateOf(status: NonNullable<Status>, fraction: number, run?: Run): number | null {
  if (run?.id !== status.run || !run?.started || fraction < kFirstEstimateFraction) return null;
  const elapsed = (Date.parse(status.time) - Date.parse(run.started)) / 1000;
  return elapsed < kFirstEstimateSeconds ? null : (elapsed * (1 - fraction)) / fraction;
}

/// "0.3 %" while it is small, so that a long program is seen to move.
export function percentDigits(fraction: number): number {
  return fraction > 0 && fraction < 0.1 ? 1 : 0;
}

/// "45 s", "12 min", "3 h 05 min": rounded as an estimate should be.
export function durationText(seconds: number): string {
  if (seconds < 60) return `${Math.round(seconds)} s`;
  const minutes = Math.round(seconds / 60);
  if (minutes < 60) return `${minutes} min`;
  return `${Math.floor(minutes / 60)} h ${String(minutes % 60).padStart(2, '0')} min`;
}
