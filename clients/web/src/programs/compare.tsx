// Two revisions of a program, by their text.
import { useState } from 'preact/hooks';
import type { Revision } from '../../generated/api';
import { fetchApi, pathOf, withQuery } from '../api/request';
import { addressOf } from '../app/route';
import { DiffView } from '../parts/diff_view';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { bytesText, texts } from '../texts/texts';

/// Longer texts are compared by tools that need not hold both.
const kMaxBytes = 2 * 1024 * 1024;

async function textOf(revision: Revision, signal: AbortSignal): Promise<string> {
  const path = withQuery(pathOf('programs', revision.program, 'content'), { revision: revision.revision });
  return (await fetchApi('GET', path, {}, signal)).text();
}

function Difference({ from, to }: { from: Revision; to: Revision }) {
  const both = useLoaded((signal) => Promise.all([textOf(from, signal), textOf(to, signal)]), [from.sha256, to.sha256]);
  return <><Loading of={both} />{both.value && <DiffView before={both.value[0]} after={both.value[1]} />}</>;
}

export function Compare({ revisions, to }: { revisions: Revision[]; to: Revision }) {
  const t = texts().programs;
  const others = revisions.filter((r) => r.revision !== to.revision);
  const [chosen, setChosen] = useState<number | null>(null);
  const from = others.find((r) => r.revision === chosen);
  if (others.length === 0) return null;
  return (
    <section class="panel" aria-labelledby="compare">
      <h2 id="compare">{t.compare}</h2>
      <label>
        {t.compareWith(to.revision)}
        <select value={chosen ?? ''} onChange={(e) => setChosen(Number(e.currentTarget.value) || null)}>
          <option value="">–</option>
          {others.map((r) => <option key={r.revision} value={r.revision}>{t.revisionNumber(r.revision)}</option>)}
        </select>
      </label>
      {from && <p><a class="button" href={addressOf('compare', [to.program, String(from.revision), String(to.revision)])}>{texts().compare.open}</a></p>}
      {from && (Math.max(from.size, to.size) > kMaxBytes ? <p class="notice">{t.tooLong(bytesText(kMaxBytes))}</p> : <Difference from={from} to={to} />)}
    </section>
  );
}
