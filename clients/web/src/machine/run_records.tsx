// What the run has reported: printed lines, probing results, messages, alarms. The newest first; the rest is in its report.
import { useEffect, useState } from 'preact/hooks';
import type { Record as ReportRecord, Records } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { feed } from '../live/feed';
import { recordText } from '../live/record_text';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { texts, timeText } from '../texts/texts';

const kShown = 60;
const kLoaded = 1000;

/// Each once, in their order: what was loaded and what has come since may overlap.
export function mergeRecords(loaded: ReportRecord[], live: ReportRecord[]): ReportRecord[] {
  const byNumber = new Map([...loaded, ...live].map((record) => [`${record.epoch}/${record.number}`, record]));
  return [...byNumber.values()].sort((a, b) => a.epoch - b.epoch || a.number - b.number);
}

function useRecords(run: string) {
  const [live, setLive] = useState<ReportRecord[]>([]);
  const loaded = useLoaded((signal) => get<Records>(pathOf('runs', run, 'records'), { limit: kLoaded }, signal), [run]);
  useEffect(() => {
    setLive([]);
    return feed.onRecord((record) => {
      if (record.run === run) setLive((before) => [...before.slice(-kShown), record]);
    });
  }, [run]);
  return { loaded, records: mergeRecords(loaded.value?.records ?? [], live).slice(-kShown).reverse() };
}

export function RunRecords({ run }: { run: string }) {
  const t = texts().machine;
  const { loaded, records } = useRecords(run);
  return (
    <section class="panel live" aria-labelledby="records">
      <h2 id="records">{t.records}</h2>
      <Loading of={loaded} />
      {loaded.value && records.length === 0 && <p class="muted">{t.noRecords}</p>}
      <ol class="records" tabIndex={0} aria-labelledby="records">
        {records.map((record) => (
          <li key={`${record.epoch}/${record.number}`} class={record.kind}>
            <time dateTime={record.time}>{timeText(record.time)}</time>
            <span class="kind">{t.kinds[record.kind]}</span>
            <span class="text mono">{recordText(record)}</span>
          </li>
        ))}
      </ol>
      <p><a href={addressOf('reports', [run])}>{t.wholeReport}</a></p>
    </section>
  );
}
