// Processor time and memory of a process and all that it has started, as Linux counts them.
import { readFileSync, readdirSync } from 'node:fs';

const kTicksPerSecond = 100; // _SC_CLK_TCK, which is 100 on every Linux that Chromium runs on
const kPageBytes = 4096;

interface Stat {
  parent: number;
  seconds: number;
  bytes: number;
}

function statOf(pid: number): Stat | null {
  try {
    const text = readFileSync(`/proc/${pid}/stat`, 'latin1');
    const fields = text.slice(text.lastIndexOf(')') + 2).split(' ');
    return { parent: Number(fields[1]), seconds: (Number(fields[11]) + Number(fields[12])) / kTicksPerSecond, bytes: Number(fields[21]) * kPageBytes };
  } catch {
    return null; // it has ended
  }
}

function allProcesses(): number[] {
  return readdirSync('/proc').filter((name) => /^\d+$/.test(name)).map(Number);
}

/// Empty: it has ended.
function commandOf(pid: number): string {
  try {
    return readFileSync(`/proc/${pid}/cmdline`, 'latin1');
  } catch {
    return '';
  }
}

/// Of a process that this one has started by a command with this word.
export function childWith(word: string): number {
  const found = allProcesses().find((pid) => statOf(pid)?.parent === process.pid && commandOf(pid).includes(word));
  if (found === undefined) throw new Error(`no process of ${word} is found`);
  return found;
}

function familyOf(pid: number): number[] {
  const parents = new Map<number, number>();
  for (const other of allProcesses()) {
    const stat = statOf(other);
    if (stat) parents.set(other, stat.parent);
  }
  const family = [pid];
  for (let i = 0; i < family.length; ++i) for (const [child, parent] of parents) if (parent === family[i]) family.push(child);
  return family;
}

export interface Use {
  seconds: number;
  bytes: number;
}

/// By process: its kind ("renderer", "gpu-process" ...; "browser" without one) and what it has used so far.
export function usesOf(pid: number): Map<string, Use> {
  const uses = new Map<string, Use>();
  for (const member of familyOf(pid)) {
    const stat = statOf(member);
    const command = commandOf(member);
    if (!stat || command === '') continue;
    const kind = /--type=([\w-]+)/.exec(command)?.[1] ?? 'browser';
    const use = uses.get(kind) ?? { seconds: 0, bytes: 0 };
    uses.set(kind, { seconds: use.seconds + stat.seconds, bytes: use.bytes + stat.bytes });
  }
  return uses;
}

export function sumOf(uses: Map<string, Use>): Use {
  return [...uses.values()].reduce((sum, { seconds, bytes }) => ({ seconds: sum.seconds + seconds, bytes: sum.bytes + bytes }), { seconds: 0, bytes: 0 });
}
