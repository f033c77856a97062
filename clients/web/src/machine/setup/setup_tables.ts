// Finds the tables [[tool]], [[offset]] and [[variable]] in the text of a setup, so that a cell can be changed where it is written: the
// rest of the text, comments included, stays as its author left it. What this does not understand stays text; the server judges. Pure.
export const kTables = ['tool', 'offset', 'variable'] as const;
export type TableName = (typeof kTables)[number];

export interface Cell {
  key: string;
  /// As it is written, quotes included.
  text: string;
  /// Of the value in the setup's text.
  begin: number;
  end: number;
}

export interface Row {
  table: TableName;
  cells: Cell[];
  /// Where another cell can be inserted: after the last line of this table.
  end: number;
}

const kHeader = /^\s*\[\[\s*(tool|offset|variable)\s*\]\]\s*(#.*)?$/;
const kOtherHeader = /^\s*\[/;
const kPair = /^(\s*([A-Za-z_][\w-]*)\s*=\s*)(.*?)\s*$/;

export function readTables(text: string): Row[] {
  const rows: Row[] = [];
  let row: Row | null = null;
  let at = 0;
  for (const line of text.split('\n')) {
    const header = kHeader.exec(line);
    if (header) {
      row = { table: header[1] as TableName, cells: [], end: at + line.length };
      rows.push(row);
    } else if (kOtherHeader.test(line)) {
      row = null;
    } else if (row) {
      const cell = readCell(line, at);
      if (cell) {
        row.cells.push(cell);
        row.end = at + line.length;
      }
    }
    at += line.length + 1;
  }
  return rows;
}

function readCell(line: string, at: number): Cell | null {
  const pair = kPair.exec(line);
  if (!pair) return null;
  const begin = pair[1]!.length;
  const length = valueLength(pair[3]!);
  return length === 0 ? null : { key: pair[2]!, text: line.slice(begin, begin + length), begin: at + begin, end: at + begin + length };
}

/// Up to a comment that is not within quotes.
function valueLength(text: string): number {
  let quote = '';
  for (let i = 0; i < text.length; ++i) {
    const c = text[i]!;
    if (quote !== '') {
      if (c === '\\' && quote === '"') ++i;
      else if (c === quote) quote = '';
    } else if (c === '"' || c === "'") quote = c;
    else if (c === '#') return text.slice(0, i).trimEnd().length;
  }
  return text.trimEnd().length;
}

/// The columns of a table: every key that one of its rows has, in the order in which they come first.
export function columnsOf(rows: Row[]): string[] {
  return [...new Set(rows.flatMap((row) => row.cells.map((cell) => cell.key)))];
}

/// An empty `value` leaves a cell as it is: a line is taken out in the text, not in the table.
export function setCell(text: string, row: Row, key: string, value: string): string {
  const trimmed = value.trim();
  if (trimmed === '') return text;
  const cell = row.cells.find((c) => c.key === key);
  if (cell) return text.slice(0, cell.begin) + trimmed + text.slice(cell.end);
  return `${text.slice(0, row.end)}\n${key} = ${trimmed}${text.slice(row.end)}`;
}

export function addRow(text: string, table: TableName, columns: string[]): string {
  const key = table === 'tool' ? 'number' : 'name';
  const numbers = readTables(text).filter((row) => row.table === table).flatMap((row) => row.cells.filter((c) => c.key === key).map((c) => Number(c.text)));
  const first = table === 'tool' ? String(Math.max(0, ...numbers.filter(Number.isFinite)) + 1) : '""';
  const rest = columns.includes('value') || table === 'variable' ? 'value = 0\n' : '';
  return `${text.trimEnd()}${text.trim() === '' ? '' : '\n\n'}[[${table}]]\n${key} = ${first}\n${rest}`;
}
