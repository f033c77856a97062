// What a program is for, as fields; those that a user has changed. Pure.
import type { Program, ProgramDescription } from '../../generated/api';

export const kProgramFields = ['part', 'operation', 'material', 'machine_group'] as const;
export const kFields = [...kProgramFields, 'cam_file'] as const;
export type Field = (typeof kFields)[number];
export type Fields = Record<Field, string>;

type Described = { [field in Field]: Program[field] };

export function fieldsOf(of: Described): Fields {
  return Object.fromEntries(kFields.map((field) => [field, of[field] ?? ''])) as Fields;
}

/// Only what differs is sent: another user may have changed the rest. An empty text takes a value away. `revision` is the one of the CAM file.
export function changeOf(before: Fields, after: Fields, revision: number): ProgramDescription | null {
  const changed = kFields.filter((field) => before[field] !== after[field].trim());
  if (changed.length === 0) return null;
  return { ...Object.fromEntries(changed.map((field) => [field, after[field].trim()])), ...(changed.includes('cam_file') && { revision }) };
}
