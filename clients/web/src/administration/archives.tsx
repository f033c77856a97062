// What retention has moved out of the database: the rules in force, each archive with its state, and its rows, read back.
import { useState } from 'preact/hooks';
import type { Archive, Archives, ArchivesMade, RetentionRule } from '../../generated/api';
import { getIfThere, pathOf, send } from '../api/request';
import { CommandFault, useCommand } from '../parts/command';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { Pages } from '../parts/pages';
import { Rows } from '../parts/rows';
import { SureButton } from '../parts/sure_button';
import { useLoaded } from '../parts/use_loaded';
import { bytesText, dateTimeText, numberText, texts } from '../texts/texts';
import { ArchivedRows } from './archived_rows';

const kPage = 100;

/// null: this server makes no archives.
async function load(offset: number, signal: AbortSignal): Promise<{ state: Archives | null }> {
  return { state: await getIfThere<Archives>(pathOf('archives'), { limit: kPage, offset }, signal) };
}

function ruleText({ days, rows }: RetentionRule): string {
  const t = texts().archives;
  const limits = [days !== null && t.days(numberText(days)), rows !== null && t.rows(numberText(rows))].filter(Boolean);
  return limits.length === 0 ? t.forEver : limits.join(', ');
}

function Row({ archive, isShown, onShow }: { archive: Archive; isShown: boolean; onShow: () => void }) {
  const t = texts().archives;
  return (
    <tr>
      <th scope="row" class="mono">{archive.file}</th>
      <td>{t.kinds[archive.kind]}</td>
      <td>{archive.machine ?? texts().floor.all}</td>
      <td>{dateTimeText(archive.first)} – {dateTimeText(archive.last)}</td>
      <td class="number">{numberText(archive.rows)}</td>
      <td class="number">{bytesText(archive.bytes)}</td>
      <td><span class={`pill ${archive.removed ? 'done' : 'waiting'}`}>{archive.removed ? t.removed : t.removing}</span></td>
      <td><button type="button" aria-pressed={isShown} aria-label={t.readOf(archive.file)} onClick={onShow}>{t.read}</button></td>
    </tr>
  );
}

function Table({ archives }: { archives: Archive[] }) {
  const t = texts().archives;
  const [shown, setShown] = useState<Archive | null>(null);
  return (
    <>
      <div class="scroll" tabIndex={0} role="group" aria-labelledby="archives">
        <table class="data">
          <Heads of={[t.file, t.kind, texts().administration.machine, t.span, t.rowsHead, t.size, t.state, t.actions]} />
          <tbody>{archives.map((one) => <Row key={one.id} archive={one} isShown={shown?.id === one.id} onShow={() => setShown(shown?.id === one.id ? null : one)} />)}</tbody>
        </table>
      </div>
      {shown && <ArchivedRows key={shown.id} archive={shown} />}
    </>
  );
}

function Apply({ onMade }: { onMade: () => void }) {
  const t = texts().archives;
  const command = useCommand();
  const [made, setMade] = useState<number | null>(null);
  const apply = () => void command.send(async () => {
    setMade(null);
    setMade((await send<ArchivesMade>('POST', pathOf('archives'))).made);
    onMade();
  });
  return (
    <>
      <p class="buttons"><SureButton label={t.apply} question={t.applySure} disabled={command.isBusy} onSure={apply} /></p>
      <CommandFault command={command} />
      {made !== null && <p class="notice" role="status">{t.made(made)}</p>}
    </>
  );
}

export function ArchiveList() {
  const t = texts().archives;
  const [offset, setOffset] = useState(0);
  const archives = useLoaded((signal) => load(offset, signal), [offset]);
  const state = archives.value?.state;
  return (
    <section class="panel" aria-labelledby="archives">
      <h2 id="archives">{t.title}</h2>
      <Loading of={archives} />
      {archives.value && !state && <p class="notice warn">{t.off}</p>}
      {state && (
        <>
          <p class="hint">{t.hint}</p>
          <Rows of={[[t.kinds.records, ruleText(state.retention.records)], [t.kinds.measurements, ruleText(state.retention.measurements)], [t.folder, state.retention.folder]]} />
          <Apply onMade={archives.reload} />
          {state.archives.length === 0 ? <p class="muted">{t.none}</p> : <Table archives={state.archives} />}
          {(offset > 0 || state.archives.length === kPage) && <Pages offset={offset} size={kPage} count={state.archives.length} onOffset={setOffset} />}
        </>
      )}
    </section>
  );
}
