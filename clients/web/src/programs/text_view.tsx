// The text of one revision. Only the lines in sight are drawn, and only one piece of the program is in memory.
import { useEffect, useRef, useState } from 'preact/hooks';
import { fetchApi, pathOf, withQuery } from '../api/request';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { bytesText, numberText, texts } from '../texts/texts';
import { kPieceBytes, pieceOf, type Piece } from './pieces';
import { partsOf } from './syntax';

const kLineHeight = 24; // px, as in code.css
const kMargin = 20;

interface Revision {
  program: string;
  revision: number;
  size: number;
}

async function loadPiece({ program, revision, size }: Revision, start: { offset: number; line: number }, signal: AbortSignal): Promise<Piece> {
  if (size === 0) return pieceOf(new Uint8Array(), 0, 1, 0);
  const range = `bytes=${start.offset}-${Math.min(size, start.offset + kPieceBytes) - 1}`;
  const response = await fetchApi('GET', withQuery(pathOf('programs', program, 'content'), { revision }), { range }, signal);
  return pieceOf(new Uint8Array(await response.arrayBuffer()), start.offset, start.line, size);
}

function Lines({ piece, label }: { piece: Piece; label: string }) {
  const frame = useRef<HTMLDivElement>(null);
  const [top, setTop] = useState(0);
  useEffect(() => {
    if (frame.current) frame.current.scrollTop = 0;
    setTop(0);
  }, [piece]);
  const shown = Math.ceil((frame.current?.clientHeight ?? 600) / kLineHeight);
  const first = Math.max(0, Math.floor(top / kLineHeight) - kMargin);
  const lines = piece.lines.slice(first, first + shown + 2 * kMargin);
  return (
    <div ref={frame} class="code" tabIndex={0} role="region" aria-label={label} onScroll={(e) => setTop(e.currentTarget.scrollTop)}>
      <div class="all" style={{ height: `${piece.lines.length * kLineHeight}px` }}>
        <ol class="blocks mono" style={{ transform: `translateY(${first * kLineHeight}px)` }}>
          {lines.map((line, i) => (
            <li key={first + i}>
              <span class="number">{piece.line + first + i}</span>
              <span class="text">{partsOf(line).map((part, j) => <span key={j} class={`part-${part.kind}`}>{part.text}</span>)}</span>
            </li>
          ))}
        </ol>
      </div>
    </div>
  );
}

export function TextView(revision: Revision) {
  const t = texts().programs;
  /// Where this piece and those before it begin.
  const [starts, setStarts] = useState([{ offset: 0, line: 1 }]);
  const start = starts[starts.length - 1]!;
  const piece = useLoaded((signal) => loadPiece(revision, start, signal), [revision.program, revision.revision, start.offset]);
  useEffect(() => setStarts([{ offset: 0, line: 1 }]), [revision.program, revision.revision]);
  const { value } = piece;
  const hasMore = value !== null && value.end < revision.size;
  return (
    <>
      <Loading of={piece} />
      {value && <Lines piece={value} label={t.textOf(revision.program, revision.revision)} />}
      {value && (starts.length > 1 || hasMore) && (
        <p class="buttons">
          <button type="button" disabled={starts.length === 1} onClick={() => setStarts(starts.slice(0, -1))}>{t.previous}</button>
          <button type="button" disabled={!hasMore} onClick={() => setStarts([...starts, { offset: value.end, line: value.line + value.lines.length }])}>{t.next}</button>
          <span class="muted">{t.piece(numberText(value.line), numberText(value.line + value.lines.length - 1), bytesText(revision.size))}</span>
        </p>
      )}
    </>
  );
}
