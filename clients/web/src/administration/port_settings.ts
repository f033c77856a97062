// The settings of a port as they are written in the form, and where each value in force comes from. Pure.
import type { PortSetting, PortTemplate } from '../../generated/api';

/// "baud = 4800", a line each. Throws a text that names the line.
export function readSettings(text: string, complain: (line: string) => string): Record<string, string> {
  const settings: Record<string, string> = {};
  for (const line of text.split('\n')) {
    if (line.trim() === '') continue;
    const pair = /^\s*([\w-]+)\s*=\s*(.*?)\s*$/.exec(line);
    if (!pair || pair[2] === '') throw new Error(complain(line.trim()));
    settings[pair[1]!] = pair[2]!.replace(/^"(.*)"$/, '$1');
  }
  return settings;
}

export interface ShownSetting {
  key: string;
  /// What it decides, in the server's words.
  text: string;
  type: string;
  /// null: the word in `line` decides it.
  value: string | null;
  from: 'own' | 'line' | 'template' | 'default';
}

/// `line` (9600e72) is one word for these.
const kInLine = new Set(['baud', 'parity', 'data_bits', 'stop_bits']);

export function shownSettings(all: PortSetting[], template: PortTemplate | undefined, own: Record<string, string>): ShownSetting[] {
  const given = (key: string): Pick<ShownSetting, 'value' | 'from'> | null => {
    if (Object.hasOwn(own, key)) return { value: own[key]!, from: 'own' };
    if (kInLine.has(key) && Object.hasOwn(own, 'line')) return { value: null, from: 'line' };
    const usual = template?.settings[key];
    return usual === undefined ? null : { value: usual, from: 'template' };
  };
  return all.map(({ key, text, type, default: otherwise }) => ({ key, text, type, ...(given(key) ?? { value: otherwise, from: 'default' as const }) }));
}

/// The settings that nobody has heard of.
export function unknownSettings(all: PortSetting[], own: Record<string, string>): string[] {
  return Object.keys(own).filter((key) => !all.some((row) => row.key === key));
}
