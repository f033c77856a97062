// Starts this revision on one of the machines whose control it is for, or adds it to the queue of one.
import { useState } from 'preact/hooks';
import type { ReleasePolicy, Revision } from '../../generated/api';
import { addressOf } from '../app/route';
import { useFeed } from '../live/use_feed';
import { startRun } from '../machine/commands';
import { JobForm } from '../machine/jobs/job_form';
import { Allowed, useSessionState } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { SureButton } from '../parts/sure_button';
import { texts } from '../texts/texts';
import { runRefusalOf, type RunRefusal } from './release_steps';

function runRefusalText(refusal: RunRefusal, machine: string): string {
  const t = texts().release;
  if (refusal.why === 'proveOut') return t.proveOutNeeds(machine, texts().session.roles[refusal.needs]);
  return refusal.why === 'withdrawn' ? t.isWithdrawn : t.isNotReleased(machine);
}

/// For a machine that is busy or away: the revision waits in its queue.
function QueueOn({ revision }: { revision: Revision }) {
  const t = texts().jobs;
  const feed = useFeed('machines');
  const [machine, setMachine] = useState('');
  const [queued, setQueued] = useState('');
  const fitting = [...feed.machines.values()].filter((m) => revision.control === null || m.control === revision.control);
  return (
    <details>
      <summary class="button">{t.queueOn}</summary>
      <div>
        <label>
          {texts().administration.machine}
          <select value={machine} onChange={(e) => { setMachine(e.currentTarget.value); setQueued(''); }}>
            <option value="">–</option>
            {fitting.map((m) => <option key={m.name} value={m.name}>{m.name}</option>)}
          </select>
        </label>
        {machine !== '' && (
          <Allowed to="operate" machine={machine}>
            <JobForm key={`${machine} ${revision.revision}`} machine={machine} fixed={revision} onAdded={() => setQueued(machine)} />
          </Allowed>
        )}
        {queued !== '' && <p class="notice" role="status">{t.queued(queued)} <a href={addressOf('machine', [queued, 'queue'])}>{t.showQueue}</a></p>}
      </div>
    </details>
  );
}

/// `policy` null: not known yet; the server decides anyway.
export function StartOn({ revision, policy }: { revision: Revision; policy: ReleasePolicy | null }) {
  const t = texts().programs;
  const feed = useFeed('machines');
  const command = useCommand();
  const [machine, setMachine] = useState('');
  const fitting = [...feed.machines.values()].filter((m) => m.connected && (revision.control === null || m.control === revision.control));
  const session = useSessionState();
  const refusal = machine !== '' && policy && 'session' in session ? runRefusalOf(policy, revision.state, machine, session.session) : null;
  const start = async () => {
    const request = { machine, program: revision.program, revision: revision.revision, from: '' };
    if (await command.send(() => startRun(request))) location.hash = addressOf('machine', [machine]);
  };
  return (
    <div class="start-on">
      <label>
        {t.startOn}
        <select value={machine} onChange={(e) => setMachine(e.currentTarget.value)}>
          <option value="">{fitting.length === 0 ? t.noMachine : '–'}</option>
          {fitting.map((m) => <option key={m.name} value={m.name}>{m.name} · {texts().states[feed.stateOf(m).word]}</option>)}
        </select>
      </label>
      {refusal && <p class="notice refusal">{runRefusalText(refusal, machine)}</p>}
      <Allowed to="operate" {...(machine !== '' && { machine })}>
        <SureButton class="primary" label={texts().machine.start} disabled={machine === '' || revision.held || refusal !== null || command.isBusy}
          question={texts().machine.startSure(revision.program, String(revision.revision), machine, '')} onSure={() => void start()} />
      </Allowed>
      <CommandFault command={command} />
      {!revision.held && <QueueOn revision={revision} />}
    </div>
  );
}
