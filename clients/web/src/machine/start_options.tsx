// What has to be decided for a start in the middle of a program: on a serial line about the words that are skipped, at a gateway about its control's
// memory and the pass of a loop, where the control has these.
import type { Machine } from '../../generated/api';
import { texts } from '../texts/texts';
import type { StartOptions } from './commands';

const kMaxPass = 1_000_000;

interface Props {
  starts: Machine['starts'];
  options: StartOptions;
  onChange: (options: StartOptions) => void;
}

function Choice<K extends string>({ label, value, names, onChange }: { label: string; value: K; names: Record<K, string>; onChange: (value: K) => void }) {
  return (
    <label>
      {label}
      <select value={value} onChange={(e) => onChange(e.currentTarget.value as K)}>
        {(Object.keys(names) as K[]).map((key) => <option key={key} value={key}>{names[key]}</option>)}
      </select>
    </label>
  );
}

export function StartOptionFields({ starts, options, onChange }: Props) {
  const t = texts().start;
  return (
    <div class="start-options">
      {starts.head && (
        <>
          <Choice label={t.head} value={options.head} names={t.heads} onChange={(head) => onChange({ ...options, head })} />
          <p class="hint">{t.headHint}</p>
        </>
      )}
      {starts.memory && <Choice label={t.memory} value={options.memory} names={t.memories} onChange={(memory) => onChange({ ...options, memory })} />}
      {starts.pass && <label>{t.pass}<input type="number" min={1} max={kMaxPass} step={1} placeholder={t.passHint} value={options.pass} onInput={(e) => onChange({ ...options, pass: e.currentTarget.value })} /></label>}
      {!starts.head && <p class="hint">{t.searchHint}{starts.pass && ` ${t.passNote}`}</p>}
    </div>
  );
}
