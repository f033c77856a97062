// What a record says, for people: the structured ones are JSON (protocol/dds/record_text.hpp). What cannot be read so is shown as it is. Pure.
import type { Record as ReportRecord } from '../../generated/api';

export interface Probing {
  /// By axis letter, mm or degrees.
  at: { [axis: string]: number };
  tripped: boolean;
}

function objectIn(text: string): { [member: string]: unknown } | null {
  try {
    const value: unknown = JSON.parse(text);
    return typeof value === 'object' && value !== null && !Array.isArray(value) ? (value as { [member: string]: unknown }) : null;
  } catch {
    return null;
  }
}

const textOf = (value: unknown) => (typeof value === 'string' || typeof value === 'number' ? String(value) : '');

/// null: it is no probing result.
export function probingOf(record: ReportRecord): Probing | null {
  const value = record.kind === 'probe' ? objectIn(record.text) : null;
  if (!value || typeof value.at !== 'object' || value.at === null) return null;
  const at = Object.entries(value.at).filter((entry): entry is [string, number] => typeof entry[1] === 'number');
  return { at: Object.fromEntries(at), tripped: value.tripped === true };
}

export function recordText(record: ReportRecord): string {
  const value = objectIn(record.text);
  if (!value) return record.text;
  const probing = probingOf(record);
  if (probing) return `${probing.tripped ? '' : '(–) '}${Object.entries(probing.at).map(([axis, mm]) => `${axis} ${mm.toFixed(4)}`).join('  ')}`;
  const parts = {
    run_started: [value.program, value.control],
    run_ended: [value.outcome, value.reason],
    alarm: [value.text, value.code],
  }[record.kind as string];
  const text = (parts ?? []).map(textOf).filter((part) => part !== '').join(' · ');
  return text === '' ? record.text : text;
}
