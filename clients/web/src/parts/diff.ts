// What changed between two texts, line by line (the longest common subsequence). Pure.
export interface DiffLine {
  kind: 'same' | 'removed' | 'added';
  text: string;
}

/// Larger differences are shown as removed and added as a whole: the table below is of their product.
const kMaxCells = 4_000_000;

export function diffLines(before: string, after: string): DiffLine[] {
  const a = before.split('\n');
  const b = after.split('\n');
  let begin = 0;
  while (begin < a.length && begin < b.length && a[begin] === b[begin]) ++begin;
  let end = 0;
  while (end < a.length - begin && end < b.length - begin && a[a.length - 1 - end] === b[b.length - 1 - end]) ++end;
  const same = (lines: string[]): DiffLine[] => lines.map((text) => ({ kind: 'same', text }));
  return [...same(a.slice(0, begin)), ...diffMiddle(a.slice(begin, a.length - end), b.slice(begin, b.length - end)), ...same(a.slice(a.length - end))];
}

function diffMiddle(a: string[], b: string[]): DiffLine[] {
  const removed = (text: string): DiffLine => ({ kind: 'removed', text });
  const added = (text: string): DiffLine => ({ kind: 'added', text });
  if (a.length * b.length > kMaxCells) return [...a.map(removed), ...b.map(added)];
  const width = b.length + 1;
  const common = new Uint16Array((a.length + 1) * width); // fewer than 2^16 lines, by kMaxCells
  for (let i = a.length - 1; i >= 0; --i) {
    for (let j = b.length - 1; j >= 0; --j) {
      common[i * width + j] = a[i] === b[j] ? common[(i + 1) * width + j + 1]! + 1 : Math.max(common[(i + 1) * width + j]!, common[i * width + j + 1]!);
    }
  }
  const lines: DiffLine[] = [];
  let i = 0;
  let j = 0;
  while (i < a.length || j < b.length) {
    if (i < a.length && j < b.length && a[i] === b[j]) {
      lines.push({ kind: 'same', text: a[i]! });
      ++i;
      ++j;
    } else if (j >= b.length || (i < a.length && common[(i + 1) * width + j]! >= common[i * width + j + 1]!)) {
      lines.push(removed(a[i++]!));
    } else {
      lines.push(added(b[j++]!));
    }
  }
  return lines;
}

/// Only what changed, with `around` lines on each side; null where lines are left out.
export function foldDiff(lines: DiffLine[], around = 3): Array<DiffLine | null> {
  const near = new Set<number>();
  lines.forEach((line, i) => {
    if (line.kind !== 'same') for (let j = i - around; j <= i + around; ++j) near.add(j);
  });
  const folded: Array<DiffLine | null> = [];
  lines.forEach((line, i) => {
    if (near.has(i)) folded.push(line);
    else if (folded.length > 0 && folded[folded.length - 1] !== null) folded.push(null);
  });
  if (folded[folded.length - 1] === null) folded.pop();
  return folded;
}
