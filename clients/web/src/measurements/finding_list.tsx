// Report lines that no template knows, and those that are missing, come twice or out of order. None is dropped.
import { useEffect } from 'preact/hooks';
import type { ReportFinding, ReportFindings } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { feed } from '../live/feed';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { MachineChoice } from '../parts/machine_choice';
import { Pages } from '../parts/pages';
import { useOffset } from '../parts/use_kept';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, texts } from '../texts/texts';

const kPage = 100;

export function FindingTable({ findings, label }: { findings: ReportFinding[]; label: string }) {
  const t = texts().measurements;
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={label}>
      <table class="data">
        <Heads of={[t.finding, texts().reports.text, texts().reports.machine, texts().reports.run, t.part, t.time]} />
        <tbody>
          {findings.map((found) => (
            <tr key={found.id}>
              <th scope="row"><span class={`pill ${found.kind === 'unmatched' ? 'offline' : 'waiting'}`}>{t.findingKinds[found.kind]}</span></th>
              <td class="mono record-text">{found.text}</td>
              <td>{found.machine}</td>
              <td>{found.run === null ? '–' : <a href={addressOf('reports', [found.run])}>{found.run.slice(0, 8)}</a>}</td>
              <td>{found.part === null ? '–' : <a href={addressOf('measurements', ['parts', String(found.part)])}>{found.part}</a>}</td>
              <td>{dateTimeText(found.time)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

export function FindingList({ query }: { query: URLSearchParams }) {
  const t = texts().measurements;
  const machine = query.get('machine') ?? '';
  const [offset, setOffset] = useOffset(machine);
  const findings = useLoaded((signal) => get<ReportFindings>(pathOf('report-findings'), { machine, limit: kPage, offset }, signal), [machine, offset]);
  useEffect(() => feed.on('parts', findings.reload), []);
  const list = findings.value?.findings ?? [];
  return (
    <>
      <p class="hint">{t.findingsHint}</p>
      <div class="tools"><MachineChoice value={machine} onChoose={(chosen) => location.replace(addressOf('measurements', ['findings'], { machine: chosen }))} /></div>
      <Loading of={findings} />
      {findings.value && list.length === 0 && <p class="notice">{t.noFindings}</p>}
      {list.length > 0 && <FindingTable findings={list} label={t.tabs.findings} />}
      {(offset > 0 || list.length === kPage) && <Pages offset={offset} size={kPage} count={list.length} onOffset={setOffset} />}
    </>
  );
}
