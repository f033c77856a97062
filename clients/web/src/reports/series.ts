// Finds measured values in the records of a run: the points of probings, and the numbers of report lines ("G1 X12.5 Z-3", "DIA_1=19.998"). Pure.
import type { Record as ReportRecord } from '../../generated/api';
import { probingOf } from '../live/record_text';

export interface Series {
  /// "probe X", "DIA": what a chart is of.
  name: string;
  /// Of the records in their order.
  values: number[];
}

/// A name before `=` or `:` may have digits in it, a word's letters may not: X10.5 is X, and G1X10.5 two words.
const kValue = /(?<![A-Za-z_.])(?:([A-Za-z]\w*)\s*[=:]\s*|([A-Za-z]+)\s*)([+-]?(?:\d+\.?\d*|\.\d+))(?![\d.]|[A-Za-z_](?![+-]?[\d.]))/g;
/// A report is often a program to be run next: its codes and numbers measure nothing.
const kCodes = new Set(['G', 'M', 'N', 'O', 'T']);
/// A chart of one value shows nothing.
const kFewest = 2;

function valuesOf(record: ReportRecord): Array<[string, number]> {
  const probing = probingOf(record);
  if (probing) return probing.tripped ? Object.entries(probing.at).map(([axis, value]) => [`probe ${axis}`, value]) : [];
  if (record.kind !== 'output') return [];
  const values = [...record.text.matchAll(kValue)].map((match): [string, number] => [(match[1] ?? match[2]!).toUpperCase(), Number(match[3])]);
  return values.filter(([name]) => !kCodes.has(name));
}

export function seriesOf(records: ReportRecord[]): Series[] {
  const byName = new Map<string, number[]>();
  for (const record of records) {
    for (const [name, value] of valuesOf(record)) {
      const values = byName.get(name);
      if (values) values.push(value);
      else byName.set(name, [value]);
    }
  }
  return [...byName].filter(([, values]) => values.length >= kFewest).map(([name, values]) => ({ name, values }));
}

export interface Limits {
  lower: number | null;
  upper: number | null;
}

/// A text that is no number is no limit.
export function readLimit(text: string | null): number | null {
  const value = text === null || text.trim() === '' ? Number.NaN : Number(text.replace(',', '.'));
  return Number.isFinite(value) ? value : null;
}

export interface Summary {
  count: number;
  smallest: number;
  largest: number;
  mean: number;
  outside: number;
}

export function summaryOf(values: number[], { lower, upper }: Limits): Summary {
  let smallest = Infinity;
  let largest = -Infinity;
  let sum = 0;
  let outside = 0;
  for (const value of values) {
    smallest = Math.min(smallest, value);
    largest = Math.max(largest, value);
    sum += value;
    if ((lower !== null && value < lower) || (upper !== null && value > upper)) ++outside;
  }
  return { count: values.length, smallest, largest, mean: sum / values.length, outside };
}
