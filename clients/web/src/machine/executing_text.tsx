// The program's text with the block that is being executed, kept in sight.
import { useEffect, useRef, useState } from 'preact/hooks';
import type { Run, Status } from '../../generated/api';
import { fetchApi, pathOf, withQuery } from '../api/request';
import { faultText } from '../parts/command';
import { texts } from '../texts/texts';
import { holds, numberLines, rangeAround, type TextWindow } from './text_window';

/// Lines on each side of the executing one: what a display shows.
const kShown = 14;

async function load(run: Run, offset: number, signal: AbortSignal): Promise<TextWindow> {
  const { first, last } = rangeAround(offset, run.size);
  const path = withQuery(pathOf('programs', run.program, 'content'), { revision: run.revision });
  const response = await fetchApi('GET', path, { range: `bytes=${first}-${last}` }, signal);
  return { offset: first, bytes: new Uint8Array(await response.arrayBuffer()), size: run.size };
}

function useWindow(run: Run | undefined, offset: number): { window: TextWindow | null; fault: string | null } {
  const [state, setState] = useState<{ run: string; window: TextWindow | null; fault: string | null } | null>(null);
  const current = state !== null && state.run === run?.id ? state : null;
  const isMissing = run !== undefined && run.size > 0 && (current?.window ? !holds(current.window, offset) : current?.fault == null);
  useEffect(() => {
    if (!isMissing) return undefined;
    const ending = new AbortController();
    load(run, offset, ending.signal).then(
      (window) => setState({ run: run.id, window, fault: null }),
      (failure: unknown) => { if (!ending.signal.aborted) setState({ run: run.id, window: null, fault: faultText(failure, false) }); });
    return () => ending.abort();
  }, [run?.id, isMissing]);
  return { window: current?.window ?? null, fault: current?.fault ?? null };
}

export function ExecutingText({ run, status }: { run: Run | undefined; status: NonNullable<Status> }) {
  const t = texts().machine;
  const { window, fault } = useWindow(run, status.offset);
  const executing = useRef<HTMLLIElement>(null);
  useEffect(() => executing.current?.scrollIntoView({ block: 'nearest' }), [status.line, window]);
  if (!run) return null;
  const lines = window ? numberLines(window, status.offset, status.line) : [];
  const at = lines.findIndex((line) => line.number === status.line);
  const shown = lines.slice(Math.max(0, at - kShown), at + kShown + 1);
  return (
    <section class="panel live" aria-labelledby="text">
      <h2 id="text">{run.program} <span class="muted">{t.revision(run.revision)}</span></h2>
      {fault !== null && <p class="notice bad">{fault}</p>}
      <ol class="blocks mono" tabIndex={0} aria-labelledby="text">
        {shown.map((line) => (
          <li key={line.number} ref={line.number === status.line ? executing : null} aria-current={line.number === status.line ? 'step' : undefined}>
            <span class="number">{line.number}</span> <span class="text">{line.text}</span>
          </li>
        ))}
      </ol>
    </section>
  );
}
