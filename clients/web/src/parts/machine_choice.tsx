// One of the machines, or all.
import { useFeed } from '../live/use_feed';
import { texts } from '../texts/texts';

interface Props {
  /// Usually "Machine", and of no choice "All".
  label?: string;
  value: string;
  onChoose: (machine: string) => void;
}

/// A machine that came with the address is offered, known or not.
export function MachineChoice({ label, value, onChoose }: Props) {
  const names = [...new Set([...useFeed('machines').machines.keys(), ...(value === '' ? [] : [value])])].sort();
  return (
    <label>
      {label ?? texts().administration.machine}
      <select value={value} onChange={(e) => onChoose(e.currentTarget.value)}>
        <option value="">{label === undefined ? texts().floor.all : '–'}</option>
        {names.map((name) => <option key={name} value={name}>{name}</option>)}
      </select>
    </label>
  );
}
