// Accepts what a machine has sent, as itself or as another program, or rejects it with a reason.
import { useState } from 'preact/hooks';
import { pathOf, send } from '../api/request';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { SureButton } from '../parts/sure_button';
import { texts } from '../texts/texts';

const kMaxReason = 1024;

export function Decide({ import_, onDecided }: { import_: { program: string; revision: number }; onDecided: () => void }) {
  const t = texts().imports;
  const { program, revision } = import_;
  const command = useCommand();
  const [as, setAs] = useState('');
  const [comment, setComment] = useState('');
  const target = as.trim();
  const reason = comment.trim();
  const decide = async (verdict: 'accept' | 'reject', json: object) => {
    if (await command.send(() => send('POST', pathOf('imports', program, revision, verdict), { json }))) onDecided();
  };
  const accept = () => decide('accept', { ...(target !== '' && { as: target }), ...(reason !== '' && { comment: reason }) });
  return (
    <Allowed to="approve">
      <div class="decide">
        <label>{t.as}<input value={as} maxLength={128} autocomplete="off" onInput={(e) => setAs(e.currentTarget.value)} /></label>
        <label>{t.comment}<input value={comment} maxLength={kMaxReason} onInput={(e) => setComment(e.currentTarget.value)} /></label>
      </div>
      <p class="buttons">
        <SureButton class="primary" label={t.accept} question={t.acceptSure(program, revision, target)} disabled={command.isBusy} onSure={() => void accept()} />
        <SureButton class="danger" label={t.reject} question={t.rejectSure(program, revision)} disabled={command.isBusy || reason === ''}
          onSure={() => void decide('reject', { reason })} />
        {reason === '' && <span class="hint">{t.rejectNeeds}</span>}
      </p>
      <CommandFault command={command} />
    </Allowed>
  );
}
