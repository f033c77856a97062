// Setup sheets, drawings and other files beside a program: dropped here, saved, removed. A browser never shows one of them within the page.
import { useEffect, useRef, useState } from 'preact/hooks';
import type { Attachment, Attachments as AttachmentList, Revision } from '../../generated/api';
import { get, pathOf, send, withQuery } from '../api/request';
import { Allowed, useRefusal } from '../parts/allowed';
import { CommandFault, faultText, useCommand } from '../parts/command';
import { Loading } from '../parts/loading';
import { SureButton } from '../parts/sure_button';
import { useLoaded } from '../parts/use_loaded';
import { bytesText, dateTimeText, numberText, texts } from '../texts/texts';
import { download } from './download';
import { DropArea } from './drop_area';
import { attachmentUpload, type PieceUpload } from './upload';

interface Sent {
  key: number;
  file: File;
  revision: number | null;
}

function pathOfAttachment({ program, name, revision }: Attachment): string {
  return withQuery(pathOf('programs', program, 'attachments', name), { revision });
}

/// One file on its way; it is gone from here when it is stored.
function SentRow({ program, sent, onStored, onGone }: { program: string; sent: Sent; onStored: () => void; onGone: () => void }) {
  const [fraction, setFraction] = useState(0);
  const [fault, setFault] = useState<string | null>(null);
  const upload = useRef<PieceUpload<Attachment> | null>(null);
  const run = async () => {
    upload.current ??= attachmentUpload(sent.file, { program, revision: sent.revision, name: sent.file.name }, setFraction);
    setFault(null);
    try {
      await upload.current.run();
      onStored();
    } catch (failure) {
      setFault(faultText(failure, false));
    }
  };
  useEffect(() => void run(), []);
  const drop = () => {
    void upload.current?.drop().catch(() => {}); // the server drops it after a day
    onGone();
  };
  return (
    <li class="notice upload">
      <span>{sent.file.name} <span class="muted">{bytesText(sent.file.size)}</span></span>
      {fault === null ? <span class="progress-row"><progress value={fraction} max={1} aria-label={sent.file.name} /> {numberText(fraction * 100)} %</span> : (
        <>
          <p role="alert" class="message">{fault}</p>
          <p class="buttons">
            <button type="button" class="primary" onClick={() => void run()}>{texts().programs.continue}</button>
            <button type="button" onClick={drop}>{texts().library.dropIt}</button>
          </p>
        </>
      )}
    </li>
  );
}

function Row({ attachment, onRemoved }: { attachment: Attachment; onRemoved: () => void }) {
  const t = texts().library;
  const command = useCommand();
  const isRefused = useRefusal('program') !== null;
  const path = pathOfAttachment(attachment);
  const remove = async () => {
    if (await command.send(() => send('DELETE', path))) onRemoved();
  };
  return (
    <li class="attachment">
      <button type="button" class="name" onClick={() => void command.send(() => download(path, attachment.name))}>
        <span aria-hidden="true">↓</span> <span class="record-text">{attachment.name}</span><span class="visually-hidden"> {t.save}</span>
      </button>
      <SureButton class="danger" label={texts().programs.remove} question={t.removeSure(attachment.name)} disabled={isRefused || command.isBusy} onSure={() => void remove()} />
      <p class="muted">
        {[bytesText(attachment.size), attachment.revision === null ? t.ofProgram : texts().machine.revision(attachment.revision), attachment.author, dateTimeText(attachment.created)].join(' · ')}
        {attachment.comment && ` · ${attachment.comment}`}
      </p>
      <CommandFault command={command} />
    </li>
  );
}

export function Attachments({ shown }: { shown: Revision }) {
  const t = texts().library;
  const { program, revision } = shown;
  const [sent, setSent] = useState<Sent[]>([]);
  const [count, setCount] = useState(0);
  const [isOfRevision, setOfRevision] = useState(false);
  const isRefused = useRefusal('program') !== null;
  const list = useLoaded((signal) => get<AttachmentList>(pathOf('programs', program, 'attachments'), { revision }, signal), [program, revision]);
  const attachments = list.value?.attachments ?? [];
  const take = (files: File[]) => {
    if (isRefused) return;
    setSent([...sent, ...files.map((file, i) => ({ key: count + i, file, revision: isOfRevision ? revision : null }))]);
    setCount(count + files.length);
  };
  const drop = (key: number) => setSent((before) => before.filter((other) => other.key !== key));
  return (
    <section class="panel" aria-labelledby="attachments">
      <h2 id="attachments">{t.attachments}</h2>
      <Loading of={list} />
      {list.value && attachments.length === 0 && sent.length === 0 && <p class="muted">{t.noAttachments}</p>}
      <ul class="list" aria-labelledby="attachments">
        {attachments.map((attachment) => <Row key={`${attachment.revision} ${attachment.name}`} attachment={attachment} onRemoved={list.reload} />)}
        {sent.map((one) => <SentRow key={one.key} program={program} sent={one} onStored={() => { drop(one.key); list.reload(); }} onGone={() => drop(one.key)} />)}
      </ul>
      <Allowed to="program">
        <DropArea class="small" label={t.dropAttachments} onFiles={take} />
        <label class="check"><input type="checkbox" checked={isOfRevision} onChange={(e) => setOfRevision(e.currentTarget.checked)} />{t.onlyRevision(revision)}</label>
      </Allowed>
    </section>
  );
}
