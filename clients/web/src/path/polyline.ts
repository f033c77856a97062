// The points of a tool path, in arrays that a graphics card takes as they are. Bounded: a path with more points is made coarser where
// that is seen least. Pure.

/// How the tool comes to a point, as server/paths numbers it.
export const kMoves = ['rapid', 'line', 'arc', 'thread', 'probe'] as const;
export type Move = (typeof kMoves)[number];
export const kRapid = 0;

export const kMaxPoints = 2_000_000;
const kFirstPoints = 1024;
/// Points between two that are kept, at most: what bounds the work for each.
const kWindow = 32;
/// The first step of coarsening, as a part of the path's size: far below what a screen resolves.
const kFirstTolerance = 1 / 20_000;

/// After so many executed blocks the path has come to this point.
export interface Mark {
  blocks: number;
  point: number;
}

export interface Bounds {
  least: [number, number, number];
  most: [number, number, number];
}

export class Polyline {
  length = 0;
  positions = new Float32Array(0);
  moves = new Uint8Array(0);
  lines = new Uint32Array(0);
  /// Of blocks, in the program.
  offsets = new Float64Array(0);
  /// Millimeters by which the path may be off where points are left out; 0: every point is there.
  tolerance = 0;
  /// Another number: points that were there have moved.
  generation = 0;
  /// In their order; they follow the points when these are made fewer.
  readonly marks: Mark[] = [];
  private readonly least: [number, number, number] = [Infinity, Infinity, Infinity];
  private readonly most: [number, number, number] = [-Infinity, -Infinity, -Infinity];

  constructor(private readonly maxPoints = kMaxPoints) {
    this.grow(Math.min(kFirstPoints, maxPoints));
  }

  add(x: number, y: number, z: number, move: number, line: number, offset: number): void {
    if (this.length === this.moves.length) this.makeRoom();
    const i = this.length++;
    this.positions[3 * i] = x;
    this.positions[3 * i + 1] = y;
    this.positions[3 * i + 2] = z;
    this.moves[i] = move;
    this.lines[i] = line;
    this.offsets[i] = offset;
    if (i > 0) this.extend(x, y, z); // the start is where the machine is, not where the program moves
  }

  mark(blocks: number): void {
    if (this.length > 0) this.marks.push({ blocks, point: this.length - 1 });
  }

  /// null: nothing moves.
  bounds(): Bounds | null {
    return this.least[0] > this.most[0] ? null : { least: this.least, most: this.most };
  }

  /// The first point to which a block in this line moves, or to which the next one after it does; -1: none.
  findLine(line: number): number {
    let nearest = -1;
    for (let i = 1; i < this.length; ++i) {
      if (this.lines[i] === line) return i;
      if (this.lines[i]! > line && (nearest < 0 || this.lines[i]! < this.lines[nearest]!)) nearest = i;
    }
    return nearest;
  }

  /// The points to which blocks in this line move, as runs of indices; at most `most` of them.
  runsOf(line: number, most = 1000): Array<{ first: number; last: number }> {
    const runs: Array<{ first: number; last: number }> = [];
    for (let i = 1; i < this.length && runs.length < most; ++i) {
      if (this.lines[i] !== line) continue;
      const first = i;
      while (i + 1 < this.length && this.lines[i + 1] === line) ++i;
      runs.push({ first, last: i });
    }
    return runs;
  }

  private extend(x: number, y: number, z: number): void {
    if (x < this.least[0]) this.least[0] = x;
    if (y < this.least[1]) this.least[1] = y;
    if (z < this.least[2]) this.least[2] = z;
    if (x > this.most[0]) this.most[0] = x;
    if (y > this.most[1]) this.most[1] = y;
    if (z > this.most[2]) this.most[2] = z;
  }

  private makeRoom(): void {
    if (this.length < this.maxPoints) return this.grow(Math.min(2 * this.length, this.maxPoints));
    const size = Math.hypot(...this.least.map((value, i) => this.most[i]! - value));
    this.tolerance = Math.max(this.tolerance, size * kFirstTolerance);
    this.coarsen();
    while (this.length > this.maxPoints / 2 && this.tolerance < size) {
      this.tolerance *= 2;
      this.coarsen();
    }
    // Moves that alternate, or what is not a number: nothing between two points can be left out.
    if (this.length > this.maxPoints / 2) this.drop();
  }

  /// Every other point.
  private drop(): void {
    for (let i = 1; 2 * i < this.length; ++i) this.move(2 * i, i);
    this.length = Math.ceil(this.length / 2);
    for (const mark of this.marks) mark.point = Math.min(this.length - 1, Math.floor(mark.point / 2));
    ++this.generation;
  }

  private grow(capacity: number): void {
    const copy = <T extends Float32Array | Uint8Array | Uint32Array | Float64Array>(into: T, from: T): T => {
      into.set(from);
      return into;
    };
    this.positions = copy(new Float32Array(3 * capacity), this.positions);
    this.moves = copy(new Uint8Array(capacity), this.moves);
    this.lines = copy(new Uint32Array(capacity), this.lines);
    this.offsets = copy(new Float64Array(capacity), this.offsets);
  }

  /// Leaves out points within the tolerance of the line between those that stay. What is read lies after what is written.
  private coarsen(): void {
    let kept = 1;
    let anchor = 0;
    let mark = 0;
    for (let i = 1; i < this.length; ++i) {
      while (mark < this.marks.length && this.marks[mark]!.point < i) this.marks[mark++]!.point = kept - 1;
      const isLast = i + 1 === this.length;
      if (!isLast && i - anchor < kWindow && this.moves[i] === this.moves[i + 1] && this.areNear(anchor, i + 1)) continue;
      this.move(i, kept++);
      anchor = i;
    }
    while (mark < this.marks.length) this.marks[mark++]!.point = kept - 1;
    this.length = kept;
    ++this.generation;
  }

  private areNear(from: number, to: number): boolean {
    const limit = this.tolerance * this.tolerance;
    for (let i = from + 1; i < to; ++i) if (!(this.distanceSquared(i, from, to) <= limit)) return false;
    return true;
  }

  private distanceSquared(i: number, from: number, to: number): number {
    const p = this.positions;
    const [ax, ay, az] = [p[3 * from]!, p[3 * from + 1]!, p[3 * from + 2]!];
    const [dx, dy, dz] = [p[3 * to]! - ax, p[3 * to + 1]! - ay, p[3 * to + 2]! - az];
    const [px, py, pz] = [p[3 * i]! - ax, p[3 * i + 1]! - ay, p[3 * i + 2]! - az];
    const length = dx * dx + dy * dy + dz * dz;
    const part = length > 0 ? Math.min(1, Math.max(0, (px * dx + py * dy + pz * dz) / length)) : 0;
    return (px - part * dx) ** 2 + (py - part * dy) ** 2 + (pz - part * dz) ** 2;
  }

  private move(from: number, to: number): void {
    if (from === to) return;
    this.positions.copyWithin(3 * to, 3 * from, 3 * from + 3);
    this.moves[to] = this.moves[from]!;
    this.lines[to] = this.lines[from]!;
    this.offsets[to] = this.offsets[from]!;
  }
}
