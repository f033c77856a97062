// The settings of a port as they are written in the form. Pure.

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
