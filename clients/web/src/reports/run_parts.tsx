// The parts that were measured in a run, with their verdicts.
import { useEffect } from 'preact/hooks';
import type { Parts } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { feed } from '../live/feed';
import { PartTable } from '../measurements/part_list';
import { useLoaded } from '../parts/use_loaded';
import { texts } from '../texts/texts';

const kMax = 200;

/// Nothing where no template reads the run's report.
export function RunParts({ run }: { run: string }) {
  const t = texts().measurements;
  const parts = useLoaded((signal) => get<Parts>(pathOf('parts'), { run, limit: kMax }, signal), [run]);
  useEffect(() => feed.on('parts', parts.reload), []);
  if (!parts.value || parts.value.parts.length === 0) return null;
  return (
    <section class="panel" aria-labelledby="run-parts">
      <h2 id="run-parts">{t.tabs.parts}</h2>
      <PartTable parts={parts.value.parts} label={t.tabs.parts} />
    </section>
  );
}
