// The runs with what they reported, newest first, and what machines printed outside any run.
import { useState } from 'preact/hooks';
import type { MachineReports, Runs } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { CommandFault, useCommand } from '../parts/command';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { Pages } from '../parts/pages';
import { ReportTabs } from '../parts/report_tabs';
import { RunPill } from '../parts/run_pill';
import { useLoaded } from '../parts/use_loaded';
import { download } from '../programs/download';
import { dateTimeText, numberText, texts } from '../texts/texts';
import { Exports } from './exports';

const kPage = 100;

function OutsideRuns() {
  const t = texts().reports;
  const reports = useLoaded((signal) => get<MachineReports>(pathOf('machine-reports'), {}, signal), []);
  const command = useCommand();
  if (!reports.value || reports.value.reports.length === 0) return <Loading of={reports} />;
  return (
    <section class="panel" aria-labelledby="outside">
      <h2 id="outside">{t.outsideRuns}</h2>
      <ul class="list">
        {reports.value.reports.map((report) => (
          <li key={report.machine} class="head">
            <span><b>{report.machine}</b> {t.lines(report.lines)}, {dateTimeText(report.first)} – {dateTimeText(report.last)}</span>
            <Exports onExport={(format) => void command.send(() => download(`${pathOf('machines', report.machine, 'report')}?format=${format}`, `${report.machine}.${format}`))} />
          </li>
        ))}
      </ul>
      <CommandFault command={command} />
    </section>
  );
}

export function ReportList({ query }: { query: URLSearchParams }) {
  const t = texts().reports;
  const [machine, setMachine] = useState(query.get('machine') ?? '');
  const [program, setProgram] = useState(query.get('program') ?? '');
  const [offset, setOffset] = useState(0);
  const runs = useLoaded((signal) => get<Runs>(pathOf('runs'), { machine, program, limit: kPage, offset }, signal), [machine, program, offset]);
  const list = runs.value?.runs ?? [];
  const choose = (set: (value: string) => void) => (e: { currentTarget: HTMLInputElement }) => {
    set(e.currentTarget.value.trim());
    setOffset(0);
  };
  return (
    <>
      <h1>{t.title}</h1>
      <ReportTabs shown="runs" />
      <div class="tools">
        <label>{t.machine}<input value={machine} onChange={choose(setMachine)} /></label>
        <label>{t.program}<input value={program} onChange={choose(setProgram)} /></label>
      </div>
      <Loading of={runs} />
      <div class="scroll" tabIndex={0} role="region" aria-label={t.title}>
        <table class="data">
          <Heads of={[t.program, t.machine, t.state, t.begun, t.ended, t.blocks, t.linesHead]} />
          <tbody>
            {list.map((run) => (
              <tr key={run.id}>
                <th scope="row"><a class="target" href={addressOf('reports', [run.id])}>{run.program}</a> <span class="muted">{run.revision}</span></th>
                <td>{run.machine}</td>
                <td><RunPill state={run.state} /></td>
                <td>{dateTimeText(run.started ?? run.created)}</td>
                <td>{run.ended ? dateTimeText(run.ended) : '–'}</td>
                <td>{numberText(run.executed)}</td>
                <td>{numberText(run.outputs)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <Pages offset={offset} size={kPage} count={list.length} onOffset={setOffset} />
      <OutsideRuns />
    </>
  );
}
