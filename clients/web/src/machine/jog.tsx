// One axis by one step, at a machine without a run. The buttons move at once, so they are enabled by two presses first, and again after a minute without one.
import { useEffect, useState } from 'preact/hooks';
import type { JogDone, Machine, Status } from '../../generated/api';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { SureButton } from '../parts/sure_button';
import { numberText, texts } from '../texts/texts';
import { commandMachine, jog } from './commands';
import { isDiameter, isRotary, sortAxes, unitOf, type LengthUnit } from './units';

const kEnabledMs = 60_000;
const kSteps = [0.0001, 0.001, 0.01, 0.1, 1, 10, 100];
const kFeeds = [1, 0.5, 0.25, 0.1];
const kNoise = 1e-9;

/// In the unit of the display, degrees of a rotary axis: from its resolution to the largest that the gateway takes.
export function stepsOf(unit: LengthUnit, largest: number): number[] {
  const smallest = 10 ** -unit.digits;
  return kSteps.filter((step) => step > smallest / 2 && step / unit.perMm <= largest + kNoise);
}

const stepText = (step: number) => numberText(step, Math.max(0, Math.round(-Math.log10(step))));

type JogLimits = NonNullable<NonNullable<Status>['jog']>;

function Steps({ machine, axes, limits }: { machine: Machine; axes: string[]; limits: JogLimits }) {
  const t = texts().machine;
  const unit = unitOf(machine.display);
  const steps = stepsOf(unit, limits.step);
  const command = useCommand();
  const stop = useCommand();
  const [chosen, setStep] = useState(0.1);
  const [feed, setFeed] = useState(1);
  const [enabledUntil, setEnabledUntil] = useState(0);
  const [answer, setAnswer] = useState('');
  const step = steps.includes(chosen) ? chosen : (steps.at(-1) ?? 0);
  const isEnabled = enabledUntil > 0;
  useEffect(() => {
    if (!isEnabled) return undefined;
    const timer = setTimeout(() => setEnabledUntil(0), enabledUntil - Date.now());
    return () => clearTimeout(timer);
  }, [enabledUntil]);
  const isReady = machine.connected && limits.refusal === null && !limits.moving;
  const enable = () => setEnabledUntil(Date.now() + kEnabledMs);
  const move = (axis: string, distance: number) => {
    enable();
    setAnswer('');
    const scale = isRotary(axis) ? 1 : unit.perMm;
    const request = { axis, distance, unit: isRotary(axis) ? 'deg' : unit.name === 'inch' ? 'in' : 'mm', feed: limits.feed * feed * scale } as const;
    void command.send(async () => setAnswer(((await jog(machine.name, request)) as JogDone).text));
  };
  const nameOf = (axis: string, sign: number) =>
    `${axis} ${sign < 0 ? '−' : '+'}${stepText(step)} ${isRotary(axis) ? '°' : unit.name}${isDiameter(axis, machine.display) ? ` (${t.diameter})` : ''}`;
  const halt = () => void stop.send(() => commandMachine(machine.name, { action: 'stop_jog' }));
  return (
    <>
      {limits.refusal !== null && !limits.moving && !command.isBusy && <p class="notice">{limits.refusal}</p>}
      <div class="tools">
        <label>{t.jogStep}<select value={step} onChange={(e) => setStep(Number(e.currentTarget.value))}>
          {steps.map((one) => <option key={one} value={one}>{stepText(one)}</option>)}
        </select></label>
        <label>{t.feed}<select value={feed} onChange={(e) => setFeed(Number(e.currentTarget.value))}>
          {kFeeds.map((one) => <option key={one} value={one}>{`${numberText(one * 100)} %`}</option>)}
        </select></label>
        {!isEnabled && <SureButton label={t.jogEnable} disabled={!isReady} question={t.jogSure(machine.name)} onSure={enable} />}
      </div>
      <div class="jog">
        {axes.map((axis) => [-1, 1].map((sign) => (
          <button key={`${axis}${sign}`} type="button" class="big" disabled={!isEnabled || !isReady || command.isBusy} onClick={() => move(axis, sign * step)}>{nameOf(axis, sign)}</button>
        )))}
      </div>
      <button type="button" class="big" disabled={!machine.connected || !(limits.moving || command.isBusy)} onClick={halt}>{t.jogStop}</button>
      {answer !== '' && command.fault === null && <p role="status">{answer}</p>}
      <CommandFault command={command} />
      <CommandFault command={stop} />
    </>
  );
}

export function Jog({ machine, status }: { machine: Machine; status: NonNullable<Status> }) {
  const axes = sortAxes(Object.keys(status.position));
  if (!status.jog || axes.length === 0) return null; // an older server has none
  return (
    <section class="panel" aria-labelledby="jog">
      <h2 id="jog">{texts().machine.jog}</h2>
      <Allowed to="operate" machine={machine.name}>
        <Steps machine={machine} axes={axes} limits={status.jog} />
      </Allowed>
    </section>
  );
}
