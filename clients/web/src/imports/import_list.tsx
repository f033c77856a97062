// What machines have sent: what waits, the oldest first, or what was decided, the latest first.
import { useState } from 'preact/hooks';
import type { Import, Imports } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { useFeed } from '../live/use_feed';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { Pages } from '../parts/pages';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, texts } from '../texts/texts';
import { ClassPill } from './class_pill';

const kPage = 100;

function Table({ label, heads, imports, cells }: { label: string; heads: string[]; imports: Import[]; cells: (import_: Import) => Array<string | null> }) {
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={label}>
      <table class="data">
        <Heads of={heads} />
        <tbody>
          {imports.map((row) => (
            <tr key={`${row.program} ${row.revision}`}>
              <th scope="row"><a class="target" href={addressOf('imports', [row.program, String(row.revision)])}>{row.program}</a> <span class="muted">{row.revision}</span></th>
              <td>{row.machine}</td>
              <td><ClassPill import_={row} /></td>
              {cells(row).map((text, i) => <td key={i}>{text ?? '–'}</td>)}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

export function PendingList() {
  const t = texts().imports;
  const feed = useFeed('imports', 'link');
  const imports = [...feed.imports.values()].sort((a, b) => a.received.localeCompare(b.received));
  if (imports.length === 0) return <p class="muted">{feed.link.state === 'connecting' ? texts().app.loading : t.none}</p>;
  return (
    <Table label={t.tabs.pending} heads={[texts().machine.program, t.machine, t.class, t.against, t.received, texts().setup.comment]} imports={imports}
      cells={(row) => [row.base === null ? null : texts().programs.revisionNumber(row.base), dateTimeText(row.received), row.comment]} />
  );
}

export function decisionText(import_: Import): string {
  const t = texts().imports;
  const how = import_.at_once ? t.atOnce : import_.accepted_as ? t.acceptedAs(import_.accepted_as.program, import_.accepted_as.revision) : '';
  return [t.states[import_.state], how].filter((part) => part !== '').join(' ');
}

export function DecidedList() {
  const t = texts().imports;
  const { imports: pending } = useFeed('imports');
  const [offset, setOffset] = useState(0);
  const decided = useLoaded((signal) => get<Imports>(pathOf('imports'), { state: 'decided', limit: kPage, offset }, signal), [offset, pending.size]);
  const list = decided.value?.imports ?? [];
  return (
    <>
      <Loading of={decided} />
      {decided.value && list.length === 0 && <p class="muted">{t.noneDecided}</p>}
      {list.length > 0 && (
        <Table label={t.tabs.decided} heads={[texts().machine.program, t.machine, t.class, t.decision, t.received, t.who, t.reason]} imports={list}
          cells={(row) => [decisionText(row), row.decided === null ? null : dateTimeText(row.decided), row.who, row.reason]} />
      )}
      {(offset > 0 || list.length === kPage) && <Pages offset={offset} size={kPage} count={list.length} onOffset={setOffset} />}
    </>
  );
}
