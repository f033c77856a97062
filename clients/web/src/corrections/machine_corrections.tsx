// Every value that a tool or an offset of a machine had, newest first: why, who, and what was cut under it; and the rules by which corrections are proposed.
import { useState } from 'preact/hooks';
import type { OffsetHistory } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { useFeed } from '../live/use_feed';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, numberText, texts } from '../texts/texts';
import { CutUnder } from './cut_under';
import { Rules } from './rules';
import { changeOf, stepLine, targetsOf, valueText, type PastValue } from './steps';

const kPage = 200;
const kRunsShown = 6;
const kBox = { width: 600, height: 120 };

/// A shape of the values; the table has their numbers.
function Steps({ values }: { values: PastValue[] }) {
  const line = stepLine(values.map(({ value }) => value), kBox);
  if (!line) return null;
  const { unit } = values[0]!;
  return (
    <figure class="steps" aria-hidden="true">
      <span>{valueText(line.highest, unit)}</span>
      <svg viewBox={`0 -4 ${kBox.width} ${kBox.height + 8}`} preserveAspectRatio="none"><polyline points={line.points} /></svg>
      <span>{valueText(line.lowest, unit)}</span>
    </figure>
  );
}

function Runs({ runs }: { runs: string[] }) {
  const t = texts().corrections;
  const [isWhole, setWhole] = useState(false);
  const shown = isWhole ? runs : runs.slice(0, kRunsShown);
  if (runs.length === 0) return <>{t.noRuns}</>;
  return (
    <span class="runs">
      {shown.map((run) => <a key={run} href={addressOf('reports', [run])}>{run.slice(0, 8)}</a>)}
      {shown.length < runs.length && <button type="button" class="quiet" onClick={() => setWhole(true)}>{t.moreRuns(runs.length - shown.length)}</button>}
    </span>
  );
}

function HistoryTable({ history }: { history: PastValue[] }) {
  const t = texts().corrections;
  const [shown, setShown] = useState<PastValue | null>(null);
  const heads: Array<[string, boolean]> = [[t.target, false], [t.value, true], [t.change, true], [t.since, false], [t.who, false], [t.why, false], [t.parts, false], [texts().machine.runs, false]];
  return (
    <>
      <div class="scroll" tabIndex={0} role="region" aria-label={t.history}>
        <table class="data">
          <thead><tr>{heads.map(([name, isNumber]) => <th scope="col" key={name} class={isNumber ? 'number' : ''}>{name}</th>)}</tr></thead>
          <tbody>
            {history.map((past, i) => {
              const change = changeOf(history, i);
              return (
                <tr key={`${past.target} ${past.setup}`}>
                  <th scope="row" class="nowrap">{past.target}</th>
                  <td class="number"><b>{valueText(past.value, past.unit)}</b></td>
                  <td class="number">{change === null ? '–' : valueText(change, past.unit, true)}</td>
                  <td>{dateTimeText(past.time)} <span class="muted nowrap">{t.setup(past.setup)}</span></td>
                  <td>{past.who ?? '–'}</td>
                  <td class="record-text">{past.why ?? '–'}</td>
                  <td class="nowrap">
                    {past.parts === 0 ? '–' : (
                      <button type="button" aria-pressed={shown === past} onClick={() => setShown(shown === past ? null : past)}>{t.goodOf(numberText(past.good), numberText(past.parts))}</button>
                    )}
                    {past.archived > 0 && <span class="muted" title={past.archives.join(', ')}> {t.archived(numberText(past.archived))}</span>}
                  </td>
                  <td><Runs runs={past.runs} /></td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
      {shown && <CutUnder key={`${shown.target} ${shown.setup}`} past={shown} onClose={() => setShown(null)} />}
    </>
  );
}

type AtMachineChange = OffsetHistory['at_machine'][number];

/// With the digits of the control's screen; an older gateway gives no unit.
export function setText(value: number, unit: AtMachineChange['unit']): string {
  return unit === null ? numberText(value, 4) : `${numberText(value, unit === 'in' ? 4 : 3)}\u00a0${unit === 'deg' ? '°' : unit}`;
}

export function atMachineText(change: AtMachineChange): string {
  return change.cells
    .map((cell) => `${cell.name}: ${cell.before === null ? '–' : setText(cell.before, change.unit)} → ${setText(cell.value, change.unit)}`)
    .join(', ');
}

/// In the control's memory, and in no setup.
function AtMachine({ changes }: { changes: OffsetHistory['at_machine'] }) {
  const t = texts().corrections;
  return (
    <section aria-labelledby="at-machine">
      <h2 id="at-machine">{t.atMachine}</h2>
      <div class="scroll" tabIndex={0} role="group" aria-labelledby="at-machine">
        <table class="data">
          <thead><tr>{[t.target, t.change, t.since, t.who, t.setAs].map((name) => <th scope="col" key={name}>{name}</th>)}</tr></thead>
          <tbody>
            {changes.map((one) => (
              <tr key={one.change}>
                <th scope="row" class="nowrap">{one.target}</th>
                <td>{atMachineText(one)}{one.length !== null && one.length !== 0 && `; ${t.lengthInForce(setText(one.length, one.unit))}`}</td>
                <td>{dateTimeText(one.time)}</td>
                <td>{one.who ?? '–'}</td>
                <td>{one.what}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

export function MachineCorrections({ machine, target }: { machine: string; target: string }) {
  const t = texts().corrections;
  const { offsets: pending } = useFeed('offsets');
  const [known, setKnown] = useState<string[]>([]);
  const history = useLoaded(async (signal) => {
    const found = await get<OffsetHistory>(pathOf('machines', machine, 'offset-history'), { target, limit: kPage }, signal);
    setKnown((before) => [...new Set([...before, ...targetsOf(found.history)])].sort());
    return found;
  }, [machine, target, [...pending.keys()].join(' ')]);
  const list = history.value?.history ?? [];
  return (
    <>
      <p class="back"><a href={addressOf('corrections')}>← {texts().measurements.tabs.corrections}</a></p>
      <div class="machine-head"><h1>{t.historyOf(machine)}</h1><a href={addressOf('machine', [machine, 'setup'])}>{texts().machine.tabs.setup}</a></div>
      <div class="tools choices">
        <label>
          {t.target}
          <input list="targets" autocomplete="off" placeholder="T3, T3.wear.X, G54" value={target} onChange={(e) => location.replace(addressOf('corrections', [machine], { target: e.currentTarget.value.trim() }))} />
        </label>
        <datalist id="targets">{known.map((name) => <option key={name} value={name} />)}</datalist>
      </div>
      <Loading of={history} />
      {history.value && list.length === 0 && <p class="notice">{t.noHistory}</p>}
      {targetsOf(list).length === 1 && <Steps values={list} />}
      {list.length > 0 && <HistoryTable key={target} history={list} />}
      {history.value && history.value.at_machine.length > 0 && <AtMachine changes={history.value.at_machine} />}
      <Rules machine={machine} />
    </>
  );
}
