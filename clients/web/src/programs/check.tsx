// What is wrong with a revision on the setup of a machine, without running it: the server interprets it. A press on a finding goes to its line.
import { useEffect, useState } from 'preact/hooks';
import type { ProgramCheck, ProgramDiagnostic, Revision } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { durationText } from '../live/progress';
import { useFeed } from '../live/use_feed';
import { Extents, lengthOf } from '../parts/extents';
import { Loading } from '../parts/loading';
import { Rows } from '../parts/rows';
import { SetupChoice, useMachinesOf } from '../parts/setup_choice';
import { useLoaded } from '../parts/use_loaded';
import { numberText, texts } from '../texts/texts';
import { sortFindings } from './findings';
import type { Place } from './pieces';

/// Checked without being asked for: some tenths of a second.
const kMaxAtOnce = 2 * 1024 * 1024;
const kShown = 200;

function Finding({ found, onGoTo }: { found: ProgramDiagnostic; onGoTo: (place: Place) => void }) {
  const t = texts().check;
  const place = found.column > 0 ? t.column(numberText(found.line), numberText(found.column)) : t.line(numberText(found.line));
  const what = (
    <>
      <span class={`pill ${found.severity === 'alarm' ? 'alarm' : 'waiting'}`}>{t.severities[found.severity]}</span> <b>{found.program !== null && `${found.program}, `}{place}</b>
      <span class="what">{found.id}: {found.text}{found.times > 1 && ` (${t.times(numberText(found.times))})`}</span>
    </>
  );
  if (found.program !== null) return <li><a class="button found" href={addressOf('programs', [found.program])}>{what}</a></li>;
  return <li><button type="button" class="found" onClick={() => onGoTo({ offset: found.offset, line: found.line })}>{what}</button></li>;
}

function Verdict({ check }: { check: ProgramCheck }) {
  const t = texts().check;
  const isGood = check.outcome === 'ended';
  const text = check.outcome === 'fault' ? t.faulted(check.fault ?? '') : t.outcomes[check.outcome];
  return <p class={`notice ${isGood ? '' : check.outcome === 'alarm' ? 'bad' : 'warn'}`} role="status"><b>{text}</b> {t.warnings(check.warnings)}</p>;
}

function Figures({ check }: { check: ProgramCheck }) {
  const t = texts().path;
  const rows: Array<[string, string]> = [
    [t.time, durationText(check.seconds)], [t.blockCount, numberText(check.blocks)], [t.feedLength, lengthOf(check.feed_mm, check.inch)],
    [t.rapidLength, lengthOf(check.rapid_mm, check.inch)],
  ];
  return (
    <>
      <Rows of={rows} />
      {Object.keys(check.extents).length > 0 && <Extents of={check} />}
    </>
  );
}

interface Props {
  revision: Revision;
  onChecked: (check: ProgramCheck | null) => void;
  onGoTo: (place: Place) => void;
}

export function Check({ revision, onChecked, onGoTo }: Props) {
  const t = texts().check;
  const machines = useMachinesOf(revision.control);
  const only = machines.length === 1 ? machines[0]! : '';
  const [chosen, setChosen] = useState<string | null>(null);
  const [isAsked, setAsked] = useState(revision.size <= kMaxAtOnce);
  const machine = chosen ?? only;
  // Which machine is the only one is known with the list: before it the server would interpret the program without a setup, and then again.
  const isReady = useFeed('link').link.state !== 'connecting' && isAsked;
  const check = useLoaded(async (signal) => {
    if (!isReady) return null;
    const found = await get<ProgramCheck>(pathOf('programs', revision.program, 'check'), { revision: revision.revision, machine }, signal);
    return { found, machine };
  }, [revision.program, revision.revision, machine, isReady]);
  // What is on its way is not of the machine that is shown.
  const found = check.value && check.value.machine === machine ? check.value.found : null;
  useEffect(() => onChecked(found), [found]);
  useEffect(() => () => onChecked(null), []);
  return (
    <section class="panel" aria-labelledby="check">
      <h2 id="check">{t.title}</h2>
      <SetupChoice machines={machines} value={machine} onChoose={setChosen} />
      {!isAsked && <p class="buttons"><button type="button" onClick={() => setAsked(true)}>{t.start}</button></p>}
      {isAsked && !found && check.fault === null && <p class="muted" role="status">{t.checks}</p>}
      {check.fault !== null && <><Loading of={check} /><p class="buttons"><button type="button" onClick={check.reload}>{t.again}</button></p></>}
      {found && <Verdict check={found} />}
      {found && found.diagnostics.length > 0 && (
        <ul class="list found-list" aria-label={t.findings}>
          {sortFindings(found.diagnostics).slice(0, kShown).map((row, i) => <Finding key={i} found={row} onGoTo={onGoTo} />)}
        </ul>
      )}
      {found && (!found.complete || found.diagnostics.length > kShown) && <p class="muted">{t.more}</p>}
      {found && <Figures check={found} />}
    </section>
  );
}
