// Whether the queue is held, by whom and why; holding it for a reason, and its release.
import { useState } from 'preact/hooks';
import type { JobList } from '../../../generated/api';
import { pathOf, send } from '../../api/request';
import { CommandFault, useCommand } from '../../parts/command';
import { SureButton } from '../../parts/sure_button';
import { dateTimeText, texts } from '../../texts/texts';

const kMaxReason = 1024;

interface Props {
  machine: string;
  hold: JobList['hold'];
}

function Held({ machine, hold }: Props & { hold: NonNullable<JobList['hold']> }) {
  const t = texts().jobs;
  const command = useCommand();
  const release = () => void command.send(() => send('DELETE', pathOf('machines', machine, 'job-hold')));
  return (
    <div class="notice warn held" role="status">
      <p><b>{t.held}</b> {hold.reason} <span class="muted">{hold.who}, {dateTimeText(hold.since)}</span></p>
      <p class="buttons"><SureButton class="primary" label={t.release} question={t.releaseSure(machine)} disabled={command.isBusy} onSure={release} /></p>
      <CommandFault command={command} />
    </div>
  );
}

/// A hold stops work and needs one press, but a reason.
function HoldForm({ machine }: Omit<Props, 'hold'>) {
  const t = texts().jobs;
  const command = useCommand();
  const [reason, setReason] = useState('');
  const hold = async (event: Event) => {
    event.preventDefault();
    if (await command.send(() => send('PUT', pathOf('machines', machine, 'job-hold'), { json: { reason: reason.trim() } }))) setReason('');
  };
  return (
    <details>
      <summary class="button">{t.hold}</summary>
      <div class="panel">
        <p class="hint">{t.holdHint}</p>
        <form class="with-button" onSubmit={(event) => void hold(event)}>
          <label>{t.reason}<input required maxLength={kMaxReason} pattern=".*\S.*" autocomplete="off" value={reason} onInput={(e) => setReason(e.currentTarget.value)} /></label>
          <button type="submit" class="danger" disabled={command.isBusy}>{t.holdNow}</button>
        </form>
        <CommandFault command={command} />
      </div>
    </details>
  );
}

/// What is changed here comes back as an event of the queue.
export function Hold({ machine, hold }: Props) {
  return hold ? <Held machine={machine} hold={hold} /> : <HoldForm machine={machine} />;
}
