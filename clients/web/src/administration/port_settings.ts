// The settings of a port as they are written in the form, and where each value in force comes from. Pure.
import type { PortSetting, PortTemplate } from '../../generated/api';

type Setting = [key: string, value: string];

/// null: the line is no setting.
function settingOf(line: string): Setting | null {
  const pair = /^\s*([\w-]+)\s*=\s*(.*?)\s*$/.exec(line);
  return pair && pair[2] !== '' ? [pair[1]!, pair[2]!.replace(/^"(.*)"$/, '$1')] : null;
}

/// "baud = 4800", a line each. Throws a text that names the line.
export function readSettings(text: string, complain: (line: string) => string): Record<string, string> {
  const lines = text.split('\n').filter((line) => line.trim() !== '');
  return Object.fromEntries(lines.map((line) => {
    const setting = settingOf(line);
    if (!setting) throw new Error(complain(line.trim()));
    return setting;
  }));
}

/// While it is typed: lines that are no settings yet are left out.
export function readTypedSettings(text: string): Record<string, string> {
  return Object.fromEntries(text.split('\n').map(settingOf).filter((setting) => setting !== null));
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

/// Those that no setting of the server is called.
export function unknownSettings(all: PortSetting[], own: Record<string, string>): string[] {
  return Object.keys(own).filter((key) => !all.some((row) => row.key === key));
}
