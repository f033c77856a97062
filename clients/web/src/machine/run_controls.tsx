// What an operator does to a run: hold, resume, abort, answer; and the software stop, which needs no second press.
import { useState } from 'preact/hooks';
import type { Machine } from '../../generated/api';
import { questionOf } from '../live/machine_state';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { SureButton } from '../parts/sure_button';
import { texts } from '../texts/texts';
import { commandMachine, commandRun } from './commands';

const kHeld = ['FEED_HOLD', 'PROGRAM_STOPPED', 'OPTIONAL_STOP', 'INTERRUPTED'];

/// Whether "resume" is the next step.
export function canResume(machine: Machine): boolean {
  const status = machine.status;
  return status !== null && status.run !== null && (kHeld.includes(status.execution) || status.waits_for === 'cycle_start');
}

function Answer({ run, question }: { run: string; question: string }) {
  const t = texts().machine;
  const command = useCommand();
  const [text, setText] = useState('');
  const submit = async (event: Event) => {
    event.preventDefault();
    if (await command.send(() => commandRun(run, { action: 'answer', text }))) setText('');
  };
  return (
    <form class="notice warn answer" onSubmit={(event) => void submit(event)}>
      <label>
        <b>{t.asks}</b> {question}
        <input name="answer" autocomplete="off" value={text} onInput={(e) => setText(e.currentTarget.value)} />
      </label>
      <button type="submit" class="primary" disabled={command.isBusy}>{t.answer}</button>
      <CommandFault command={command} />
    </form>
  );
}

export function RunControls({ machine }: { machine: Machine }) {
  const t = texts().machine;
  const command = useCommand();
  const { status } = machine;
  const run = status?.run ?? null;
  const isStopped = status?.emergency_stop ?? false;
  const question = questionOf(machine);
  const give = (action: 'hold' | 'resume' | 'abort') => void command.send(() => commandRun(run!, { action }));
  const stop = (isPressed: boolean) =>
    void command.send(() => commandMachine(machine.name, { action: 'switch', name: 'emergency_stop', value: isPressed ? 1 : 0 }));
  const isOff = !machine.connected || command.isBusy;
  return (
    <Allowed to="operate" machine={machine.name}>
      {question !== null && run !== null && <Answer key={question} run={run} question={question} />}
      <div class="controls" role="group" aria-label={t.run}>
        <button type="button" class="big" disabled={isOff || run === null || status?.execution !== 'ACTIVE'} onClick={() => give('hold')}>{t.hold}</button>
        <button type="button" class="big primary" disabled={isOff || !canResume(machine)} onClick={() => give('resume')}>{t.resume}</button>
        <SureButton class="big danger" label={t.abort} question={t.abortSure(status?.program ?? '')} disabled={isOff || run === null} onSure={() => give('abort')} />
        <button type="button" class="big danger" aria-pressed={isStopped} disabled={isOff} title={t.softwareStopHint} onClick={() => stop(!isStopped)}>
          {isStopped ? t.releaseStop : t.softwareStop}
        </button>
      </div>
      {status?.remote_enable === 'not_given' && <p class="notice">{t.attended}</p>}
      <CommandFault command={command} />
    </Allowed>
  );
}
