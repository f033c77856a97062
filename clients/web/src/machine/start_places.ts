// What a start can name as the block to begin with, and what of it a machine's control has. Pure.
import type { Machine } from '../../generated/api';

export type StartPlace = Machine['starts']['at'][number];

/// As people write them; a number alone is a block's.
export const kExamples: Record<StartPlace, string> = { block: 'N120', line: 'L7', byte: 'B4096', tool: 'T3', count: '+25' };

const kForms: Array<[StartPlace, RegExp]> = [['block', /^n?\d+$/i], ['line', /^l\d+$/i], ['byte', /^b\d+$/i], ['tool', /^t\d+$/i], ['count', /^\+\d+$/]];

/// null: it names nothing (yet).
export function placeOf(typed: string): StartPlace | null {
  return kForms.find(([, form]) => form.test(typed.trim()))?.[0] ?? null;
}

/// Whether a start there can be asked for; the beginning of a program, which is named by nothing, always.
export function canStartAt(typed: string, { at }: Machine['starts']): boolean {
  if (typed.trim() === '') return true;
  const place = placeOf(typed);
  return place !== null && at.includes(place);
}
