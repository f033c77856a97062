// Two revisions of a program, by text or by motion: #/compare/O0100/3/4?by=motion&machine=mill-1&tolerance=0.01. What is chosen is in the
// address; the server compares.
import type { Comparison, ProgramWithRevisions, Revision } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { useFeed } from '../live/use_feed';
import { useLoaded } from '../parts/use_loaded';
import { Loading } from '../parts/loading';
import { texts } from '../texts/texts';
import { Result } from './result';

const kTolerances = ['0.0001', '0.001', '0.01', '0.1'];
const kDefaultTolerance = '0.001';

interface Chosen {
  program: string;
  from: number;
  to: number;
  by: Comparison['by'];
  machine: string;
  tolerance: string;
}

function show(chosen: Chosen): void {
  const { program, from, to, by, machine, tolerance } = chosen;
  location.hash = addressOf('compare', [program, String(from), String(to)], {
    by, machine: by === 'motion' ? machine : '', tolerance: by === 'motion' && tolerance !== kDefaultTolerance ? tolerance : '',
  });
}

function Choice<T extends string | number>({ label, value, options, onChoose }: { label: string; value: T; options: Array<[T, string]>; onChoose: (value: string) => void }) {
  return (
    <label>
      {label}
      <select value={value} onChange={(e) => onChoose(e.currentTarget.value)}>
        {options.map(([option, text]) => <option key={option} value={option}>{text}</option>)}
      </select>
    </label>
  );
}

function Choices({ chosen, revisions }: { chosen: Chosen; revisions: Revision[] }) {
  const t = texts().compare;
  const feed = useFeed('machines');
  const controls = new Set(revisions.filter((r) => r.revision === chosen.from || r.revision === chosen.to).map((r) => r.control));
  const machines = [...feed.machines.values()].filter((row) => controls.has(row.control)).map((row) => row.name).sort();
  const numbers = revisions.map((r): [number, string] => [r.revision, texts().programs.revisionNumber(r.revision)]);
  return (
    <section class="panel compare-choices" aria-label={t.choices}>
      <Choice label={t.from} value={chosen.from} options={numbers} onChoose={(value) => show({ ...chosen, from: Number(value) })} />
      <Choice label={t.to} value={chosen.to} options={numbers} onChoose={(value) => show({ ...chosen, to: Number(value) })} />
      <Choice label={t.by} value={chosen.by} options={[['text', t.byText], ['normalized', t.byNormalized], ['motion', t.byMotion]]}
        onChoose={(value) => show({ ...chosen, by: value as Comparison['by'] })} />
      {chosen.by === 'motion' && (
        <>
          <Choice label={t.setupOf} value={chosen.machine} options={[['', t.noSetup], ...machines.map((name): [string, string] => [name, name])]}
            onChoose={(machine) => show({ ...chosen, machine })} />
          <Choice label={t.tolerance} value={chosen.tolerance} options={kTolerances.map((value): [string, string] => [value, `${value} mm`])}
            onChoose={(tolerance) => show({ ...chosen, tolerance })} />
        </>
      )}
    </section>
  );
}

function Compared({ chosen, from, to }: { chosen: Chosen; from: Revision; to: Revision }) {
  const query = {
    revision: from.revision, other_revision: to.revision, by: chosen.by, ...(chosen.by === 'motion' && { machine: chosen.machine, tolerance: chosen.tolerance }),
  };
  const compared = useLoaded((signal) => get<Comparison>(pathOf('programs', chosen.program, 'comparison'), query, signal), [JSON.stringify(query)]);
  if (compared.fault !== null) return <Loading of={compared} />;
  if (compared.value === null) return <p class="muted" role="status">{texts().compare.compares}</p>;
  return <Result result={compared.value} from={from} to={to} />;
}

export default function CompareView({ path, query }: { path: string[]; query: URLSearchParams }) {
  const [name = '', first, second] = path;
  const t = texts().compare;
  const program = useLoaded((signal) => get<ProgramWithRevisions>(pathOf('programs', name), {}, signal), [name]);
  const revisions = [...(program.value?.revisions ?? [])].sort((a, b) => b.revision - a.revision);
  const to = revisions.find((r) => String(r.revision) === second) ?? revisions[0];
  const from = revisions.find((r) => String(r.revision) === first) ?? revisions[1] ?? to;
  const wanted = query.get('by');
  const chosen: Chosen | undefined = from && to && {
    program: name, from: from.revision, to: to.revision, by: wanted === 'normalized' || wanted === 'motion' ? wanted : 'text',
    machine: query.get('machine') ?? '', tolerance: kTolerances.find((value) => value === query.get('tolerance')) ?? kDefaultTolerance,
  };
  return (
    <>
      <div class="machine-head">
        <h1>{t.titleOf(name)}</h1>
        {to && <a class="button" href={addressOf('programs', [name, String(to.revision)])}>{texts().programs.revisionNumber(to.revision)}</a>}
      </div>
      <Loading of={program} />
      {chosen && <Choices chosen={chosen} revisions={revisions} />}
      {revisions.length === 1 && <p class="notice">{t.oneRevision}</p>}
      {chosen && from && to && <Compared key={JSON.stringify(chosen)} chosen={chosen} from={from} to={to} />}
    </>
  );
}
