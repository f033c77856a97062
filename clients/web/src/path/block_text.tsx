// The program's text around the chosen block. A press on another line chooses that one, where that means something.
import { useEffect, useState } from 'preact/hooks';
import { fetchApi, pathOf, withQuery } from '../api/request';
import { holds, numberLines, rangeAround, type TextWindow } from '../machine/text_window';
import { faultText } from '../parts/command';
import { texts } from '../texts/texts';

/// Lines on each side of the chosen one.
const kShown = 9;

export interface ProgramRevision {
  program: string;
  revision: number;
  size: number;
}

interface Props {
  of: ProgramRevision;
  line: number;
  offset: number;
  onChoose?: (line: number) => void;
}

async function load({ program, revision, size }: ProgramRevision, offset: number, signal: AbortSignal): Promise<TextWindow> {
  const { first, last } = rangeAround(offset, size);
  const response = await fetchApi('GET', withQuery(pathOf('programs', program, 'content'), { revision }), { range: `bytes=${first}-${last}` }, signal);
  return { offset: first, bytes: new Uint8Array(await response.arrayBuffer()), size };
}

function Block({ row }: { row: { number: number; text: string } }) {
  return <><span class="number">{row.number}</span><span class="text">{row.text}</span></>;
}

export function BlockText({ of, line, offset, onChoose }: Props) {
  const t = texts().path;
  const [window, setWindow] = useState<TextWindow | null>(null);
  const [fault, setFault] = useState<string | null>(null);
  const isMissing = window === null || !holds(window, offset);
  useEffect(() => {
    if (!isMissing) return undefined;
    const ending = new AbortController();
    load(of, offset, ending.signal).then(setWindow, (failure: unknown) => { if (!ending.signal.aborted) setFault(faultText(failure, false)); });
    return () => ending.abort();
  }, [of.program, of.revision, offset, isMissing]);
  const lines = window && !isMissing ? numberLines(window, offset, line) : [];
  const at = lines.findIndex((row) => row.number === line);
  return (
    <>
      {fault !== null && <p class="notice bad">{fault}</p>}
      <ol class="blocks mono path-blocks" aria-label={t.blocks}>
        {lines.slice(Math.max(0, at - kShown), at + kShown + 1).map((row) => (
          <li key={row.number} aria-current={row.number === line ? 'step' : undefined}>
            {onChoose ? <button type="button" class="block" onClick={() => onChoose(row.number)}><Block row={row} /></button> : <Block row={row} />}
          </li>
        ))}
      </ol>
    </>
  );
}
