// One revision that a machine has sent: what it changes against the released one, by motion on that machine's setup, and the decision.
import type { ComparedImport, ProgramWithRevisions } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { Result } from '../compare/result';
import { importKey } from '../live/feed';
import { useFeed } from '../live/use_feed';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { bytesText, dateTimeText, texts } from '../texts/texts';
import { ClassPill } from './class_pill';
import { Decide } from './decide';
import { decisionText } from './import_list';

interface Shown {
  import_: ComparedImport;
  /// Of the revision that it was compared with.
  baseSize: number;
}

/// A program that was removed since has no revisions any more: its text is in the comparison.
async function load(program: string, revision: number, signal: AbortSignal): Promise<Shown> {
  const [import_, revisions] = await Promise.all([
    get<ComparedImport>(pathOf('imports', program, revision), {}, signal),
    get<ProgramWithRevisions>(pathOf('programs', program), {}, signal).then((found) => found.revisions, () => []),
  ]);
  return { import_, baseSize: revisions.find((row) => row.revision === import_.compared_with)?.size ?? 0 };
}

function Difference({ shown }: { shown: Shown }) {
  const { import_, baseSize } = shown;
  const { program, comparison, compared_with: base } = import_;
  if (!comparison || base === null) return null;
  return <Result result={comparison} from={{ program, revision: base, size: baseSize }} to={{ program, revision: import_.revision, size: import_.size }} />;
}

export function ImportPage({ program, revision }: { program: string; revision: number }) {
  const t = texts().imports;
  const feed = useFeed('imports');
  // Compared, or decided by another user: both are events.
  const live = feed.imports.get(importKey({ program, revision }));
  const loaded = useLoaded((signal) => load(program, revision, signal), [program, revision, live?.state, live?.compared]);
  const head = <h1>{program} <span class="muted">{texts().programs.revisionNumber(revision)}</span></h1>;
  if (!loaded.value) return <>{head}{loaded.fault === null ? <p class="muted" role="status">{t.compares}</p> : <Loading of={loaded} />}</>;
  const { import_ } = loaded.value;
  return (
    <>
      <div class="machine-head">
        {head}
        <ClassPill import_={import_} />
        <span class="muted">{[t.fromMachine(import_.machine, dateTimeText(import_.received)), import_.control, bytesText(import_.size)].filter(Boolean).join(' · ')}</span>
        <a class="button" href={addressOf('programs', [program])}>{t.program}</a>
      </div>
      {import_.comment !== null && <p>{import_.comment}</p>}
      {import_.fault !== null && <p class="notice warn">{t.why(import_.fault)}</p>}
      {import_.comparison_fault !== null && <p class="notice warn">{import_.comparison ? t.byText(import_.comparison_fault) : import_.comparison_fault}</p>}
      <section class="panel" aria-labelledby="decide">
        <h2 id="decide">{import_.state === 'pending' ? t.decide : t.decision}</h2>
        {import_.state === 'pending' && <Decide import_={import_} onDecided={loaded.reload} />}
        {import_.state !== 'pending' && (
          <p><b>{decisionText(import_)}</b> <span class="muted">{import_.decided && t.decidedBy(import_.who ?? '–', dateTimeText(import_.decided))}</span></p>
        )}
        {import_.reason !== null && <p class="record-text">{import_.reason}</p>}
      </section>
      <Difference shown={loaded.value} />
    </>
  );
}
