// Whose reports a template reads: programs, machines, printing macros; assigned and taken back.
import { useState } from 'preact/hooks';
import type { TemplateAssignment, TemplateAssignments } from '../../generated/api';
import { pathOf, send } from '../api/request';
import { addressOf } from '../app/route';
import { useFeed } from '../live/use_feed';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand, type Command } from '../parts/command';
import { Loading } from '../parts/loading';
import { SureButton } from '../parts/sure_button';
import type { Loaded } from '../parts/use_loaded';
import { dateTimeText, texts } from '../texts/texts';
import { ofTemplate, versionsUpTo } from './use_templates';

const kScopes: Array<TemplateAssignment['scope']> = ['program', 'machine', 'macro'];
const kMaxSubject = 128;

const assignmentPath = (scope: string, subject: string, template: string) => pathOf('report-template-assignments', scope, subject, template);

function Subject({ of }: { of: TemplateAssignment }) {
  const text = texts().templates.assignedTo(texts().templates.scopes[of.scope], of.subject);
  if (of.scope === 'macro') return <b>{text}</b>;
  return <a href={addressOf(of.scope === 'machine' ? 'machine' : 'programs', [of.subject])}>{text}</a>;
}

function Row({ of, command, onChanged }: { of: TemplateAssignment; command: Command; onChanged: () => void }) {
  const t = texts().templates;
  const what = t.assignedTo(t.scopes[of.scope], of.subject);
  const take = async () => {
    if (await command.send(() => send('DELETE', assignmentPath(of.scope, of.subject, of.template)))) onChanged();
  };
  return (
    <li>
      <p><Subject of={of} /> <span class="muted">{of.version === null ? t.newest : t.always(of.version)}</span></p>
      <p class="muted">{of.author}, {dateTimeText(of.created)}</p>
      <SureButton class="danger" label={t.unassign} question={t.unassignSure(what)} disabled={command.isBusy} onSure={() => void take()} />
    </li>
  );
}

function AssignForm({ name, newest, command, onChanged }: { name: string; newest: number; command: Command; onChanged: () => void }) {
  const t = texts().templates;
  const { machines } = useFeed('machines');
  const [scope, setScope] = useState<TemplateAssignment['scope']>('program');
  const [subject, setSubject] = useState('');
  const [version, setVersion] = useState('');
  const assign = async (event: Event) => {
    event.preventDefault();
    const json = version === '' ? {} : { version: Number(version) };
    if (!(await command.send(() => send('PUT', assignmentPath(scope, subject.trim(), name), { json })))) return;
    setSubject('');
    onChanged();
  };
  return (
    <form onSubmit={(event) => void assign(event)}>
      <label>
        {t.scope}
        <select value={scope} onChange={(e) => setScope(e.currentTarget.value as TemplateAssignment['scope'])}>
          {kScopes.map((key) => <option key={key} value={key}>{t.scopes[key]}</option>)}
        </select>
      </label>
      <label>{t.subject}<input required maxLength={kMaxSubject} pattern=".*\S.*" autocomplete="off" {...(scope === 'machine' && { list: 'assignable' })} value={subject} onInput={(e) => setSubject(e.currentTarget.value)} /></label>
      <datalist id="assignable">{[...machines.keys()].sort().map((machine) => <option key={machine} value={machine} />)}</datalist>
      <label>
        {t.version}
        <select value={version} onChange={(e) => setVersion(e.currentTarget.value)}>
          <option value="">{t.newest}</option>
          {versionsUpTo(newest).map((number) => <option key={number} value={number}>{t.always(number)}</option>)}
        </select>
      </label>
      <p class="buttons"><button type="submit" class="primary" disabled={command.isBusy}>{t.assign}</button></p>
    </form>
  );
}

export function Assignments({ name, newest, assignments }: { name: string; newest: number; assignments: Loaded<TemplateAssignments> }) {
  const t = texts().templates;
  const command = useCommand();
  const own = ofTemplate(assignments.value?.assignments ?? [], name);
  return (
    <section class="panel" aria-labelledby="assignments">
      <h2 id="assignments">{t.assignments}</h2>
      <Loading of={assignments} />
      {assignments.value && own.length === 0 && <p class="notice warn">{t.noAssignment}</p>}
      <Allowed to="program">
        <ul class="list assignments">{own.map((one) => <Row key={`${one.scope} ${one.subject}`} of={one} command={command} onChanged={assignments.reload} />)}</ul>
        <AssignForm name={name} newest={newest} command={command} onChanged={assignments.reload} />
      </Allowed>
      <p class="hint">{t.assignHint}</p>
      <CommandFault command={command} />
    </section>
  );
}
