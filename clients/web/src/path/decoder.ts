// Reads the frames of a tool path (server/paths/README.md) from pieces of any size. Pure.
import type { PathBegin, PathEnd, PathProgress } from '../../generated/api';
import type { Polyline } from './polyline';

export type PathNote = PathBegin | PathProgress | PathEnd;

const kHeadBytes = 5;
const kJson = 0x4a; // J
const kPoints = 0x50; // P
/// The server's frames are far smaller.
const kMaxFrame = 64 * 1024 * 1024;
const kGridPerMillimeter = 1000;
const kMoveBits = 3;

export class PathDecoder {
  private rest = new Uint8Array(0);
  private line = 1;
  private offset = 0;
  private readonly grid: [number, number, number] = [0, 0, 0];
  private isLathe = false;

  constructor(private readonly polyline: Polyline, private readonly onNote: (note: PathNote) => void) {}

  /// Throws what is wrong with the bytes.
  take(piece: Uint8Array): void {
    let bytes = piece;
    if (this.rest.length > 0) {
      bytes = new Uint8Array(this.rest.length + piece.length);
      bytes.set(this.rest);
      bytes.set(piece, this.rest.length);
    }
    let at = 0;
    while (bytes.length - at >= kHeadBytes) {
      const size = new DataView(bytes.buffer, bytes.byteOffset + at + 1, 4).getUint32(0, true);
      if (size > kMaxFrame) throw new Error(`a frame of ${size} bytes`);
      if (bytes.length - at - kHeadBytes < size) break;
      this.takeFrame(bytes[at]!, bytes.subarray(at + kHeadBytes, at + kHeadBytes + size));
      at += kHeadBytes + size;
    }
    this.rest = bytes.slice(at);
  }

  private takeFrame(kind: number, content: Uint8Array): void {
    if (kind === kPoints) return this.takePoints(content);
    if (kind !== kJson) throw new Error(`a frame of kind ${kind}`);
    const note = JSON.parse(new TextDecoder().decode(content)) as PathNote;
    if (note.kind === 'begin') this.isLathe = note.lathe;
    else this.polyline.mark(note.blocks);
    this.onNote(note);
  }

  /// The inner loop of the page: numbers are read in place. A number above 2^31 continues as a product, since shifts have 32 bits.
  private takePoints(bytes: Uint8Array): void {
    const { grid, polyline } = this;
    const end = bytes.length;
    let at = 0;
    const read = (): number => {
      let byte = bytes[at++]!;
      let value = byte & 0x7f;
      for (let factor = 0x80; byte >= 0x80 && at < end; factor *= 0x80) {
        byte = bytes[at++]!;
        value += (byte & 0x7f) * factor;
      }
      return value;
    };
    const signed = (value: number): number => (value % 2 === 0 ? value / 2 : -(value + 1) / 2);
    while (at < end) {
      const head = read();
      const move = head % (1 << kMoveBits);
      this.line += signed((head - move) / (1 << kMoveBits));
      this.offset += signed(read());
      for (let i = 0; i < 3; ++i) grid[i]! += signed(read());
      const [x, y, z] = [grid[0] / kGridPerMillimeter, grid[1] / kGridPerMillimeter, grid[2] / kGridPerMillimeter];
      // A lathe is looked at with Z to the right and X up.
      if (this.isLathe) polyline.add(z, x, y, move, this.line, this.offset);
      else polyline.add(x, y, z, move, this.line, this.offset);
    }
  }
}
