// Keys in blocks at an idle machine (MDI). The second press of the button names what will run; the text stays, to be repeated.
import { useState } from 'preact/hooks';
import type { Machine } from '../../generated/api';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { SureButton } from '../parts/sure_button';
import { texts } from '../texts/texts';
import { keyIn } from './commands';

/// Hidden while a run is active, and not taken away: its text and the answer to it stay.
export function Mdi({ machine, isShown }: { machine: Machine; isShown: boolean }) {
  const t = texts().machine;
  const command = useCommand();
  const [text, setText] = useState('');
  const [notice, setNotice] = useState('');
  const lines = text.split('\n').filter((line) => line.trim() !== '');
  const most = machine.starts.mdi;
  if (most === 0 || !isShown) return null;
  return (
    <section class="panel" aria-labelledby="mdi">
      <h2 id="mdi">{t.mdi}</h2>
      <Allowed to="operate" machine={machine.name}>
        <label>
          {t.mdiBlocks(most)}
          <textarea name="mdi" rows={Math.min(most, 3)} maxLength={2048} value={text} aria-invalid={lines.length > most} onInput={(e) => setText(e.currentTarget.value)} />
        </label>
        <SureButton class="big primary" label={t.mdiRun} disabled={lines.length === 0 || lines.length > most || command.isBusy || !machine.connected}
          question={t.mdiSure(lines.join(' / '), machine.name)} onSure={() => void command.send(async () => setNotice((await keyIn(machine.name, lines.join('\n'))).notice ?? ''))} />
        {notice !== '' && <p role="status" class="notice warn">{notice}</p>}
        <CommandFault command={command} />
      </Allowed>
    </section>
  );
}
