// The part of a program's text around its executing block. A program may have gigabytes: only a window of it is ever loaded. Pure.
const kBefore = 8 * 1024;
const kAfter = 24 * 1024;
/// A block this near the window's end is a reason to load the next one.
const kMargin = 2 * 1024;

export interface TextWindow {
  /// Of its first byte in the program.
  offset: number;
  bytes: Uint8Array;
  /// Of the whole program.
  size: number;
}

export interface NumberedLine {
  number: number;
  text: string;
}

export function rangeAround(offset: number, size: number): { first: number; last: number } {
  return { first: Math.max(0, offset - kBefore), last: Math.max(0, Math.min(size, offset + kAfter) - 1) };
}

export function holds(window: TextWindow, offset: number): boolean {
  const end = window.offset + window.bytes.length;
  const isNearEnd = offset >= end - kMargin && end < window.size;
  const isNearBegin = offset < window.offset + Math.min(kMargin, kBefore) && window.offset > 0;
  return offset >= window.offset && offset < end && !isNearEnd && !isNearBegin;
}

/// `line` is the number of the line in which byte `offset` of the program lies; lines that the window cuts are left out.
export function numberLines(window: TextWindow, offset: number, line: number): NumberedLine[] {
  const { bytes } = window;
  let begin = 0;
  if (window.offset > 0) begin = bytes.indexOf(0x0a) + 1;
  const isEnd = window.offset + bytes.length >= window.size;
  const end = isEnd ? bytes.length : bytes.lastIndexOf(0x0a);
  const before = countLineEnds(bytes.subarray(begin, Math.max(begin, offset - window.offset)));
  const text = new TextDecoder().decode(bytes.subarray(begin, Math.max(begin, end)));
  const lines = text.replace(/\n$/, '').split('\n');
  return lines.map((content, i) => ({ number: line - before + i, text: content.replace(/\r$/, '') }));
}

export function countLineEnds(bytes: Uint8Array): number {
  let count = 0;
  for (const byte of bytes) if (byte === 0x0a) ++count;
  return count;
}
