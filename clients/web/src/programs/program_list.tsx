// The programs of the server: search, upload, and a link to each.
import { useState } from 'preact/hooks';
import { addressOf } from '../app/route';
import { feed } from '../live/feed';
import { Allowed, useRefusal } from '../parts/allowed';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { RevisionPill } from '../parts/revision_pill';
import { useLoaded } from '../parts/use_loaded';
import { bytesText, dateTimeText, texts } from '../texts/texts';
import { DropArea } from './drop_area';
import { loadPrograms, searchPrograms } from './list';
import { UploadRow } from './upload_row';

const kShown = 200;

export function ProgramList() {
  const t = texts().programs;
  const [search, setSearch] = useState('');
  const [files, setFiles] = useState<Array<{ key: number; file: File }>>([]);
  const isRefused = useRefusal('program') !== null;
  const programs = useLoaded(loadPrograms, []);
  const found = searchPrograms(programs.value ?? [], search);
  const controls = [...new Set([...(programs.value ?? []), ...feed.machines.values()].map((known) => known.control).filter((c) => c !== null))].sort();
  const take = (added: File[]) => {
    if (!isRefused) setFiles((before) => [...before, ...added.map((file, i) => ({ key: before.length + i, file }))]);
  };
  return (
    <>
      <h1>{t.title}</h1>
      <Allowed to="program"><DropArea onFiles={take} /></Allowed>
      <ul class="list uploads" aria-label={t.uploads}>
        {files.map(({ key, file }) => <UploadRow key={key} file={file} controls={controls} onStored={programs.reload} />)}
      </ul>
      <div class="tools">
        <label class="search">
          <span class="visually-hidden">{t.search}</span>
          <input type="search" placeholder={t.searchHint} value={search} onInput={(e) => setSearch(e.currentTarget.value)} />
        </label>
        {programs.value && <span class="muted" role="status">{t.count(found.length, programs.value.length)}</span>}
      </div>
      <Loading of={programs} />
      <div class="scroll" tabIndex={0} role="region" aria-label={t.title}>
        <table class="data">
          <Heads of={[t.name, t.programTitle, t.control, t.revision, t.state, t.size, t.storedAt, t.author]} />
          <tbody>
            {found.slice(0, kShown).map((p) => (
              <tr key={p.name}>
                <th scope="row"><a class="target" href={addressOf('programs', [p.name])}>{p.name}</a></th>
                <td>{p.title}</td>
                <td>{p.control}</td>
                <td>{p.revision}</td>
                <td class="pills">{!p.held && <RevisionPill revision={p} />}{p.held_revisions > 0 && <span class="pill waiting">{t.pending(p.held_revisions)}</span>}</td>
                <td>{bytesText(p.size)}</td>
                <td>{dateTimeText(p.created)}</td>
                <td>{p.author}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {found.length > kShown && <p class="muted">{t.onlyFirst(kShown)}</p>}
    </>
  );
}
