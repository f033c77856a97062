// The hunks of a comparison as rows of two texts beside each other. Pure.
import type { ComparedHunk } from '../../generated/api';

export interface Side {
  line: number;
  text: string;
}

/// null: this text has no line here. A row of two nulls: lines are left out.
export interface Row {
  kind: 'same' | 'changed' | 'removed' | 'added' | 'gap';
  first: Side | null;
  second: Side | null;
}

const kGap: Row = { kind: 'gap', first: null, second: null };

function numbered(lines: string[], first: number): Side[] {
  return lines.map((text, i) => ({ line: first + i, text }));
}

function same(lines: string[], first: number, second: number): Row[] {
  return lines.map((text, i) => ({ kind: 'same', first: { line: first + i, text }, second: { line: second + i, text } }));
}

function kindOf(first: Side | undefined, second: Side | undefined): Row['kind'] {
  if (first && second) return 'changed';
  return first ? 'removed' : 'added';
}

function changed(hunk: ComparedHunk): Row[] {
  const first = numbered(hunk.first.lines, hunk.first.line);
  const second = numbered(hunk.second.lines, hunk.second.line);
  return Array.from({ length: Math.max(first.length, second.length) }, (_, i) => ({ kind: kindOf(first[i], second[i]), first: first[i] ?? null, second: second[i] ?? null }));
}

export function rowsOf(hunks: ComparedHunk[]): Row[] {
  const rows: Row[] = [];
  let next = 1; // line of the first text that follows
  for (const hunk of hunks) {
    const before = hunk.before.length;
    if (hunk.first.line - before > next) rows.push(kGap);
    rows.push(...same(hunk.before, hunk.first.line - before, hunk.second.line - before));
    rows.push(...changed(hunk));
    rows.push(...same(hunk.after, hunk.first.line + hunk.first.count, hunk.second.line + hunk.second.count));
    next = hunk.first.line + hunk.first.count + hunk.after.length;
  }
  return rows;
}
