// One run: how it went, its parts with their verdicts, what it measured, every record, and its exports.
import { useState } from 'preact/hooks';
import type { Record as ReportRecord, Records, Run } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { useFeed } from '../live/use_feed';
import { recordText } from '../live/record_text';
import { CommandFault, useCommand } from '../parts/command';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { RunPill } from '../parts/run_pill';
import { useLoaded } from '../parts/use_loaded';
import { download } from '../programs/download';
import { dateTimeText, numberText, texts, timeText } from '../texts/texts';
import { Exports } from './exports';
import { Measured } from './measured';
import { RunOffsets } from './run_offsets';
import { RunParts } from './run_parts';

const kPage = 1000;
/// A run may report for hours: more is for the exports.
const kMax = 20_000;
const kShown = 200;

async function loadRecords(run: string, signal: AbortSignal): Promise<ReportRecord[]> {
  const all: ReportRecord[] = [];
  while (all.length < kMax) {
    const { records } = await get<Records>(pathOf('runs', run, 'records'), { limit: kPage, offset: all.length }, signal);
    all.push(...records);
    if (records.length < kPage) break;
  }
  return all;
}

function RecordTable({ records }: { records: ReportRecord[] }) {
  const t = texts().reports;
  const kinds = [...new Set(records.map((record) => record.kind))];
  const [kind, setKind] = useState('');
  const [page, setPage] = useState(0);
  const fitting = kind === '' ? records : records.filter((record) => record.kind === kind);
  const shown = fitting.slice(page * kShown, (page + 1) * kShown);
  return (
    <section class="panel" aria-labelledby="all-records">
      <h2 id="all-records">{t.records(numberText(records.length))}</h2>
      {records.length >= kMax && <p class="notice warn">{t.onlyFirst(numberText(kMax))}</p>}
      <label>
        {t.kind}
        <select value={kind} onChange={(e) => { setKind(e.currentTarget.value); setPage(0); }}>
          <option value="">{texts().floor.all}</option>
          {kinds.map((key) => <option key={key} value={key}>{texts().machine.kinds[key]}</option>)}
        </select>
      </label>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.tableOfRecords}>
        <table>
          <Heads of={[t.time, t.kind, t.line, t.device, t.text]} />
          <tbody>
            {shown.map((record) => (
              <tr key={`${record.epoch}/${record.number}`} class={record.kind}>
                <td>{timeText(record.time)}</td><td>{texts().machine.kinds[record.kind]}</td><td>{record.line}</td><td>{record.device}</td>
                <td class="mono record-text">{recordText(record)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {fitting.length > kShown && (
        <p class="buttons">
          <button type="button" disabled={page === 0} onClick={() => setPage(page - 1)}>{t.earlier}</button>
          <button type="button" disabled={(page + 1) * kShown >= fitting.length} onClick={() => setPage(page + 1)}>{t.later}</button>
        </p>
      )}
    </section>
  );
}

export function RunReport({ id, query }: { id: string; query: URLSearchParams }) {
  const t = texts().reports;
  const feed = useFeed('runs');
  const loaded = useLoaded((signal) => get<Run>(pathOf('runs', id), {}, signal), [id]);
  const live = [...feed.runs.values()].find((run) => run.id === id);
  const run = live ?? loaded.value;
  // A run that continues reports more: the records are read again when it has ended.
  const records = useLoaded((signal) => loadRecords(id, signal), [id, run?.state]);
  const command = useCommand();
  if (!run) return <><h1>{t.run}</h1><Loading of={loaded} /></>;
  const file = `${run.program}-${id.slice(0, 8)}`;
  return (
    <>
      <div class="machine-head">
        <h1><a href={addressOf('programs', [run.program, String(run.revision)])}>{run.program}</a></h1>
        <RunPill state={run.state} />
        <span class="muted">{texts().machine.revision(run.revision)} · <a href={addressOf('machine', [run.machine])}>{run.machine}</a> · {run.author ?? '–'}</span>
        {run.reason && <p class="message">{run.reason}</p>}
      </div>
      <p class="muted">
        {dateTimeText(run.started ?? run.created)} – {run.ended ? dateTimeText(run.ended) : '…'} · {texts().machine.blockCounts(numberText(run.executed), numberText(run.accepted))}
        {run.content_verified !== null && ` · ${run.content_verified ? t.verified : t.notVerified}`}
      </p>
      <p class="muted">
        {run.approval === null ? t.allowedAs[run.allowed_as]
          : <a href={addressOf('programs', [run.program, String(run.revision)])}>{t.allowedBy(run.approval)}</a>}
        {run.setup !== null && ` · ${t.withSetup(run.setup)}`}
      </p>
      <div class="head">
        <span>{texts().machine.report(run.outputs)}</span>
        {run.ended !== null && (
          <button type="button" title={t.attestationHint} onClick={() => void command.send(() => download(pathOf('runs', id, 'attestation'), `${file}.attestation`))}>
            {t.attestation}
          </button>
        )}
        <Exports onExport={(format) => void command.send(() => download(`${pathOf('reports', id)}?format=${format}`, `${file}.${format === 'text' ? 'txt' : format}`))} />
      </div>
      <CommandFault command={command} />
      <RunParts key={id} run={id} />
      <RunOffsets key={`offsets ${id}`} run={id} />
      <Loading of={records} />
      {records.value && <Measured run={id} records={records.value} query={query} />}
      {records.value && <RecordTable key={id} records={records.value} />}
    </>
  );
}
