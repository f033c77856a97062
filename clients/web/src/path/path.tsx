// The tool path of a program, without running it: #/path/O0100/3?machine=mill-1&line=12. A press on the path chooses its block, a press on
// a block its part of the path.
import { useMemo, useState } from 'preact/hooks';
import type { ProgramWithRevisions, Revision } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { durationText } from '../live/progress';
import { Extents, lengthOf } from '../parts/extents';
import { Loading } from '../parts/loading';
import { Rows } from '../parts/rows';
import { SetupChoice, useMachinesOf } from '../parts/setup_choice';
import { useLoaded } from '../parts/use_loaded';
import { numberText, texts } from '../texts/texts';
import { BlockText } from './block_text';
import { PathCanvas } from './canvas';
import { kMoves } from './polyline';
import { usePath, type LoadedPath } from './use_path';

const kShownTools = 100;

function Facts({ path, onChoose }: { path: LoadedPath; onChoose: (line: number) => void }) {
  const t = texts().path;
  const { end, polyline } = path;
  if (!end) return <p class="muted" role="status">{t.loading(numberText(path.blocks))}</p>;
  const rows: Array<[string, string]> = [
    [t.blockCount, numberText(end.blocks)], [t.time, durationText(end.seconds)], [t.feedLength, lengthOf(end.feed_mm, end.inch)],
    [t.rapidLength, lengthOf(end.rapid_mm, end.inch)], [t.points, numberText(polyline.length)],
  ];
  return (
    <>
      {end.fault && <p class="notice bad" role="alert">{end.fault.line > 0 && <b>{t.faultAt(numberText(end.fault.line))} </b>}{end.fault.id} {end.fault.text}</p>}
      {end.other_axes > 0 && <p class="notice warn">{t.otherAxes(numberText(end.other_axes))}</p>}
      {polyline.tolerance > 0 && <p class="notice">{t.simplified(lengthOf(polyline.tolerance, end.inch))}</p>}
      <Rows of={rows} />
      {Object.keys(end.extents).length > 0 ? <Extents of={end} /> : <p class="notice">{t.nothingMoves}</p>}
      {end.tools.length > 0 && (
        <>
          <h3>{t.tools}</h3>
          <p class="buttons">{end.tools.slice(0, kShownTools).map((tool, i) => <button key={i} type="button" onClick={() => onChoose(tool.line)}>{t.tool(tool.number, numberText(tool.line))}</button>)}</p>
        </>
      )}
    </>
  );
}

function MachineChoice({ revision, machine }: { revision: Revision; machine: string }) {
  const machines = useMachinesOf(revision.control);
  const choose = (name: string) => { location.hash = addressOf('path', [revision.program, String(revision.revision)], { machine: name }); };
  return <SetupChoice class="inline" machines={machines} value={machine} onChoose={choose} />;
}

function Path({ revision, machine, firstLine }: { revision: Revision; machine: string; firstLine: number | null }) {
  const t = texts().path;
  const [chosen, setChosen] = useState<number | null>(firstLine);
  const [showsRapids, setRapids] = useState(true);
  const of = { program: revision.program, revision: revision.revision, size: revision.size };
  const path = usePath({ ...of, machine });
  const { polyline } = path;
  const isComplete = path.end !== null;
  // A line that moves nothing chooses the next one that does.
  const point = useMemo(() => (chosen === null ? -1 : polyline.findLine(chosen)), [chosen, polyline, isComplete]);
  const line = point >= 0 ? polyline.lines[point]! : null;
  const selection = useMemo(() => (line === null ? [] : polyline.runsOf(line)), [line, polyline, polyline.generation, isComplete]);
  const next = (step: 1 | -1) => {
    if (point < 0) return setChosen(polyline.length > 1 ? polyline.lines[1]! : null);
    const runs = selection.find((run) => run.first === point) ?? selection[0]!;
    const to = step === 1 ? runs.last + 1 : runs.first - 1;
    if (to >= 1 && to < polyline.length) setChosen(polyline.lines[to]!);
  };
  return (
    <div class="path-columns" data-complete={isComplete}>
      <section class="panel" aria-label={t.title}>
        <PathCanvas polyline={polyline} version={path.version} isComplete={isComplete} isLathe={path.begin?.lathe ?? false} selection={selection} showsRapids={showsRapids}
          label={t.pathOf(revision.program, revision.revision)} onPick={(picked) => setChosen(polyline.lines[picked]!)} onNext={next} />
        <p class="legend">
          {kMoves.map((move) => <span key={move} class={`key ${move}`}>{t.moves[move]}</span>)}
          <label class="check"><input type="checkbox" checked={showsRapids} onChange={(e) => setRapids(e.currentTarget.checked)} />{t.showRapids}</label>
        </p>
      </section>
      <div>
        <section class="panel" aria-labelledby="block">
          <div class="head">
            <h2 id="block">{line === null ? t.noBlock : t.block(numberText(line))}</h2>
            <span class="path-tools"><button type="button" onClick={() => next(-1)}>{t.previous}</button><button type="button" onClick={() => next(1)}>{t.next}</button></span>
          </div>
          {line !== null && <BlockText of={of} line={line} offset={polyline.offsets[point]!} onChoose={setChosen} />}
        </section>
        <section class="panel" aria-label={t.facts}>
          {path.fault !== null && <p class="notice bad" role="alert">{path.fault}</p>}
          {path.fault === null && <Facts path={path} onChoose={setChosen} />}
        </section>
      </div>
    </div>
  );
}

export default function PathView({ path, query }: { path: string[]; query: URLSearchParams }) {
  const [name = '', number] = path;
  const t = texts().path;
  const program = useLoaded((signal) => get<ProgramWithRevisions>(pathOf('programs', name), {}, signal), [name]);
  const revisions = program.value?.revisions ?? [];
  const revision = revisions.find((row) => String(row.revision) === number) ?? revisions.at(-1);
  const machine = query.get('machine') ?? '';
  const line = Number(query.get('line')) || null;
  return (
    <>
      <div class="machine-head">
        <h1>{t.titleOf(name)}</h1>
        {revision && <a class="button" href={addressOf('programs', [name, String(revision.revision)])}>{texts().programs.revisionNumber(revision.revision)}</a>}
        {revision && <MachineChoice revision={revision} machine={machine} />}
      </div>
      <Loading of={program} />
      {revision && <Path key={`${revision.revision}/${machine}`} revision={revision} machine={machine} firstLine={line} />}
    </>
  );
}
