// Copies, renames and removes a program.
import { useState } from 'preact/hooks';
import type { ProgramWithRevisions } from '../../generated/api';
import { ApiError, pathOf, send, withQuery } from '../api/request';
import { addressOf } from '../app/route';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { SureButton } from '../parts/sure_button';
import { texts } from '../texts/texts';

export function Manage({ program }: { program: ProgramWithRevisions }) {
  const t = texts().programs;
  const command = useCommand();
  const [to, setTo] = useState('');
  const [isProtected, setProtected] = useState(false);
  const go = async (action: () => Promise<unknown>, next: string) => {
    if (await command.send(action)) location.hash = next;
  };
  const remove = () => go(async () => {
    try {
      await send('DELETE', withQuery(pathOf('programs', program.name), { force: isProtected ? true : null }));
    } catch (failure) {
      setProtected(failure instanceof ApiError && failure.status === 409);
      throw failure;
    }
  }, addressOf('programs'));
  return (
    <details>
      <summary class="button">{t.manage}</summary>
      <div class="panel"><Allowed to="program">
        <label>{t.newName}<input value={to} maxLength={128} onInput={(e) => setTo(e.currentTarget.value)} /></label>
        <p class="buttons">
          <button type="button" disabled={to === '' || command.isBusy} onClick={() => void go(() => send('POST', pathOf('programs', program.name, 'copy'), { json: { to } }), addressOf('programs', [to]))}>{t.copy}</button>
          <button type="button" disabled={to === '' || command.isBusy} onClick={() => void go(() => send('POST', pathOf('programs', program.name, 'rename'), { json: { to } }), addressOf('programs', [to]))}>{t.rename}</button>
          <SureButton class="danger" label={isProtected ? t.removeProtected : t.remove} question={t.removeSure(program.name, program.revisions.length)} disabled={command.isBusy} onSure={() => void remove()} />
        </p>
        <CommandFault command={command} />
      </Allowed></div>
    </details>
  );
}
