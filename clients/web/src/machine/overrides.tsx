// The overrides and the switches of the machine's panel. A switch whose position the status does not report has two buttons.
import type { CommandRequest, Status } from '../../generated/api';
import { useRefusal } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { numberText, texts } from '../texts/texts';
import { commandMachine } from './commands';

const kStep = 0.1;
const kMax = 2; // the machine has its own limits
const kOverrides = ['feed_override', 'rapid_override', 'spindle_override'] as const;
const kSwitches = ['single_block', 'optional_stop', 'block_skip', 'handwheel'] as const;

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
      {kSwitches.map((name) => (
        <div key={name} class="switch" role="group" aria-label={t.switches[name]}>
          <span>{t.switches[name]}</span>
          <button type="button" aria-pressed={name === 'single_block' ? status.single_block : undefined} disabled={command.isBusy} onClick={() => turn(name, true)}>{t.on}</button>
          <button type="button" aria-pressed={name === 'single_block' ? !status.single_block : undefined} disabled={command.isBusy} onClick={() => turn(name, false)}>{t.off}</button>
        </div>
      ))}
      </fieldset>
      <CommandFault command={command} />
    </section>
  );
}
