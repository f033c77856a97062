// Up to which point of its path a machine has executed a program. The status has the number of executed blocks and the line of the executing one; a
// line may be executed in many passes, and a run may have begun in the middle. Pure.
import type { Vector } from './camera';
import type { Polyline } from './polyline';

export interface Executing {
  /// Blocks that are finished.
  executed: number;
  /// Of the executing block.
  line: number;
  /// As the path has it; null: not known.
  tool: Vector | null;
}

interface Run {
  first: number;
  last: number;
}

/// One for each path: it remembers where the machine was.
export class ExecutedCursor {
  private point = 0;

  constructor(private readonly polyline: Polyline) {}

  /// The last point that the machine has come to.
  at(now: Executing): number {
    const { polyline } = this;
    if (polyline.length === 0) return 0;
    const { first, last, about } = this.windowOf(now.executed);
    const run = this.nearestRun(now.line, first, last, about) ?? this.nextRun(now.line);
    if (run) this.point = this.pointIn(run, now.tool);
    // A block that moves nothing, or that was left out of a long path: the tool is near the path all the same.
    else this.point = now.tool ? this.pointIn({ first: first + 1, last: Math.min(last + 1, polyline.length - 1) }, now.tool) : Math.round(about);
    return this.point;
  }

  /// The points between the marks around so many blocks, and where among them the executing one is if every block has as many points.
  private windowOf(executed: number): Run & { about: number } {
    const { marks, length } = this.polyline;
    let [low, high] = [0, marks.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (marks[middle]!.blocks <= executed) low = middle + 1;
      else high = middle;
    }
    const before = marks[low - 1] ?? { blocks: 0, point: 0 };
    const after = marks[low] ?? { blocks: Math.max(before.blocks, executed), point: length - 1 };
    const part = after.blocks > before.blocks ? (executed + 1 - before.blocks) / (after.blocks - before.blocks) : 0;
    return { first: before.point, last: after.point, about: before.point + Math.min(1, part) * (after.point - before.point) };
  }

  /// The points of one pass through the line, nearest to `about`.
  private nearestRun(line: number, first: number, last: number, about: number): Run | null {
    let best: Run | null = null;
    let nearest = Infinity;
    for (let i = Math.max(1, first); i <= Math.min(last + 1, this.polyline.length - 1); ++i) {
      if (this.polyline.lines[i] !== line) continue;
      const run = this.runFrom(i);
      const distance = Math.max(0, run.first - about, about - run.last);
      if (distance < nearest) [best, nearest] = [run, distance];
      i = run.last;
    }
    return best;
  }

  /// The next pass after where the machine was, else the first one of all: the run began in the middle, where blocks are counted otherwise.
  private nextRun(line: number): Run | null {
    const { lines, length } = this.polyline;
    let found = -1;
    for (let i = 1; i < length; ++i) {
      if (lines[i] !== line) continue;
      if (found < 0 || i >= this.point) found = i;
      if (i >= this.point) break;
    }
    return found < 0 ? null : this.runFrom(found);
  }

  private runFrom(first: number): Run {
    const { lines, length } = this.polyline;
    let last = first;
    while (last + 1 < length && lines[last + 1] === lines[first]) ++last;
    return { first, last };
  }

  /// Of a block with several points, an arc, the tool has passed those before the segment it is nearest to.
  private pointIn({ first, last }: Run, tool: Vector | null): number {
    if (!tool) return first - 1;
    let best = first - 1;
    let nearest = Infinity;
    for (let i = first; i <= last; ++i) {
      const distance = this.distanceSquared(tool, i);
      if (distance < nearest) [best, nearest] = [i - 1, distance];
    }
    return best;
  }

  /// From the segment that ends at this point.
  private distanceSquared(tool: Vector, end: number): number {
    const p = this.polyline.positions;
    let [along, length, away] = [0, 0, 0];
    for (let i = 0; i < 3; ++i) {
      const [from, to] = [p[3 * (end - 1) + i]!, p[3 * end + i]!];
      along += (tool[i]! - from) * (to - from);
      length += (to - from) ** 2;
    }
    const part = length > 0 ? Math.min(1, Math.max(0, along / length)) : 0;
    for (let i = 0; i < 3; ++i) {
      const [from, to] = [p[3 * (end - 1) + i]!, p[3 * end + i]!];
      away += (tool[i]! - from - part * (to - from)) ** 2;
    }
    return away;
  }
}
