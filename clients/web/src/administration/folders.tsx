// The hot folders: how each is, and what became of its files. They are a setting of the server.
import { useState } from 'preact/hooks';
import type { Folder, FolderFile, FolderFiles, Folders as FolderList } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { Pages } from '../parts/pages';
import { useLoaded } from '../parts/use_loaded';
import { useRefreshed } from '../parts/use_refreshed';
import { bytesText, dateTimeText, numberText, texts } from '../texts/texts';
import { folderTone } from './folder_state';

const kIntervalMs = 5000;
const kPage = 50;
const kFileTones: Record<FolderFile['state'], string> = { taken: 'waiting', stored: 'running', failed: 'alarm' };

function Files({ folder }: { folder: Folder }) {
  const t = texts().folders;
  const [offset, setOffset] = useState(0);
  const files = useLoaded((signal) => get<FolderFiles>(pathOf('folders', folder.name, 'files'), { limit: kPage, offset }, signal), [folder.name, folder.stored, folder.failed, offset]);
  const list = files.value?.files ?? [];
  return (
    <>
      <Loading of={files} />
      {files.value && list.length === 0 && <p class="muted">{t.noFiles}</p>}
      {list.length > 0 && (
        <div class="scroll" tabIndex={0} role="region" aria-label={t.filesOf(folder.name)}>
          <table>
            <Heads of={[t.file, t.state, t.becameOf, t.reason, t.size, t.taken]} />
            <tbody>
              {list.map((file) => (
                <tr key={`${file.name} ${file.taken}`}>
                  <th scope="row" class="record-text">{file.name}</th>
                  <td><span class={`pill ${kFileTones[file.state]}`}>{t.fileStates[file.state]}</span></td>
                  <td>{file.program === null ? '–' : <><a href={addressOf('programs', file.revision === null ? [file.program] : [file.program, String(file.revision)])}>{file.program}</a>{file.revision !== null && <span class="muted"> {file.revision}</span>}</>}</td>
                  <td class="record-text">{file.reason ?? '–'}{file.target !== null && <span class="muted block mono">{file.target}</span>}</td>
                  <td>{bytesText(file.size)}</td>
                  <td>{dateTimeText(file.taken)}</td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
      {(offset > 0 || list.length === kPage) && <Pages offset={offset} size={kPage} count={list.length} onOffset={setOffset} />}
    </>
  );
}

function FolderCard({ folder }: { folder: Folder }) {
  const t = texts().folders;
  const [isOpen, setOpen] = useState(false);
  const tone = folderTone(folder);
  return (
    <li class="panel">
      <div class="head"><h3>{folder.name}</h3><span class={`pill ${tone}`}>{t.tones[tone]}</span></div>
      <p class="muted"><span class="mono record-text">{folder.path}</span>{folder.control !== null && ` · ${folder.control}`}{folder.machine !== null && ` · ${t.forMachine(folder.machine)}`}</p>
      {folder.fault !== null && <p class="notice bad">{folder.fault}</p>}
      <p>{t.counts(numberText(folder.waiting), numberText(folder.stored), numberText(folder.failed))} <span class="muted">{folder.looked === null ? t.notLooked : t.looked(dateTimeText(folder.looked))}</span></p>
      {folder.last_refused !== null && <p class="notice warn"><b>{t.lastRefused(folder.last_refused)}</b> {folder.last_reason}</p>}
      <p class="buttons"><button type="button" aria-expanded={isOpen} aria-pressed={isOpen} onClick={() => setOpen(!isOpen)}>{t.files}</button></p>
      {isOpen && <Files folder={folder} />}
    </li>
  );
}

export function Folders() {
  const t = texts().folders;
  const folders = useRefreshed((signal) => get<FolderList>(pathOf('folders'), {}, signal), () => kIntervalMs);
  return (
    <section aria-labelledby="folders">
      <h2 id="folders">{t.title}</h2>
      <p class="hint">{t.hint}</p>
      <Loading of={folders} />
      {folders.value?.folders.length === 0 && <p class="notice">{t.none}</p>}
      <ul class="list">{(folders.value?.folders ?? []).map((folder) => <FolderCard key={folder.name} folder={folder} />)}</ul>
    </section>
  );
}
