// Who changed what, the latest first.
import { useState } from 'preact/hooks';
import type { Audit } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, texts } from '../texts/texts';

const kPage = 100;

export function AuditTrail() {
  const t = texts().administration;
  const [offset, setOffset] = useState(0);
  const audit = useLoaded((signal) => get<Audit>(pathOf('audit'), { limit: kPage, offset }, signal), [offset]);
  const entries = audit.value?.entries ?? [];
  return (
    <section class="panel" aria-labelledby="audit">
      <h2 id="audit">{t.audit}</h2>
      <Loading of={audit} />
      <div class="scroll" tabIndex={0} role="group" aria-labelledby="audit">
        <table>
          <thead><tr>{[t.time, t.who, t.action, t.subject, t.detail].map((name) => <th scope="col" key={name}>{name}</th>)}</tr></thead>
          <tbody>
            {entries.map((entry, i) => (
              <tr key={offset + i}><td>{dateTimeText(entry.time)}</td><td>{entry.who}</td><td>{entry.action}</td><td>{entry.subject}</td><td class="record-text">{entry.detail}</td></tr>
            ))}
          </tbody>
        </table>
      </div>
      <p class="buttons">
        <button type="button" disabled={offset === 0} onClick={() => setOffset(Math.max(0, offset - kPage))}>{texts().reports.newer}</button>
        <button type="button" disabled={entries.length < kPage} onClick={() => setOffset(offset + kPage)}>{texts().reports.older}</button>
      </p>
    </section>
  );
}
