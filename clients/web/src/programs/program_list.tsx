// The programs of the server: search of all that is known of them and of their texts, filters, upload, and a link to each. What is chosen is in the address.
import { useEffect, useState } from 'preact/hooks';
import { addressOf } from '../app/route';
import { feed } from '../live/feed';
import { Allowed, useRefusal } from '../parts/allowed';
import { useLoaded } from '../parts/use_loaded';
import { texts } from '../texts/texts';
import { DropArea } from './drop_area';
import { ProgramFilters } from './program_filters';
import { ProgramTable } from './program_table';
import { filtersOf, listPrograms, type Filter } from './search';
import { SearchHits, useSlow } from './search_hits';
import { UploadRow } from './upload_row';

export function ProgramList({ query }: { query: URLSearchParams }) {
  const t = texts().programs;
  const [files, setFiles] = useState<Array<{ key: number; file: File }>>([]);
  const isRefused = useRefusal('program') !== null;
  const filters = filtersOf(query);
  const replaced = query.has('replaced');
  const [typed, setTyped] = useState(query.get('words') ?? '');
  const words = useSlow(typed).trim();
  const choose = (changed: Record<string, string>) =>
    location.replace(addressOf('programs', [], { ...filters, words: typed.trim(), replaced: replaced ? '1' : '', ...changed }));
  useEffect(() => { if (words !== (query.get('words') ?? '')) choose({ words }); }, [words]);
  const programs = useLoaded((signal) => listPrograms(filters, '', signal), Object.values(filters));
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
          <input type="search" placeholder={t.searchHint} value={typed} onInput={(e) => setTyped(e.currentTarget.value)} />
        </label>
        {words !== '' && <label class="check"><input type="checkbox" checked={replaced} onChange={(e) => choose({ replaced: e.currentTarget.checked ? '1' : '' })} />{texts().library.replaced}</label>}
      </div>
      <ProgramFilters filters={filters} shown={programs.value ?? []} onFilter={(filter: Filter, value) => choose({ [filter]: value })} />
      {words === '' ? <ProgramTable first={programs} filters={filters} /> : <SearchHits typed={words} filters={filters} replaced={replaced} />}
    </>
  );
}
