// One machine: what it does now and the commands to it, its job queue, its setup, what its control retained, and its runs.
import { pathOf, send } from '../api/request';
import { addressOf } from '../app/route';
import { useFeed } from '../live/use_feed';
import { durationText, percentDigits, progressOf } from '../live/progress';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { StatePill } from '../parts/state_pill';
import { SureButton } from '../parts/sure_button';
import { Tabs } from '../parts/tabs';
import { dateTimeText, numberText, texts } from '../texts/texts';
import { Blocks } from './blocks';
import { ExecutedPath } from './executed_path';
import { ExecutingText } from './executing_text';
import { Jog } from './jog';
import { MachineQueue, NextJob } from './jobs/queue';
import { LiveValues } from './live_values';
import { MachineMemory } from './memory';
import { Mdi } from './mdi';
import { Modes } from './modes';
import { Overrides } from './overrides';
import { Position } from './position';
import { RunControls } from './run_controls';
import { RunRecords } from './run_records';
import { MachineRuns } from './runs';
import { SetPosition } from './set_position';
import { MachineSetup } from './setup/setup';
import { StartForm } from './start_form';

const kTabs = ['now', 'queue', 'setup', 'memory', 'runs'] as const;

function Now({ name }: { name: string }) {
  const feed = useFeed(`machine:${name}`, 'link');
  const machine = feed.machines.get(name)!;
  const { status } = machine;
  const run = feed.runs.get(name);
  const hasRun = status?.run != null;
  const executing = feed.runOf(machine);
  // The path of an unknown control cannot be interpreted, and the line of a serial machine reports no position.
  const hasPath = hasRun && machine.display !== null && Object.keys(status.position).length > 0;
  return (
    <>
      <RunControls machine={machine} />
      <div class="columns">
        <div>
          {status && <Position machine={machine} status={status} />}
          {status && <Blocks status={status} />}
          {!hasRun && <NextJob key={`next ${name}`} name={name} />}
          {!hasRun && <StartForm key={name} machine={machine} />}
          <Mdi key={`mdi ${name}`} machine={machine} isShown={!hasRun} />
          {!hasRun && status && <Jog key={`jog ${name}`} machine={machine} status={status} />}
          {!hasRun && status && <SetPosition key={`set ${name}`} machine={machine} status={status} />}
          {hasPath && executing && <ExecutedPath key={executing.id} run={executing} status={status} />}
          {run && <RunRecords run={run.id} />}
        </div>
        <div>{status && <ExecutingText run={executing} status={status} />}{status && <Modes machine={machine} status={status} />}</div>
        <div>{status && <Overrides machine={name} status={status} />}</div>
      </div>
    </>
  );
}

/// Another gateway than the one before is taken when a person says so.
function ConfirmGateway({ name }: { name: string }) {
  const t = texts().machine;
  const command = useCommand();
  return (
    <Allowed to="operate" machine={name}>
      <p class="buttons">
        <SureButton label={t.confirmGateway} question={t.confirmGatewaySure(name)} disabled={command.isBusy}
          onSure={() => void command.send(() => send('POST', pathOf('machines', name, 'confirm-gateway')))} />
      </p>
      <CommandFault command={command} />
    </Allowed>
  );
}

function Head({ name }: { name: string }) {
  const feed = useFeed(`machine:${name}`);
  const t = texts().machine;
  const machine = feed.machines.get(name)!;
  const state = feed.stateOf(machine);
  const progress = machine.connected ? progressOf(machine.status, feed.runOf(machine)) : null;
  return (
    <div class="machine-head live">
      <h1>{name}</h1>
      <StatePill state={state} />
      <span class="muted">{[machine.control, machine.description].filter(Boolean).join(' · ')}</span>
      {!machine.connected && <span class="muted">{texts().floor.lastSeen(dateTimeText(machine.last_seen))}</span>}
      {progress && (
        <span class="progress-row">
          <progress value={progress.fraction} max={1} aria-label={texts().floor.progress} />
          <span>{numberText(progress.fraction * 100, percentDigits(progress.fraction))} %</span>
          {progress.secondsLeft !== null && <span class="muted">{texts().floor.timeLeft(durationText(progress.secondsLeft))}</span>}
        </span>
      )}
      {state.message && <p class="message">{state.message}</p>}
      {machine.held && <p class="notice warn">{t.heldBy(machine.held.who, machine.held.reason, dateTimeText(machine.held.since))}</p>}
      {machine.queue_hold && <p class="notice warn">{t.queueHeldBy(machine.queue_hold.who, machine.queue_hold.reason, dateTimeText(machine.queue_hold.since))}</p>}
      {machine.notices.map((notice) => <p key={notice} class="notice warn">{t.notice}: {notice}</p>)}
      {machine.unconfirmed_gateway !== null && <ConfirmGateway name={name} />}
    </div>
  );
}

export default function MachineView({ path }: { path: string[] }) {
  const [name = '', tab = 'now'] = path;
  const feed = useFeed('machines', 'link');
  const t = texts().machine;
  const { connected = false, status = null } = feed.machines.get(name) ?? {};
  // An older gateway, and a control at the end of a line, answer no questions for values.
  const canAsk = connected && status?.screen != null;
  if (!feed.machines.has(name)) {
    return <p class="notice">{feed.link.state === 'connecting' ? texts().app.loading : t.unknown(name)}</p>;
  }
  return (
    <>
      <Head name={name} />
      <Tabs label={t.parts} tabs={kTabs.map((key) => ({ address: addressOf('machine', [name, key]), name: t.tabs[key], isShown: key === tab }))} />
      {tab === 'now' && <Now name={name} />}
      {tab === 'queue' && <MachineQueue name={name} key={name} />}
      {tab === 'setup' && <MachineSetup machine={name} key={name} />}
      {tab === 'memory' && <>{canAsk && <LiveValues machine={name} key={name} />}<MachineMemory machine={name} /></>}
      {tab === 'runs' && <MachineRuns machine={name} />}
    </>
  );
}
