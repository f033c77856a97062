// One file on its way to the server: its name, its progress, and what the server has against it.
import { useEffect, useRef, useState } from 'preact/hooks';
import type { CommittedRevision } from '../../generated/api';
import { ApiError } from '../api/request';
import { addressOf } from '../app/route';
import { faultText } from '../parts/command';
import { bytesText, numberText, texts } from '../texts/texts';
import { programNameOf, programUpload, type PieceUpload } from './upload';

type State = { step: 'sending' } | { step: 'failed'; fault: string; status: number } | { step: 'stored'; revision: CommittedRevision };

export function UploadRow({ file, controls, onStored }: { file: File; controls: string[]; onStored: () => void }) {
  const t = texts().programs;
  const [name, setName] = useState(programNameOf(file.name));
  const [control, setControl] = useState('');
  const [fraction, setFraction] = useState(0);
  const [state, setState] = useState<State>({ step: 'sending' });
  const upload = useRef<PieceUpload<CommittedRevision> | null>(null);
  const run = async (isNew: boolean, force = false) => {
    if (isNew || !upload.current) {
      await upload.current?.drop().catch(() => {}); // the server drops it after a day
      upload.current = programUpload(file, { program: name, control: control || null, comment: '' }, setFraction);
    }
    setState({ step: 'sending' });
    try {
      setState({ step: 'stored', revision: await upload.current.run(force) });
      onStored();
    } catch (failure) {
      setState({ step: 'failed', fault: faultText(failure, false), status: failure instanceof ApiError ? failure.status : 0 });
    }
  };
  useEffect(() => void run(true), []);
  if (state.step === 'stored') {
    const { program, revision, unchanged } = state.revision;
    return (
      <li class="notice upload">
        <a href={addressOf('programs', [program])}>{program}</a> <span>{unchanged ? t.unchanged(revision) : t.stored(revision)}</span>
      </li>
    );
  }
  const isSending = state.step === 'sending';
  return (
    <li class="notice upload">
      <span>{file.name} <span class="muted">{bytesText(file.size)}</span></span>
      {isSending && <span class="progress-row"><progress value={fraction} max={1} aria-label={file.name} /> {numberText(fraction * 100)} %</span>}
      {!isSending && (
        <>
          <p role="alert" class="message">{state.fault}</p>
          <label>{t.name}<input value={name} maxLength={128} onInput={(e) => setName(e.currentTarget.value)} /></label>
          <label>
            {t.control}
            <select value={control} onChange={(e) => setControl(e.currentTarget.value)}>
              <option value="">{t.byText}</option>
              {controls.map((key) => <option key={key} value={key}>{key}</option>)}
            </select>
          </label>
          <p class="buttons">
            {state.status === 0 && <button type="button" class="primary" onClick={() => void run(false)}>{t.continue}</button>}
            {state.status === 409 && <button type="button" class="danger" onClick={() => void run(false, true)}>{t.replaceProtected}</button>}
            <button type="button" onClick={() => void run(true)}>{t.again}</button>
          </p>
        </>
      )}
    </li>
  );
}
