// Who changed what, the latest first, and the entries that have the words of a filter.
import { useEffect, useState } from 'preact/hooks';
import type { Audit, AuditEntry } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { CommandFault, useCommand } from '../parts/command';
import { Heads } from '../parts/heads';
import { dateTimeText, numberText, texts } from '../texts/texts';
import { searchEntries } from './audit_search';

const kPage = 1000; // the longest answer
const kShown = 500;

function Row({ entry }: { entry: AuditEntry }) {
  return (
    <tr>
      <td>{dateTimeText(entry.time)}</td><td>{entry.who}</td><td>{entry.action}</td><td>{entry.subject}</td>
      <td class="record-text">{entry.detail}</td><td>{entry.credential}</td><td>{entry.address}</td>
    </tr>
  );
}

export function AuditTrail() {
  const t = texts().administration;
  const [entries, setEntries] = useState<AuditEntry[]>([]);
  const [isWhole, setWhole] = useState(false);
  const [filter, setFilter] = useState('');
  const loading = useCommand();
  const loadMore = () => loading.send(async () => {
    const page = await get<Audit>(pathOf('audit'), { limit: kPage, offset: entries.length });
    setEntries([...entries, ...page.entries]);
    setWhole(page.entries.length < kPage);
  });
  useEffect(() => void loadMore(), []);
  const found = searchEntries(entries, filter);
  return (
    <section class="panel" aria-labelledby="audit">
      <h2 id="audit">{t.audit}</h2>
      <div class="tools">
        <label class="search">
          <span class="visually-hidden">{texts().floor.filter}</span>
          <input type="search" placeholder={t.auditFilter} value={filter} onInput={(e) => setFilter(e.currentTarget.value)} />
        </label>
        <span class="muted" role="status">{t.auditFound(numberText(found.length), numberText(entries.length))}</span>
      </div>
      <CommandFault command={loading} />
      <div class="scroll" tabIndex={0} role="group" aria-labelledby="audit">
        <table>
          <Heads of={[t.time, t.who, t.action, t.subject, t.detail, t.credential, t.from]} />
          <tbody>{found.slice(0, kShown).map((entry, i) => <Row key={i} entry={entry} />)}</tbody>
        </table>
      </div>
      {!isWhole && <p class="buttons"><button type="button" disabled={loading.isBusy} onClick={() => void loadMore()}>{t.auditMore}</button></p>}
    </section>
  );
}
