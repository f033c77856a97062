// The values of a target as steps, oldest first, and numbers as a setup writes them. Pure.
import type { Offset, OffsetHistory } from '../../generated/api';
import { numberText } from '../texts/texts';

export type PastValue = OffsetHistory['history'][number];

const kDigits = { mm: 4, in: 5 };

export function valueText(value: number, unit: Offset['unit'], isSigned = false): string {
  return `${isSigned && value > 0 ? '+' : ''}${numberText(value, kDigits[unit])}\u00a0${unit}`;
}

/// Newest first, as the server gives them; what the value was before is the next one of the same target. null: it was the first.
export function changeOf(history: PastValue[], index: number): number | null {
  const { target, value } = history[index]!;
  const before = history.slice(index + 1).find((other) => other.target === target);
  return before ? value - before.value : null;
}

export function targetsOf(history: PastValue[]): string[] {
  return [...new Set(history.map(({ target }) => target))].sort();
}

/// The points of a step line in a box of `width` and `height`, from left to right; null: there is no line of one value.
export function stepLine(newestFirst: number[], { width, height }: { width: number; height: number }): { points: string; lowest: number; highest: number } | null {
  const values = [...newestFirst].reverse();
  if (values.length < 2) return null;
  const lowest = Math.min(...values);
  const highest = Math.max(...values);
  const range = highest - lowest;
  const y = (value: number) => (range === 0 || !Number.isFinite(range) ? height / 2 : height - ((value - lowest) / range) * height);
  const step = width / values.length;
  const points = values.flatMap((value, i) => [`${round(i * step)},${round(y(value))}`, `${round((i + 1) * step)},${round(y(value))}`]);
  return { points: points.join(' '), lowest, highest };
}

const round = (value: number) => Math.round(value * 10) / 10;

/// The server gives them oldest first.
export function latestRuns(runs: string[], count: number): string[] {
  return [...runs].reverse().slice(0, count);
}
