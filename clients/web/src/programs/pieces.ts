// A program's text in pieces of whole lines, so that a program of any size can be paged through, and gone to at any of its blocks. Pure.
import { countLineEnds } from '../machine/text_window';

export const kPieceBytes = 512 * 1024;
/// Of a piece that is loaded for one block: this much is before it.
const kBefore = 64 * 1024;

/// Where a line begins, and its number.
export interface Place {
  offset: number;
  line: number;
}

export interface Piece extends Place {
  lines: string[];
  /// Of the first byte after it.
  end: number;
}

/// The bytes to be loaded, and the place in them by which their lines are numbered.
export interface Range {
  first: number;
  /// Of the first byte after them.
  end: number;
  known: Place;
}

export function rangeFrom(place: Place, size: number): Range {
  return { first: place.offset, end: Math.min(size, place.offset + kPieceBytes), known: place };
}

export function rangeBefore({ offset, line }: Place): Range {
  return { first: Math.max(0, offset - kPieceBytes), end: offset, known: { offset, line } };
}

export function rangeAround(place: Place, size: number): Range {
  const first = Math.max(0, place.offset - kBefore);
  return { first, end: Math.min(size, first + kPieceBytes), known: place };
}

export function nextOf(piece: Piece): Place {
  return { offset: piece.end, line: piece.line + piece.lines.length };
}

export function holdsPlace(piece: Piece, offset: number): boolean {
  return offset >= piece.offset && offset < piece.end;
}

/// The last line is cut off unless the program ends with it, or it fills all of the bytes; the first one unless it begins with them.
export function pieceOf(bytes: Uint8Array, { first, known }: Range, size: number): Piece {
  const isWhole = first === 0 || first === known.offset;
  const begin = isWhole ? 0 : bytes.indexOf(0x0a) + 1;
  const isLast = first + bytes.length >= size;
  const cut = isLast ? bytes.length : bytes.lastIndexOf(0x0a) + 1 || bytes.length;
  const text = new TextDecoder().decode(bytes.subarray(begin, cut)).replace(/\n$/, '');
  const lines = cut <= begin ? [] : text.split('\n').map((l) => l.replace(/\r$/, ''));
  return { offset: first + begin, line: known.line - countLineEnds(bytes.subarray(begin, Math.max(begin, known.offset - first))), lines, end: first + cut };
}
