// One of the machines, or all.
import { useFeed } from '../live/use_feed';
import { texts } from '../texts/texts';

/// A machine that came with the address is offered, known or not.
export function MachineChoice({ value, onChoose }: { value: string; onChoose: (machine: string) => void }) {
  const names = [...new Set([...useFeed('machines').machines.keys(), ...(value === '' ? [] : [value])])].sort();
  return (
    <label>
      {texts().administration.machine}
      <select value={value} onChange={(e) => onChoose(e.currentTarget.value)}>
        <option value="">{texts().floor.all}</option>
        {names.map((name) => <option key={name} value={name}>{name}</option>)}
      </select>
    </label>
  );
}
