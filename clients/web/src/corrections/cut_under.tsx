// The parts that were cut under one value of a tool or an offset, run by run, the latest first.
import { useState } from 'preact/hooks';
import type { Part, Parts } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { PartTable } from '../measurements/part_list';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, numberText, texts } from '../texts/texts';
import { latestRuns, valueText, type PastValue } from './steps';

/// A request each.
const kRunsAtOnce = 10;
const kMaxPartsOfRun = 200;

async function loadParts(runs: string[], signal: AbortSignal): Promise<Part[]> {
  const answers = await Promise.all(runs.map((run) => get<Parts>(pathOf('parts'), { run, limit: kMaxPartsOfRun }, signal)));
  return answers.flatMap(({ parts }) => parts).sort((a, b) => b.id - a.id);
}

export function CutUnder({ past, onClose }: { past: PastValue; onClose: () => void }) {
  const t = texts().corrections;
  const [count, setCount] = useState(kRunsAtOnce);
  const runs = latestRuns(past.runs, count);
  const parts = useLoaded((signal) => loadParts(runs, signal), [runs.join(' ')]);
  const name = t.cutUnder(past.target, valueText(past.value, past.unit), dateTimeText(past.time));
  return (
    <section class="panel" aria-labelledby="cut-under">
      <div class="head"><h2 id="cut-under">{name}</h2><button type="button" onClick={onClose}>{t.close}</button></div>
      {past.archived > 0 && <p class="notice">{t.inArchives(numberText(past.archived), past.archives.join(', '))}</p>}
      {past.uncounted.length > 0 && <p class="notice warn">{t.uncounted(past.uncounted.join(', '))}</p>}
      <Loading of={parts} />
      {parts.value?.length === 0 && <p class="muted">{t.nothingMeasured}</p>}
      {parts.value && parts.value.length > 0 && <PartTable parts={parts.value} label={texts().measurements.tabs.parts} />}
      {count < past.runs.length && (
        <p class="buttons"><span>{t.ofRuns(runs.length, past.runs.length)}</span><button type="button" onClick={() => setCount(count + kRunsAtOnce)}>{texts().library.more}</button></p>
      )}
    </section>
  );
}
