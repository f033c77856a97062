// The server's backups: whether the newest is recent enough, what is being done, and each one with its age and its last verification.
import type { Backup, Backups } from '../../generated/api';
import { getIfThere, pathOf, send } from '../api/request';
import { CommandFault, useCommand } from '../parts/command';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { SureButton } from '../parts/sure_button';
import { useRefreshed } from '../parts/use_refreshed';
import { bytesText, dateTimeText, numberText, relativeText, texts } from '../texts/texts';

const kWorkingMs = 1000;
const kQuietMs = 10_000;

interface LoadedState {
  /// null: this server makes no backups.
  state: Backups | null;
}

async function load(signal: AbortSignal): Promise<LoadedState> {
  return { state: await getIfThere<Backups>(pathOf('backups'), {}, signal) };
}

function Work({ state }: { state: Backups }) {
  const t = texts().backups;
  const { work, last } = state;
  return (
    <div role="status">
      {work && (
        <p class="progress-row">
          <span>{t.phases[work.phase]} {work.backup}</span>
          <progress value={work.total > 0 ? work.done / work.total : 0} max={1} aria-label={t.phases[work.phase]} />
          <span>{bytesText(work.done)}</span>
        </p>
      )}
      {!work && last && (
        <p class={`notice ${last.error === '' ? '' : 'bad'}`}>{last.error === '' ? t.done[last.kind](last.backup, dateTimeText(last.time)) : t.failed[last.kind](last.error)}</p>
      )}
    </div>
  );
}

interface RowProps {
  backup: Backup;
  isOnly: boolean;
  isOff: boolean;
  act: (action: () => Promise<unknown>) => void;
}

function Row({ backup, isOnly, isOff, act }: RowProps) {
  const t = texts().backups;
  return (
    <tr>
      <th scope="row">{dateTimeText(backup.made)} <span class="muted">{relativeText(backup.made)}</span></th>
      <td>{backup.made_by}</td>
      <td>{bytesText(backup.size)} <span class="muted">{t.added(bytesText(backup.added))}</span></td>
      <td>{backup.verified === null ? <span class="pill waiting">{t.neverVerified}</span> : dateTimeText(backup.verified)}</td>
      <td>
        <span class="row-buttons">
          <button type="button" aria-label={t.verifyOf(backup.id)} disabled={isOff} onClick={() => act(() => send('POST', pathOf('backups', backup.id, 'verify')))}>{t.verify}</button>
          <SureButton class="danger" label={t.remove} question={t.removeSure(backup.id)} disabled={isOff || isOnly} onSure={() => act(() => send('DELETE', pathOf('backups', backup.id)))} />
        </span>
      </td>
    </tr>
  );
}

function Shown({ state, onChanged }: { state: Backups; onChanged: () => void }) {
  const t = texts().backups;
  const command = useCommand();
  const isOff = command.isBusy || state.work !== null;
  const act = (action: () => Promise<unknown>) => void command.send(action).then((isDone) => { if (isDone) onChanged(); });
  return (
    <>
      <p>{state.every_hours === 0 ? t.onRequest : t.every(numberText(state.every_hours))} <span class="muted">{t.folder(state.folder)}</span></p>
      {state.overdue && <p class="notice bad">{t.overdue}</p>}
      {state.damaged.map((file) => <p key={file} class="notice bad">{t.damaged(file)}</p>)}
      <p class="buttons"><button type="button" class="primary" disabled={isOff} onClick={() => act(() => send('POST', pathOf('backups')))}>{t.make}</button></p>
      <CommandFault command={command} />
      <Work state={state} />
      {state.backups.length === 0 && <p class="notice warn">{t.none}</p>}
      {state.backups.length > 0 && (
        <div class="scroll" tabIndex={0} role="group" aria-labelledby="backups">
          <table class="data">
            <Heads of={[t.made, t.madeBy, t.size, t.verified, t.actions]} />
            <tbody>
              {state.backups.map((backup) => (
                <Row key={backup.id} backup={backup} isOnly={state.backups.length === 1} isOff={isOff} act={act} />
              ))}
            </tbody>
          </table>
        </div>
      )}
    </>
  );
}

export function BackupList() {
  const t = texts().backups;
  const backups = useRefreshed(load, (value) => (value?.state?.work ? kWorkingMs : kQuietMs));
  return (
    <section class="panel" aria-labelledby="backups">
      <h2 id="backups">{t.title}</h2>
      <Loading of={backups} />
      {backups.value && (backups.value.state ? <Shown state={backups.value.state} onChanged={backups.reload} /> : <p class="notice warn">{t.off}</p>)}
    </section>
  );
}
