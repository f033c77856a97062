// Which groups of machines: a check box each.
import type { MachineGroups } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { Loading } from './loading';
import { useLoaded } from './use_loaded';

interface Props {
  legend: string;
  chosen: string[];
  onChange: (chosen: string[]) => void;
}

export function GroupChoice({ legend, chosen, onChange }: Props) {
  const groups = useLoaded((signal) => get<MachineGroups>(pathOf('machine-groups'), {}, signal), []);
  const toggle = (name: string, isChosen: boolean) => onChange(isChosen ? [...chosen, name] : chosen.filter((other) => other !== name));
  return (
    <fieldset class="choice">
      <legend>{legend}</legend>
      <Loading of={groups} />
      {(groups.value?.groups ?? []).map(({ name }) => (
        <label key={name} class="check"><input type="checkbox" checked={chosen.includes(name)} onChange={(e) => toggle(name, e.currentTarget.checked)} />{name}</label>
      ))}
    </fieldset>
  );
}
