// What a search of words has found: programs whose names begin so, and revisions with the line that has most of the words, newest first.
import { useEffect, useState } from 'preact/hooks';
import type { Program, SearchHit } from '../../generated/api';
import { addressOf } from '../app/route';
import { CommandFault, useCommand } from '../parts/command';
import { Loading } from '../parts/loading';
import { RevisionPill } from '../parts/revision_pill';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, numberText, texts } from '../texts/texts';
import { findPrograms, markWords, namedSo, type Filters } from './search';

const kTypingMs = 250;
const kIndexingMs = 1500;

/// Follows what is typed when it has not changed for a moment.
export function useSlow<T>(value: T): T {
  const [slow, setSlow] = useState(value);
  useEffect(() => {
    const timer = setTimeout(() => setSlow(value), kTypingMs);
    return () => clearTimeout(timer);
  }, [value]);
  return slow;
}

function Marked({ text, typed }: { text: string; typed: string }) {
  return <>{markWords(text, typed).map((part, i) => (part.isFound ? <mark key={i}>{part.text}</mark> : part.text))}</>;
}

function Facts({ of, typed }: { of: Array<string | null>; typed: string }) {
  return <p class="muted">{of.filter((fact) => fact !== null && fact !== '').map((fact, i) => <span key={i}>{i > 0 && ' · '}<Marked text={fact!} typed={typed} /></span>)}</p>;
}

function Hit({ hit, typed }: { hit: SearchHit; typed: string }) {
  const t = texts().library;
  const line: Record<string, string> = hit.line === null ? {} : { line: String(hit.line) };
  return (
    <li class="panel hit">
      <div class="head">
        <h3><a href={addressOf('programs', [hit.program, String(hit.revision)], line)}><Marked text={hit.program} typed={typed} /></a> <span class="muted">{texts().machine.revision(hit.revision)}</span></h3>
        <RevisionPill revision={hit} />
      </div>
      <Facts typed={typed} of={[hit.title, hit.part, hit.operation, hit.material, hit.machine_group, hit.cam_file, hit.control]} />
      {hit.text !== null && <p class="mono line"><span class="muted">{numberText(hit.line!)}</span> <Marked text={hit.text} typed={typed} /></p>}
      <Facts typed={typed} of={[dateTimeText(hit.created), hit.author, hit.comment, hit.partly_indexed ? t.partly : null]} />
    </li>
  );
}

function Named({ programs, typed }: { programs: Program[]; typed: string }) {
  if (programs.length === 0) return null;
  return (
    <>
      <h2>{texts().library.named}</h2>
      <ul class="named">
        {programs.map((p) => <li key={p.name}><a class="button" href={addressOf('programs', [p.name])}><span><Marked text={p.name} typed={typed} /></span>{p.title !== null && <span class="muted">{p.title}</span>}</a></li>)}
      </ul>
    </>
  );
}

export function SearchHits({ typed, filters, replaced }: { typed: string; filters: Filters; replaced: boolean }) {
  const t = texts().library;
  const inputs = [typed, replaced, ...Object.values(filters)];
  const named = useLoaded((signal) => namedSo(typed, filters, signal), inputs);
  const first = useLoaded((signal) => findPrograms({ typed, filters, replaced, before: null }, signal), inputs);
  const [more, setMore] = useState<{ hits: SearchHit[]; next: number | null } | null>(null);
  const loading = useCommand();
  useEffect(() => setMore(null), [first.value]);
  const toBeIndexed = first.value?.to_be_indexed ?? 0;
  // What was stored a moment ago is found a moment later.
  useEffect(() => {
    if (toBeIndexed === 0 || more) return undefined;
    const timer = setTimeout(first.reload, kIndexingMs);
    return () => clearTimeout(timer);
  }, [first.value, more]);
  const hits = [...(first.value?.hits ?? []), ...(more?.hits ?? [])];
  const next = more ? more.next : (first.value?.next ?? null);
  const loadMore = () => loading.send(async () => {
    const page = await findPrograms({ typed, filters, replaced, before: next }, new AbortController().signal);
    setMore({ hits: [...(more?.hits ?? []), ...page.hits], next: page.next });
  });
  return (
    <>
      <Named programs={named.value ?? []} typed={typed} />
      <h2>{t.found}</h2>
      {first.fault === null ? <Loading of={first} /> : <p class="notice warn" role="status">{first.fault}</p>}
      {first.fault === null && first.value && <p class="muted" role="status">{next === null ? t.hits(hits.length) : t.hitsAndMore(hits.length)}{toBeIndexed > 0 && ` ${t.toBeIndexed(toBeIndexed)}`}</p>}
      {first.fault === null && <ul class="list">{hits.map((hit) => <Hit key={`${hit.program} ${hit.revision}`} hit={hit} typed={typed} />)}</ul>}
      {next !== null && <p class="buttons"><button type="button" disabled={loading.isBusy} onClick={() => void loadMore()}>{t.more}</button></p>}
      <CommandFault command={loading} />
    </>
  );
}
