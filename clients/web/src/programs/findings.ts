// What a check has found, by line and in the order of the text. Pure.
import type { ProgramCheck, ProgramDiagnostic } from '../../generated/api';

/// Those in the program's own text.
export function findingsByLine(check: ProgramCheck | null): Map<number, ProgramDiagnostic[]> {
  const byLine = new Map<number, ProgramDiagnostic[]>();
  for (const found of check?.diagnostics ?? []) {
    if (found.program !== null) continue;
    const line = byLine.get(found.line);
    if (line) line.push(found);
    else byLine.set(found.line, [found]);
  }
  return byLine;
}

/// Alarms first: they end the program. Then as the text has them, those of called programs last.
export function sortFindings(diagnostics: ProgramDiagnostic[]): ProgramDiagnostic[] {
  const rank = (found: ProgramDiagnostic) => (found.severity === 'alarm' ? 0 : found.program === null ? 1 : 2);
  return [...diagnostics].sort((a, b) => rank(a) - rank(b) || a.line - b.line || a.column - b.column);
}
