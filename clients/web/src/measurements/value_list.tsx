// What was measured, by characteristic, machine and time: the chart and the studies of one characteristic, the values, and their export.
import { useEffect } from 'preact/hooks';
import type { Characteristics, Measurement, Measurements } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { feed } from '../live/feed';
import { CommandFault, useCommand } from '../parts/command';
import { Loading } from '../parts/loading';
import { MachineChoice } from '../parts/machine_choice';
import { useKept } from '../parts/use_kept';
import { useLoaded } from '../parts/use_loaded';
import { kVerdicts } from '../parts/verdict_pill';
import { texts } from '../texts/texts';
import { Capability } from './capability';
import { ChartPicture } from './chart_picture';
import { MeasurementExports } from './exports';
import { Gauge } from './gauge';
import { choicesOf, filterOf, kKinds, kRules, type Choice, type Choices } from './tolerance';
import { ValueTable } from './value_table';

const kPage = 100;

interface ChoiceProps {
  choices: Choices;
  choose: (changed: Partial<Choices>) => void;
}

function Which({ choices, choose }: ChoiceProps) {
  const t = texts().measurements;
  const known = useLoaded((signal) => get<Characteristics>(pathOf('characteristics'), { machine: choices.machine }, signal), [choices.machine]);
  useEffect(() => feed.on('parts', known.reload), []);
  const names = [...new Set([...(known.value?.characteristics ?? []), ...(choices.characteristic === '' ? [] : [choices.characteristic])])].sort();
  const time = (choice: 'since' | 'until') => (
    <label>{t[choice]}<input type="datetime-local" value={choices[choice]} onChange={(e) => choose({ [choice]: e.currentTarget.value })} /></label>
  );
  return (
    <div class="tools choices">
      <label>
        {t.characteristic}
        <select value={choices.characteristic} onChange={(e) => choose({ characteristic: e.currentTarget.value })}>
          <option value="">{texts().floor.all}</option>
          {names.map((name) => <option key={name} value={name}>{name}</option>)}
        </select>
      </label>
      <MachineChoice value={choices.machine} onChoose={(machine) => choose({ machine })} />
      {time('since')}{time('until')}
      <label>
        {t.verdict}
        <select value={choices.verdict} onChange={(e) => choose({ verdict: e.currentTarget.value })}>
          <option value="">{texts().floor.all}</option>
          {kVerdicts.map((verdict) => <option key={verdict} value={verdict}>{t.verdicts[verdict]}</option>)}
        </select>
      </label>
      {(['run', 'part'] as const).map((only) => choices[only] !== '' && (
        <button key={only} type="button" onClick={() => choose({ [only]: '' })}>{only === 'run' ? t.onlyRun(choices.run.slice(0, 8)) : t.partNumber(Number(choices.part))} ×</button>
      ))}
    </div>
  );
}

function How({ choices, choose }: ChoiceProps) {
  const t = texts().measurements;
  const kind = choices.kind || 'individuals';
  const select = <K extends string>(label: string, choice: Choice, value: string, options: Record<K, string>, keys: readonly K[]) => (
    <label>{label}<select value={value} onChange={(e) => choose({ [choice]: e.currentTarget.value })}>{keys.map((key) => <option key={key} value={key}>{options[key]}</option>)}</select></label>
  );
  return (
    <div class="tools choices">
      {select(t.kind, 'kind', kind, t.kinds, kKinds)}
      {kind !== 'histogram' && kind !== 'trend' && select(t.rules, 'rules', choices.rules || 'limits', t.ruleNames, kRules)}
      {kind.startsWith('xbar') && <label>{t.subgroup}<input type="number" min={2} max={100} step={1} value={choices.subgroup || '5'} onChange={(e) => choose({ subgroup: e.currentTarget.value })} /></label>}
    </div>
  );
}

/// The newest first; more of them are older ones.
function useValues(choices: Choices) {
  const filter = filterOf(choices);
  const load = (after: string, signal: AbortSignal) => get<Measurements>(pathOf('measurements'), { ...filter, order: 'newest', after, limit: kPage }, signal);
  const first = useLoaded((signal) => load('', signal), Object.values(filter));
  useEffect(() => feed.on('parts', first.reload), []);
  const [more, setMore] = useKept<{ values: Measurement[]; next: string | null } | null>(JSON.stringify(filter), null);
  const next = more ? more.next : (first.value?.next ?? null);
  const loading = useCommand();
  const byId = new Map([...(first.value?.measurements ?? []), ...(more?.values ?? [])].map((one) => [one.id, one]));
  const loadMore = () => loading.send(async () => {
    const page = await load(next ?? '', new AbortController().signal);
    // All that is shown is kept: newer values push the last ones out of the first page.
    setMore({ values: [...byId.values(), ...page.measurements], next: page.next });
  });
  return { first, values: [...byId.values()], hasMore: next !== null, loading, loadMore };
}

export function ValueList({ query }: { query: URLSearchParams }) {
  const t = texts().measurements;
  const choices = choicesOf(query);
  const choose = (changed: Partial<Choices>) => location.replace(addressOf('measurements', [], { ...choices, ...changed }));
  const { first, values, hasMore, loading, loadMore } = useValues(choices);
  const hasFilter = Object.values(filterOf(choices)).some((value) => value !== '');
  return (
    <>
      <Which choices={choices} choose={choose} />
      {choices.characteristic === '' ? values.length > 0 && <p class="hint">{t.chooseForChart}</p> : <How choices={choices} choose={choose} />}
      {choices.characteristic !== '' && <><ChartPicture choices={choices} /><Capability choices={choices} choose={choose} /><Gauge key={JSON.stringify(filterOf(choices))} choices={choices} /></>}
      <Loading of={first} />
      {first.value && values.length === 0 && <p class="notice">{hasFilter ? t.noneFits : t.noneMeasured}</p>}
      {values.length > 0 && (
        <>
          <div class="head values-head">
            <span class="muted" role="status">{hasMore ? t.newest(values.length) : t.valueCount(values.length)}</span>
            <MeasurementExports query={filterOf(choices)} name={choices.characteristic || t.fileName} command={loading} />
          </div>
          <ValueTable values={values} label={t.tabs.values} />
        </>
      )}
      {hasMore && <p class="buttons"><button type="button" disabled={loading.isBusy} onClick={() => void loadMore()}>{texts().library.more}</button></p>}
      <CommandFault command={loading} />
    </>
  );
}
