// The setup of a machine: tools, offsets and variables in tables, all of it as text, its versions, and what a change changes. A change is
// made from one revision: if another user was faster the server refuses it, and both are shown.
import { useEffect, useState } from 'preact/hooks';
import type { Setup } from '../../../generated/api';
import { ApiError, get, getIfThere, pathOf, send, withQuery } from '../../api/request';
import { addressOf } from '../../app/route';
import { useFeed } from '../../live/use_feed';
import { Allowed } from '../../parts/allowed';
import { CommandFault, useCommand } from '../../parts/command';
import { DiffView } from '../../parts/diff_view';
import { Loading } from '../../parts/loading';
import { useLoaded } from '../../parts/use_loaded';
import { dateTimeText, texts } from '../../texts/texts';
import { LoadedSetup } from './loaded_setup';
import { SetupTable } from './setup_table';
import { kTables } from './setup_tables';

const kNone: Setup = { machine: '', revision: 0, size: 0, sha256: '', comment: null, author: null, created: '', text: '' };

/// A machine without a setup has an empty one, revision 0.
async function loadSetup(machine: string, revision: number | null, signal?: AbortSignal): Promise<Setup> {
  const path = pathOf('machines', machine, 'setup');
  if (revision !== null) return get<Setup>(path, { revision }, signal);
  return (await getIfThere<Setup>(path, {}, signal)) ?? kNone;
}

function Versions({ machine, newest, onRestore }: { machine: string; newest: Setup; onRestore: (text: string) => void }) {
  const t = texts().setup;
  const [shown, setShown] = useState<Setup | null>(null);
  const versions = useLoaded((signal) => get<{ setups: Setup[] }>(pathOf('machines', machine, 'setups'), { limit: 50 }, signal), [machine, newest.revision]);
  const command = useCommand();
  const show = (revision: number) => void command.send(async () => setShown(await loadSetup(machine, revision)));
  return (
    <section class="panel" aria-labelledby="versions">
      <h2 id="versions">{t.versions}</h2>
      <Loading of={versions} />
      <ul class="list">
        {(versions.value?.setups ?? []).map((setup) => (
          <li key={setup.revision} class="version">
            <b>{setup.revision}</b> <span>{dateTimeText(setup.created)} · {setup.author ?? '–'}{setup.comment && ` · ${setup.comment}`}</span>
            <button type="button" aria-pressed={shown?.revision === setup.revision} onClick={() => show(setup.revision)}>{t.compare}</button>
          </li>
        ))}
      </ul>
      <CommandFault command={command} />
      {shown && (
        <>
          <h3>{t.compared(shown.revision, newest.revision)}</h3>
          <DiffView before={shown.text ?? ''} after={newest.text ?? ''} />
          <button type="button" onClick={() => onRestore(shown.text ?? '')}>{t.takeOver(shown.revision)}</button>
        </>
      )}
    </section>
  );
}

export function MachineSetup({ machine }: { machine: string }) {
  const t = texts().setup;
  const setup = useLoaded((signal) => loadSetup(machine, null, signal), [machine]);
  const hasLine = useFeed('machines').machines.get(machine)?.starts.head === true;
  /// The revision from which the text is made.
  const [base, setBase] = useState<Setup | null>(null);
  const [text, setText] = useState('');
  const [comment, setComment] = useState('');
  const [newer, setNewer] = useState<Setup | null>(null);
  const command = useCommand();
  const begin = (from: Setup) => {
    setBase(from);
    setText(from.text ?? '');
    setNewer(null);
  };
  useEffect(() => {
    if (setup.value && (base === null || text === base.text)) begin(setup.value); // nothing of the user's is lost by it
  }, [setup.value]);
  const store = () => command.send(async () => {
    try {
      await send('PUT', withQuery(pathOf('machines', machine, 'setup'), { base: base!.revision, comment }), { raw: text });
    } catch (failure) {
      if (failure instanceof ApiError && failure.status === 409) setNewer(await loadSetup(machine, null));
      throw failure;
    }
    setComment('');
    begin(await loadSetup(machine, null));
  });
  if (!base) return <Loading of={setup} />;
  const isChanged = text !== (base.text ?? '');
  return (
    <>
      <p class="muted">{base.revision === 0 ? t.none : (hasLine ? t.revisionAtLine : t.revision)(base.revision, dateTimeText(base.created), base.author ?? '–')} <a href={addressOf('corrections', [machine])}>{t.history}</a></p>
      {hasLine && base.revision > 0 && <LoadedSetup machine={machine} newest={base.revision} />}
      {kTables.map((table) => <SetupTable key={table} table={table} text={text} onChange={setText} />)}
      <section class="panel" aria-labelledby="setup-text">
        <h2 id="setup-text">{t.text}</h2>
        <textarea rows={14} spellcheck={false} aria-labelledby="setup-text" value={text} onInput={(e) => setText(e.currentTarget.value)} />
        {isChanged && <><h3>{t.changes}</h3><DiffView before={base.text ?? ''} after={text} /></>}
        {newer && (
          <div class="notice warn">
            <p>{t.newer(newer.revision, newer.author ?? '–')}</p>
            <DiffView before={base.text ?? ''} after={newer.text ?? ''} />
            <button type="button" onClick={() => { setBase(newer); setNewer(null); }}>{t.keepMine(newer.revision)}</button>
            <button type="button" onClick={() => begin(newer)}>{t.takeTheirs}</button>
          </div>
        )}
        <label>{t.comment}<input name="comment" maxLength={1024} value={comment} onInput={(e) => setComment(e.currentTarget.value)} /></label>
        <Allowed to="set_up" machine={machine}><p class="buttons">
          <button type="button" class="primary" disabled={!isChanged || command.isBusy} onClick={() => void store()}>{t.store}</button>
          <button type="button" disabled={!isChanged} onClick={() => setText(base.text ?? '')}>{t.discard}</button>
        </p></Allowed>
        <CommandFault command={command} />
      </section>
      <Versions machine={machine} newest={base} onRestore={setText} />
    </>
  );
}
