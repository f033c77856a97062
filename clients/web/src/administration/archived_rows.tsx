// The rows of one archive, read back from its file, which the server reads to its end: only then it is known to be whole.
import { useState } from 'preact/hooks';
import type { Archive, ArchivedRows as Answer } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { useOffset } from '../parts/use_kept';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, numberText, texts } from '../texts/texts';
import { lineOf, type ArchiveLine } from './archive_row';

const kPage = 200;
const kMaxText = 200;

function Line({ of }: { of: ArchiveLine }) {
  return (
    <tr>
      <td>{of.time === null ? '–' : dateTimeText(of.time)}</td>
      <td>{of.machine}</td>
      <td>{of.run === '' ? '–' : <a href={addressOf('reports', [of.run])}>{of.run.slice(0, 8)}</a>}</td>
      <td>{of.kind}</td>
      <td class="mono record-text">{of.text}</td>
    </tr>
  );
}

export function ArchivedRows({ archive }: { archive: Archive }) {
  const t = texts().archives;
  const r = texts().reports;
  const [typed, setTyped] = useState('');
  const [contains, setContains] = useState('');
  const [offset, setOffset] = useOffset(contains);
  const rows = useLoaded((signal) => get<Answer>(pathOf('archives', archive.id, 'rows'), { contains, limit: kPage, offset }, signal), [archive.id, contains, offset]);
  const search = (event: Event) => {
    event.preventDefault();
    setContains(typed);
  };
  const list = rows.value?.rows ?? [];
  return (
    <section class="archived" aria-labelledby="archived">
      <h3 id="archived">{t.rowsOf(archive.file)}</h3>
      <form class="with-button" onSubmit={search}>
        <label>{t.contains}<input maxLength={kMaxText} autocomplete="off" value={typed} onInput={(e) => setTyped(e.currentTarget.value)} /></label>
        <button type="submit">{t.search}</button>
      </form>
      <Loading of={rows} />
      {rows.value && (
        <p role="status"><span class="pill running">{t.whole}</span> {t.found(numberText(rows.value.found), numberText(archive.rows))}</p>
      )}
      {list.length > 0 && (
        <div class="scroll" tabIndex={0} role="group" aria-labelledby="archived">
          <table class="data">
            <Heads of={[r.time, r.machine, r.run, r.kind, r.text]} />
            <tbody>{list.map((row, i) => <Line key={offset + i} of={lineOf(row as Record<string, unknown>)} />)}</tbody>
          </table>
        </div>
      )}
      {rows.value && rows.value.found > kPage && (
        <p class="buttons">
          <button type="button" disabled={offset === 0} onClick={() => setOffset(Math.max(0, offset - kPage))}>{r.earlier}</button>
          <button type="button" disabled={offset + kPage >= rows.value.found} onClick={() => setOffset(offset + kPage)}>{r.later}</button>
        </p>
      )}
      <p class="hint mono">SHA-256 {archive.sha256}</p>
    </section>
  );
}
