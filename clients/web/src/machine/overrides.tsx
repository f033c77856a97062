// The overrides and the switches of the machine's panel. A switch whose position the status does not report has two buttons.
import type { CommandRequest, Status } from '../../generated/api';
import { useRefusal } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { numberText, texts } from '../texts/texts';
import { commandMachine } from './commands';

const kStep = 0.1;
const kMax = 2; // the machine has its own limits
const kOverrides = ['feed_override', 'rapid_override', 'spindle_override'] as const;
const kSwitches = ['single_block', 'optional_stop', 'block_skip', 'dry_run', 'machine_lock', 'test_run', 'handwheel'] as const;
type Switch = (typeof kSwitches)[number];

/// Where the switch is; null: there is none, undefined: an older gateway does not report it.
function stateOf(status: NonNullable<Status>, name: Switch): boolean | null | undefined {
  if (name === 'single_block') return status.single_block;
  if (!status.switches) return name === 'dry_run' || name === 'machine_lock' || name === 'test_run' ? null : undefined;
  const state = status.switches[name];
  return state === null ? null : state === 'on';
}

/// To the next tenth: 100 %, 110 % ... whatever it was before.
export function stepOverride(value: number, step: number): number {
  const tenths = Math.round((value + step) * 10) / 10;
  return Math.min(kMax, Math.max(0, tenths));
}

export function Overrides({ machine, status }: { machine: string; status: NonNullable<Status> }) {
  const t = texts().machine;
  const command = useCommand();
  const isRefused = useRefusal('operate', machine) !== null; // the reason is beside the run's controls
  const send = (request: CommandRequest) => void command.send(() => commandMachine(machine, request));
  const turn = (name: string, isOn: boolean) => send({ action: 'switch', name, value: isOn ? 1 : 0 });
  return (
    <section class="panel overrides" aria-labelledby="panel">
      <h2 id="panel">{t.panel}</h2>
      <fieldset class="allowed" disabled={isRefused}>
      {kOverrides.map((action) => (
        <div key={action} class="override" role="group" aria-label={t.overrides[action]}>
          <span>{t.overrides[action]}</span>
          <button type="button" aria-label={t.less} disabled={command.isBusy} onClick={() => send({ action, value: stepOverride(status[action], -kStep) })}>−</button>
          <output class="live">{numberText(status[action] * 100)} %</output>
          <button type="button" aria-label={t.more} disabled={command.isBusy} onClick={() => send({ action, value: stepOverride(status[action], kStep) })}>+</button>
          <button type="button" disabled={command.isBusy} onClick={() => send({ action, value: 1 })}>100 %</button>
        </div>
      ))}
      {kSwitches.filter((name) => stateOf(status, name) !== null).map((name) => {
        const isOn = stateOf(status, name) ?? undefined;
        return (
          <div key={name} class="switch" role="group" aria-label={t.switches[name]}>
            <span>{t.switches[name]}</span>
            <button type="button" aria-pressed={isOn} disabled={command.isBusy} onClick={() => turn(name, true)}>{t.on}</button>
            <button type="button" aria-pressed={isOn === undefined ? undefined : !isOn} disabled={command.isBusy} onClick={() => turn(name, false)}>{t.off}</button>
          </div>
        );
      })}
      </fieldset>
      <CommandFault command={command} />
    </section>
  );
}
