// What the programs of the list are for: each value exactly, those of other programs are offered.
import type { MachineGroups, Program } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { feed } from '../live/feed';
import { Disclosure } from '../parts/disclosure';
import { useLoaded } from '../parts/use_loaded';
import { texts } from '../texts/texts';
import type { Filter, Filters } from './search';

const kStates: Array<Program['state']> = ['draft', 'in_review', 'approved', 'released', 'withdrawn'];
const kTyped = ['part', 'operation', 'material'] as const;

interface Props {
  filters: Filters;
  /// Programs that are shown: their values are offered.
  shown: Program[];
  onFilter: (filter: Filter, value: string) => void;
}

/// A value that came with the address is kept, whatever is offered.
function Choice({ label, value, options, onChange }: { label: string; value: string; options: Array<[string, string]>; onChange: (value: string) => void }) {
  const all = value === '' || options.some(([key]) => key === value) ? options : [...options, [value, value] as [string, string]];
  return (
    <label>
      {label}
      <select value={value} onChange={(e) => onChange(e.currentTarget.value)}>
        <option value="">{texts().floor.all}</option>
        {all.map(([key, name]) => <option key={key} value={key}>{name}</option>)}
      </select>
    </label>
  );
}

function FilterFields({ filters, shown, onFilter }: Props) {
  const t = texts().library;
  const groups = useLoaded((signal) => get<MachineGroups>(pathOf('machine-groups'), {}, signal), []);
  const controls = [...new Set([...shown, ...feed.machines.values()].map((known) => known.control).filter((c) => c !== null))].sort();
  return (
    <div class="panel filter-grid">
      {kTyped.map((field) => (
        <div key={field}>
          <label>{t.fields[field]}<input list={`known-${field}`} autocomplete="off" value={filters[field]} onChange={(e) => onFilter(field, e.currentTarget.value.trim())} /></label>
          <datalist id={`known-${field}`}>{[...new Set(shown.map((p) => p[field]).filter((value) => value !== null))].map((value) => <option key={value} value={value} />)}</datalist>
        </div>
      ))}
      <Choice label={t.fields.machine_group} value={filters.machine_group} options={(groups.value?.groups ?? []).map(({ name }) => [name, name])} onChange={(value) => onFilter('machine_group', value)} />
      <Choice label={texts().programs.control} value={filters.control} options={controls.map((name) => [name, name])} onChange={(value) => onFilter('control', value)} />
      <Choice label={texts().programs.state} value={filters.state} options={kStates.map((state) => [state, texts().release.states[state]])} onChange={(value) => onFilter('state', value)} />
    </div>
  );
}

export function ProgramFilters(props: Props) {
  const t = texts().library;
  const count = Object.values(props.filters).filter((value) => value !== '').length;
  return (
    <Disclosure class="filters" summary={count === 0 ? t.filters : t.filtersSet(count)} isOpen={count > 0}><FilterFields {...props} /></Disclosure>
  );
}
