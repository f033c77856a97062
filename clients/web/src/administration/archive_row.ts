// A row of an archive as a line of a table: records, or parts, measurements and findings (protocol/archive). Pure.
import { texts } from '../texts/texts';

export interface ArchiveLine {
  time: string | null;
  machine: string;
  run: string;
  kind: string;
  text: string;
}

type Values = Record<string, unknown>;

const textOf = (values: Values, key: string): string => {
  const value = values[key];
  return value === null || value === undefined ? '' : String(value);
};

function inner(row: Values, key: string): Values | null {
  const value = row[key];
  return typeof value === 'object' && value !== null ? (value as Values) : null;
}

/// What is not known is shown as it is: nothing of an archive is left out.
export function lineOf(row: Values): ArchiveLine {
  const t = texts().archives;
  const as = (values: Values, kind: string, text: string): ArchiveLine =>
    ({ time: textOf(values, 'time') || textOf(values, 'ended') || null, machine: textOf(values, 'machine'), run: textOf(values, 'run'), kind, text });
  const measurement = inner(row, 'measurement');
  if (measurement) return as(measurement, t.rowKinds.measurement, `${textOf(measurement, 'characteristic')} = ${textOf(measurement, 'actual')} ${textOf(measurement, 'unit')}`.trim());
  const finding = inner(row, 'finding');
  if (finding) return as(finding, t.rowKinds.finding, textOf(finding, 'text'));
  const part = inner(row, 'part');
  if (part) return as(part, t.rowKinds.part, JSON.stringify(part));
  if (typeof row['kind'] === 'string') {
    const kinds = texts().machine.kinds as Record<string, string>;
    return as(row, kinds[row['kind']] ?? row['kind'], textOf(row, 'text'));
  }
  return as(row, '', JSON.stringify(row));
}
