// One template: a version of its text, changed and stored as the next one; what it is for; and what it makes of a run.
import { useEffect, useState } from 'preact/hooks';
import type { ReportTemplate, ReportTemplateText } from '../../generated/api';
import { pathOf, send } from '../api/request';
import { addressOf } from '../app/route';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { DiffView } from '../parts/diff_view';
import { Loading } from '../parts/loading';
import { SureButton } from '../parts/sure_button';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, texts } from '../texts/texts';
import { Assignments } from './assignments';
import { Trial } from './trial';
import { loadTemplate, useAssignments, versionsUpTo } from './use_templates';

const kRows = 18;
const kMaxText = 262_144;

interface Loaded {
  /// null: nothing is stored yet.
  newest: ReportTemplateText | null;
  /// The version that is shown.
  shown: ReportTemplateText | null;
}

async function load(name: string, version: number | null, signal: AbortSignal): Promise<Loaded> {
  const newest = await loadTemplate(name, null, signal);
  const isOlder = newest !== null && version !== null && version !== newest.version;
  return { newest, shown: isOlder ? await loadTemplate(name, version, signal) : newest };
}

function Versions({ name, newest, shown }: { name: string; newest: ReportTemplateText; shown: ReportTemplateText }) {
  const t = texts().templates;
  const go = (version: string) => location.replace(addressOf('templates', [name], { version: Number(version) === newest.version ? '' : version }));
  return (
    <div class="head">
      <p class="muted">{t.versionOf(shown.version, shown.author, dateTimeText(shown.created))}</p>
      <label class="inline">
        {t.version}{' '}
        <select value={shown.version} onChange={(e) => go(e.currentTarget.value)}>
          {versionsUpTo(newest.version).map((version) => <option key={version} value={version}>{version}</option>)}
        </select>
      </label>
    </div>
  );
}

/// What the typed text was made from, and the newest version at that time; 0: there was none.
interface Base {
  text: string;
  newest: number;
}

interface EditProps extends Loaded {
  name: string;
  base: Base;
  text: string;
  onText: (text: string) => void;
  onStored: (version: number) => void;
}

/// What a store has come to; no version is lost by it, but another user's may have come between.
function outcomeText(stored: ReportTemplate, { newest }: Base): string {
  const t = texts().templates;
  if (stored.version === newest) return t.unchanged;
  return stored.version === newest + 1 ? t.storedAs(stored.version) : t.notAlone(stored.version, newest);
}

function Edit({ name, newest, shown, base, text, onText, onStored }: EditProps) {
  const t = texts().templates;
  const command = useCommand();
  const [outcome, setOutcome] = useState('');
  const store = () => command.send(async () => {
    setOutcome('');
    const stored = await send<ReportTemplate>('PUT', pathOf('report-templates', name), { raw: text });
    setOutcome(outcomeText(stored, base));
    onStored(stored.version);
  });
  return (
    <section class="panel" aria-labelledby="template-text">
      <h2 id="template-text">{t.text}</h2>
      {newest && shown && <Versions name={name} newest={newest} shown={shown} />}
      {newest && shown && shown.version !== newest.version && (
        <>
          <p class="notice warn">{t.older(newest.version)}</p>
          <h3>{t.compared(shown.version, newest.version)}</h3>
          <DiffView before={shown.text} after={newest.text} />
        </>
      )}
      <textarea rows={kRows} maxLength={kMaxText} spellcheck={false} aria-labelledby="template-text" value={text} onInput={(e) => onText(e.currentTarget.value)} />
      {newest !== null && text !== base.text && <><h3>{t.changes}</h3><DiffView before={base.text} after={text} /></>}
      <Allowed to="program">
        <p class="buttons">
          <button type="button" class="primary" disabled={text.trim() === '' || text === newest?.text || command.isBusy} onClick={() => void store()}>{t.store}</button>
          <button type="button" disabled={text === base.text} onClick={() => onText(base.text)}>{t.discard}</button>
        </p>
      </Allowed>
      {outcome !== '' && <p class="notice" role="status">{outcome}</p>}
      <CommandFault command={command} />
    </section>
  );
}

function Remove({ name }: { name: string }) {
  const t = texts().templates;
  const command = useCommand();
  const remove = async () => {
    if (await command.send(() => send('DELETE', pathOf('report-templates', name)))) location.hash = addressOf('templates');
  };
  return (
    <section class="panel" aria-label={t.remove}>
      <p class="hint">{t.removeHint}</p>
      <Allowed to="program"><p class="buttons"><SureButton class="danger" label={t.remove} question={t.removeSure(name)} disabled={command.isBusy} onSure={() => void remove()} /></p></Allowed>
      <CommandFault command={command} />
    </section>
  );
}

export function TemplatePage({ name, query }: { name: string; query: URLSearchParams }) {
  const t = texts().templates;
  const version = Number(query.get('version')) || null;
  const loaded = useLoaded((signal) => load(name, version, signal), [name, version]);
  const assignments = useAssignments();
  const [{ text, base }, setEdited] = useState<{ text: string; base: Base }>({ text: '', base: { text: '', newest: 0 } });
  const setText = (typed: string) => setEdited((now) => ({ ...now, text: typed }));
  const { value } = loaded;
  useEffect(() => {
    if (!value) return;
    const next = value.shown?.text ?? '';
    const read = { text: next, base: { text: next, newest: value.newest?.version ?? 0 } };
    // What was typed stays when the template is read again; also what was typed since the picture that this belongs to.
    setEdited((now) => (now.text === now.base.text ? read : now));
  }, [value]);
  const take = (stored: number) => {
    setEdited((now) => ({ text: now.text, base: { text, newest: stored } }));
    if (version !== null) location.replace(addressOf('templates', [name])); // the newest is shown, which was stored now
    else loaded.reload();
  };
  return (
    <>
      <p class="back"><a href={addressOf('templates')}>← {t.all}</a></p>
      <div class="machine-head"><h1>{name}</h1></div>
      <Loading of={loaded} />
      {value && (
        <div class="program-columns">
          <div>
            {!value.newest && <p class="notice">{t.notStored}</p>}
            <Edit name={name} newest={value.newest} shown={value.shown} base={base} text={text} onText={setText} onStored={take} />
            <Trial text={text} asked={query.get('run') ?? ''} assignments={assignments.value?.assignments.filter(({ template }) => template === name) ?? []} />
          </div>
          <div>
            {value.newest && <Assignments name={name} newest={value.newest.version} assignments={assignments} />}
            {value.newest && <Remove name={name} />}
          </div>
        </div>
      )}
    </>
  );
}
