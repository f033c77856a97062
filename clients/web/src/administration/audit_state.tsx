// Whether the audit trail is as it was written: the last verification, a new one, the last checkpoint, and the whole trail as a file.
import { useState } from 'preact/hooks';
import type { AuditVerification } from '../../generated/api';
import { get, pathOf, send } from '../api/request';
import { CommandFault, useCommand } from '../parts/command';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { download, saveText } from '../programs/download';
import { dateTimeText, numberText, texts } from '../texts/texts';

function Verification({ state }: { state: AuditVerification }) {
  const t = texts().audit;
  const { verification: done } = state;
  if (!done) return <p class="notice">{t.notVerified}</p>;
  const at = dateTimeText(done.time);
  if (done.intact) return <p class="notice"><b>{t.intact}</b> {t.verified(numberText(done.entries), at)}</p>;
  return <p class="notice bad" role="alert"><b>{t.damaged}</b> {done.fault ? t.fault(numberText(done.fault.entry), done.fault.what) : ''} {t.verified(numberText(done.entries), at)}</p>;
}

/// The trail can be whole while an archive that it names is not.
function Archives({ state }: { state: NonNullable<AuditVerification['archives']> }) {
  const t = texts().audit;
  const at = dateTimeText(state.time);
  if (state.intact) return <p class="notice"><b>{t.archivesIntact}</b> {t.archivesRead(state.archives, at)}</p>;
  return (
    <div class="notice bad" role="alert">
      <b>{t.archivesDamaged}</b> {t.archivesRead(state.archives, at)}
      <ul>{state.faults.map((fault) => <li key={fault.file + fault.what}><span class="mono">{fault.file}</span>: {fault.what}</li>)}</ul>
    </div>
  );
}

export function AuditState() {
  const t = texts().audit;
  const command = useCommand();
  const [verified, setVerified] = useState<AuditVerification | null>(null);
  const loaded = useLoaded((signal) => get<AuditVerification>(pathOf('audit', 'verification'), {}, signal), []);
  const state = verified ?? loaded.value;
  const verify = () => void command.send(async () => setVerified(await send<AuditVerification>('POST', pathOf('audit', 'verification'))));
  const checkpoint = state?.checkpoint;
  return (
    <section class="panel" aria-labelledby="audit-state">
      <h2 id="audit-state">{t.title}</h2>
      <Loading of={loaded} />
      {state && <Verification state={state} />}
      {state?.archives && <Archives state={state.archives} />}
      {checkpoint && <p>{t.checkpoint(numberText(checkpoint.number), numberText(checkpoint.entry), dateTimeText(checkpoint.time))}</p>}
      <p class="hint">{t.hint}</p>
      <p class="buttons">
        <button type="button" class="primary" disabled={command.isBusy} onClick={verify}>{t.verify}</button>
        <button type="button" disabled={command.isBusy} onClick={() => void command.send(() => download(pathOf('audit', 'export'), 'audit-trail.txt'))}>{t.export}</button>
        {checkpoint && <button type="button" onClick={() => saveText(checkpoint.text, `checkpoint-${checkpoint.number}.txt`)}>{t.saveCheckpoint}</button>}
      </p>
      <CommandFault command={command} />
      {state && <p class="hint mono">{t.publicKey} {state.public_key}</p>}
    </section>
  );
}
