// The programs by name, page after page.
import { useEffect, useState } from 'preact/hooks';
import type { Program } from '../../generated/api';
import { addressOf } from '../app/route';
import { CommandFault, useCommand } from '../parts/command';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { RevisionPill } from '../parts/revision_pill';
import type { Loaded } from '../parts/use_loaded';
import { bytesText, dateTimeText, texts } from '../texts/texts';
import { kPage, listPrograms, type Filters } from './search';

function Row({ program: p }: { program: Program }) {
  const t = texts().programs;
  const fields = [p.part, p.operation, p.material].filter((field) => field !== null);
  return (
    <tr>
      <th scope="row"><a class="target" href={addressOf('programs', [p.name])}>{p.name}</a></th>
      <td>{p.title}{fields.length > 0 && <span class="muted block">{fields.join(' · ')}</span>}</td>
      <td>{p.control}</td>
      <td>{p.revision}</td>
      <td class="pills">{!p.held && <RevisionPill revision={p} />}{p.held_revisions > 0 && <span class="pill waiting">{t.pending(p.held_revisions)}</span>}</td>
      <td>{bytesText(p.size)}</td>
      <td>{dateTimeText(p.created)}</td>
      <td>{p.author}</td>
    </tr>
  );
}

export function ProgramTable({ first, filters }: { first: Loaded<Program[]>; filters: Filters }) {
  const t = texts().programs;
  const loading = useCommand();
  const [more, setMore] = useState<Program[]>([]);
  useEffect(() => setMore([]), [first.value]);
  const programs = [...(first.value ?? []), ...more];
  const hasMore = programs.length > 0 && programs.length % kPage === 0;
  const loadMore = () => loading.send(async () => {
    const page = await listPrograms(filters, programs[programs.length - 1]!.name, new AbortController().signal);
    setMore([...more, ...page]);
  });
  return (
    <>
      <Loading of={first} />
      {first.value && <p class="muted" role="status">{hasMore ? texts().library.firstPrograms(programs.length) : t.count(programs.length)}</p>}
      <div class="scroll" tabIndex={0} role="region" aria-label={t.title}>
        <table class="data">
          <Heads of={[t.name, t.programTitle, t.control, t.revision, t.state, t.size, t.storedAt, t.author]} />
          <tbody>{programs.map((p) => <Row key={p.name} program={p} />)}</tbody>
        </table>
      </div>
      {hasMore && <p class="buttons"><button type="button" disabled={loading.isBusy} onClick={() => void loadMore()}>{texts().library.more}</button></p>}
      <CommandFault command={loading} />
    </>
  );
}
