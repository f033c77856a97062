// A program's text in pieces of whole lines, one after the other, so that a program of any size can be paged through. Pure.
export const kPieceBytes = 512 * 1024;

export interface Piece {
  /// Of its first byte and its first line in the program.
  offset: number;
  line: number;
  lines: string[];
  /// Of the first byte after it.
  end: number;
}

/// `bytes` begin at `offset` of a program of `size` bytes; the last line is cut off unless the program ends with it, or fills all of them.
export function pieceOf(bytes: Uint8Array, offset: number, line: number, size: number): Piece {
  const isLast = offset + bytes.length >= size;
  const cut = isLast ? bytes.length : bytes.lastIndexOf(0x0a) + 1 || bytes.length;
  const text = new TextDecoder().decode(bytes.subarray(0, cut)).replace(/\n$/, '');
  const lines = cut === 0 ? [] : text.split('\n').map((l) => l.replace(/\r$/, ''));
  return { offset, line, lines, end: offset + cut };
}
