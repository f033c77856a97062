// One program: its revisions, the text of the chosen one, what it is for, attachments, what it calls, approval, the start on a machine, comparison.
import { useEffect, useMemo, useState } from 'preact/hooks';
import type { ProgramCheck, ProgramWithRevisions, Revision } from '../../generated/api';
import { get, pathOf, withQuery } from '../api/request';
import { addressOf } from '../app/route';
import { Decide } from '../imports/decide';
import { CommandFault, useCommand } from '../parts/command';
import { Loading } from '../parts/loading';
import { RevisionPill } from '../parts/revision_pill';
import { useKept } from '../parts/use_kept';
import { useLoaded } from '../parts/use_loaded';
import { usePolicy } from '../parts/use_policy';
import { bytesText, dateTimeText, texts } from '../texts/texts';
import { About } from './about';
import { Attachments } from './attachments';
import { kNoChoice, type ClosureChoice } from './calls';
import { Check } from './check';
import { Closure, useClosure } from './closure';
import { Compare } from './compare';
import { download } from './download';
import { findingsByLine } from './findings';
import { Manage } from './manage';
import type { Place } from './pieces';
import { ReleaseState } from './release';
import { StartOn } from './start_on';
import { TextView } from './text_view';

/// A revision that a machine has sent runs nowhere before it is accepted.
function Pending({ revision, onDecided }: { revision: Revision; onDecided: () => void }) {
  const t = texts().programs;
  return (
    <div class="notice warn">
      <p>{t.isPending} <a href={addressOf('imports', [revision.program, String(revision.revision)])}>{t.whatItChanges}</a></p>
      <Decide import_={revision} onDecided={onDecided} />
    </div>
  );
}

function RevisionList({ revisions, shown }: { revisions: Revision[]; shown: Revision }) {
  const t = texts().programs;
  return (
    <section class="panel" aria-labelledby="revisions">
      <h2 id="revisions">{t.revisions}</h2>
      <ul class="list">
        {revisions.map((r) => (
          <li key={r.revision}>
            <a class="target" href={addressOf('programs', [r.program, String(r.revision)])} aria-current={r === shown ? 'true' : undefined}>{t.revisionNumber(r.revision)}</a>
            <RevisionPill revision={r} />
            <p class="muted">{dateTimeText(r.created)} · {r.author ?? '–'} · {bytesText(r.size)}{r.comment && ` · ${r.comment}`}</p>
          </li>
        ))}
      </ul>
    </section>
  );
}

/// `line` is gone to: a search found it there.
export function ProgramPage({ name, number, line }: { name: string; number: number | null; line: number | null }) {
  const t = texts().programs;
  const program = useLoaded((signal) => get<ProgramWithRevisions>(pathOf('programs', name), {}, signal), [name]);
  const policy = usePolicy();
  const command = useCommand();
  const [check, setCheck] = useState<ProgramCheck | null>(null);
  const [goTo, setGoTo] = useState<Place | null>(null);
  const findings = useMemo(() => findingsByLine(check), [check]);
  // A search reads the first 256 KiB: the line is in the first piece.
  useEffect(() => setGoTo(line === null ? null : { offset: 0, line }), [name, number, line]);
  const [choice, setChoice] = useKept<ClosureChoice>(JSON.stringify([name, number]), kNoChoice);
  const revisions = [...(program.value?.revisions ?? [])].sort((a, b) => b.revision - a.revision);
  const shown = revisions.find((r) => r.revision === number) ?? revisions.find((r) => !r.held) ?? revisions[0];
  const { value } = program;
  const closure = useClosure(shown, choice, value);
  if (!value || !shown) return <><h1>{name}</h1><Loading of={program} /></>;
  const path = withQuery(pathOf('programs', name, 'content'), { revision: shown.revision });
  return (
    <>
      <div class="machine-head">
        <h1>{name}</h1>
        <span class="muted">{[shown.title, shown.control, t.revisionNumber(shown.revision), bytesText(shown.size)].filter(Boolean).join(' · ')}</span>
      </div>
      {shown.held && <Pending key={shown.revision} revision={shown} onDecided={program.reload} />}
      <div class="program-columns">
        <div>
          <TextView program={name} revision={shown.revision} size={shown.size} findings={findings} goTo={goTo} />
          {shown.control !== null && <Closure revision={shown} closure={closure} choice={choice} onChoose={setChoice} />}
          <Attachments key={shown.revision} shown={shown} />
          <Compare key={shown.revision} revisions={revisions} to={shown} />
        </div>
        <div>
          {shown.control !== null && <Check key={shown.revision} revision={shown} onChecked={setCheck} onGoTo={setGoTo} />}
          <About key={shown.revision} program={value} shown={shown} onStored={program.reload} />
          <section class="panel"><StartOn revision={shown} policy={policy.value} /></section>
          {!shown.held && <ReleaseState policy={policy} revision={shown} revisions={revisions} closure={closure.value} choice={choice} onDecided={program.reload} />}
          <RevisionList revisions={revisions} shown={shown} />
          <section class="panel">
            <p class="buttons">
              {shown.control !== null && <a class="button" href={addressOf('path', [name, String(shown.revision)])}>{t.path}</a>}
              <button type="button" onClick={() => void command.send(() => download(path, name))}>{t.download}</button>
            </p>
            <CommandFault command={command} />
            <Manage program={value} />
            <p class="hint mono">{t.digest} {shown.sha256}</p>
          </section>
        </div>
      </div>
    </>
  );
}
