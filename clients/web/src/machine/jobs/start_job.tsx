// Starts the next run of a job. The second press of the button names the program and the parts.
import type { Job, JobList, Machine, Run } from '../../../generated/api';
import { pathOf, send } from '../../api/request';
import { useFeed } from '../../live/use_feed';
import { useCommand, CommandFault } from '../../parts/command';
import { SureButton } from '../../parts/sure_button';
import { numberText, texts } from '../../texts/texts';
import { nextParts } from './job_steps';

export function partsText(job: Job): string {
  const t = texts().jobs;
  const { first, last } = nextParts(job);
  const numbers = first === last ? numberText(first) : t.range(numberText(first), numberText(last));
  return t.partsOf(numbers, numberText(job.quantity));
}

/// What keeps every job of the machine from being started; null: nothing.
export function startFault(machine: Machine, hold: JobList['hold']): string | null {
  const t = texts().jobs;
  const held = hold ?? machine.queue_hold; // what comes with the machine is there before the queue is read again
  if (held) return t.isHeld(held.who, held.reason);
  if (!machine.connected) return t.notConnected(machine.name);
  return machine.status?.run == null ? null : t.isRunning(machine.status.program ?? '');
}

interface Props {
  job: Job;
  hold: JobList['hold'];
  label: string;
  class?: string;
}

export function StartJob({ job, hold, label, ...more }: Props) {
  const t = texts().jobs;
  const machine = useFeed(`machine:${job.machine}`).machines.get(job.machine);
  const command = useCommand();
  const isOff = !machine || startFault(machine, hold) !== null || command.isBusy;
  const start = () => void command.send(() => send<Run>('POST', pathOf('machines', job.machine, 'start-job'), { json: { job: job.id } }));
  return (
    <>
      <SureButton {...more} label={label} question={t.startSure(job.program, partsText(job), job.machine)} disabled={isOff} onSure={start} />
      <CommandFault command={command} />
    </>
  );
}
