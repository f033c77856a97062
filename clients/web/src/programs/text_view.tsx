// The text of one revision, with what a check has found beside its lines. Only the lines in sight are drawn, and only one piece of the program is
// in memory.
import { useEffect, useRef, useState } from 'preact/hooks';
import type { ProgramDiagnostic } from '../../generated/api';
import { fetchApi, pathOf, withQuery } from '../api/request';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import type { ProgramRevision } from '../path/block_text';
import { bytesText, numberText, texts } from '../texts/texts';
import { holdsPlace, nextOf, pieceOf, rangeAround, rangeBefore, rangeFrom, type Piece, type Place, type Range } from './pieces';
import { partsOf } from './syntax';

const kLineHeight = 24; // px, as in code.css
const kMargin = 20;
const kSigns = { warning: '▲', alarm: '■' };

interface Props extends ProgramRevision {
  /// By line.
  findings: Map<number, ProgramDiagnostic[]>;
  /// A line to be gone to; another object is another wish.
  goTo: Place | null;
}

async function loadPiece({ program, revision, size }: ProgramRevision, range: Range, signal: AbortSignal): Promise<Piece> {
  if (range.end === range.first) return pieceOf(new Uint8Array(), range, size);
  const request = withQuery(pathOf('programs', program, 'content'), { revision });
  const response = await fetchApi('GET', request, { range: `bytes=${range.first}-${range.end - 1}` }, signal);
  return pieceOf(new Uint8Array(await response.arrayBuffer()), range, size);
}

function Findings({ findings }: { findings: ProgramDiagnostic[] }) {
  return (
    <span class="findings">
      {findings.map((found, i) => <span key={i} class={`finding ${found.severity}`}>{texts().check.severities[found.severity]} {found.id}: {found.text}</span>)}
    </span>
  );
}

function Line({ number, text, isChosen, findings }: { number: number; text: string; isChosen: boolean; findings: ProgramDiagnostic[] | undefined }) {
  const worst = findings && (findings.some((found) => found.severity === 'alarm') ? 'alarm' : 'warning');
  return (
    <li class={worst} aria-current={isChosen ? 'location' : undefined}>
      <span class="number">{worst && <span class={`sign ${worst}`} aria-hidden="true">{kSigns[worst]}</span>}{number}</span>
      <span class="text">{partsOf(text).map((part, j) => <span key={j} class={`part-${part.kind}`}>{part.text}</span>)}</span>
      {findings && <Findings findings={findings} />}
    </li>
  );
}

function Lines({ piece, label, findings, goTo }: { piece: Piece; label: string; findings: Map<number, ProgramDiagnostic[]>; goTo: Place | null }) {
  const frame = useRef<HTMLDivElement>(null);
  const [top, setTop] = useState(0);
  useEffect(() => {
    const element = frame.current;
    if (!element) return;
    const line = goTo && holdsPlace(piece, goTo.offset) ? goTo.line - piece.line : 0;
    element.scrollTop = Math.max(0, line * kLineHeight - element.clientHeight / 3);
    setTop(element.scrollTop);
  }, [piece, goTo]);
  const shown = Math.ceil((frame.current?.clientHeight ?? 600) / kLineHeight);
  const first = Math.max(0, Math.floor(top / kLineHeight) - kMargin);
  const lines = piece.lines.slice(first, first + shown + 2 * kMargin);
  return (
    <div ref={frame} class="code" tabIndex={0} role="region" aria-label={label} onScroll={(e) => setTop(e.currentTarget.scrollTop)}>
      <div class="all" style={{ height: `${piece.lines.length * kLineHeight}px` }}>
        <ol class="blocks mono" style={{ transform: `translateY(${first * kLineHeight}px)` }}>
          {lines.map((line, i) => {
            const number = piece.line + first + i;
            return <Line key={number} number={number} text={line} isChosen={number === goTo?.line} findings={findings.get(number)} />;
          })}
        </ol>
      </div>
    </div>
  );
}

export function TextView({ program, revision, size, findings, goTo }: Props) {
  const t = texts().programs;
  const of = { program, revision, size };
  const [moved, setMoved] = useState<{ program: string; revision: number; range: Range } | null>(null);
  // Another revision is read from its beginning.
  const range = moved?.program === program && moved.revision === revision ? moved.range : rangeFrom({ offset: 0, line: 1 }, size);
  const moveTo = (next: Range) => setMoved({ program, revision, range: next });
  const piece = useLoaded((signal) => loadPiece(of, range, signal), [program, revision, range.first, range.end]);
  const { value } = piece;
  useEffect(() => {
    if (goTo && value && !holdsPlace(value, goTo.offset)) moveTo(rangeAround(goTo, size));
  }, [goTo]);
  const hasMore = value !== null && value.end < size;
  const hasBefore = value !== null && value.offset > 0;
  return (
    <>
      <Loading of={piece} />
      {value && <Lines piece={value} label={t.textOf(program, revision)} findings={findings} goTo={goTo} />}
      {value && (hasBefore || hasMore) && (
        <p class="buttons">
          <button type="button" disabled={!hasBefore} onClick={() => moveTo(rangeBefore(value))}>{t.previous}</button>
          <button type="button" disabled={!hasMore} onClick={() => moveTo(rangeFrom(nextOf(value), size))}>{t.next}</button>
          <span class="muted">{t.piece(numberText(value.line), numberText(value.line + value.lines.length - 1), bytesText(size))}</span>
        </p>
      )}
    </>
  );
}
