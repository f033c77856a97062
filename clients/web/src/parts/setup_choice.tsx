// On the setup of which machine a program is interpreted.
import { useFeed } from '../live/use_feed';
import { texts } from '../texts/texts';

/// The machines with this control, by name.
export function useMachinesOf(control: string | null): string[] {
  const feed = useFeed('machines');
  return [...feed.machines.values()].filter((row) => row.control === control).map((row) => row.name).sort();
}

interface Props {
  machines: string[];
  /// Empty: no setup.
  value: string;
  class?: string;
  onChoose: (machine: string) => void;
}

export function SetupChoice({ machines, value, onChoose, ...more }: Props) {
  const t = texts().path;
  return (
    <label {...more}>
      {t.setupOf}
      <select value={value} onChange={(e) => onChoose(e.currentTarget.value)}>
        <option value="">{t.noSetup}</option>
        {machines.map((name) => <option key={name} value={name}>{name}</option>)}
      </select>
    </label>
  );
}
