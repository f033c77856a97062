// Takes a block apart for the eye: comments, block numbers, words by letter. It decides nothing: the control's interpreter does. Pure.
export type PartKind = 'comment' | 'number' | 'code' | 'word' | 'text';

export interface Part {
  kind: PartKind;
  text: string;
}

const kPart = /(\([^)]*\)?|;.*$)|([Nn]\d+|^\d+(?=\s))|([GMTgmt]\s?\d+(?:\.\d+)?|\b(?:CYCL DEF|CYCL CALL|TOOL CALL|TOOL DEF|LBL|CALL LBL|BEGIN PGM|END PGM|STOP)\b)|([A-Za-z]\s?[+-]?[\d.,]+)/g;

export function partsOf(block: string): Part[] {
  const parts: Part[] = [];
  let at = 0;
  for (const match of block.matchAll(kPart)) {
    if (match.index > at) parts.push({ kind: 'text', text: block.slice(at, match.index) });
    const kind: PartKind = match[1] ? 'comment' : match[2] ? 'number' : match[3] ? 'code' : 'word';
    parts.push({ kind, text: match[0] });
    at = match.index + match[0].length;
  }
  if (at < block.length) parts.push({ kind: 'text', text: block.slice(at) });
  return parts;
}
