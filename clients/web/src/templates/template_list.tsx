// Every template with what it is for; a new one begins with its name.
import { useState } from 'preact/hooks';
import type { ReportTemplates } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { Allowed } from '../parts/allowed';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, texts } from '../texts/texts';
import { ofTemplate, useAssignments } from './use_templates';

const kMaxName = 64;

function NewTemplate() {
  const t = texts().templates;
  const [name, setName] = useState('');
  const begin = (event: Event) => {
    event.preventDefault();
    location.hash = addressOf('templates', [name.trim()]);
  };
  return (
    <form class="panel" onSubmit={begin}>
      <Allowed to="program">
        <label>{t.name}<input required maxLength={kMaxName} pattern=".*\S.*" autocomplete="off" autocapitalize="none" placeholder={t.nameHint} value={name} onInput={(e) => setName(e.currentTarget.value)} /></label>
        <p class="buttons"><button type="submit" class="primary">{t.makeNamed}</button></p>
      </Allowed>
    </form>
  );
}

export function TemplateList() {
  const t = texts().templates;
  const templates = useLoaded((signal) => get<ReportTemplates>(pathOf('report-templates'), {}, signal), []);
  const assignments = useAssignments();
  const usesOf = (name: string) => ofTemplate(assignments.value?.assignments ?? [], name).map(({ scope, subject }) => t.assignedTo(t.scopes[scope], subject));
  return (
    <>
      <p class="hint">{t.hint}</p>
      <Loading of={templates} />
      {assignments.fault !== null && <Loading of={assignments} />}
      {templates.value?.templates.length === 0 && <p class="notice">{t.none}</p>}
      {templates.value && templates.value.templates.length > 0 && (
        <div class="scroll" tabIndex={0} role="region" aria-label={t.all}>
          <table class="data">
            <Heads of={[t.name, t.version, t.usedFor, t.by, t.saved]} />
            <tbody>
              {templates.value.templates.map(({ name, version, author, created }) => (
                <tr key={name}>
                  <th scope="row"><a class="target" href={addressOf('templates', [name])}>{name}</a></th>
                  <td>{version}</td>
                  <td>{assignments.value && (usesOf(name).join(', ') || <span class="muted">{t.unused}</span>)}</td>
                  <td>{author}</td>
                  <td>{dateTimeText(created)}</td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
      <details>
        <summary class="button">{t.make}</summary>
        <NewTemplate />
      </details>
    </>
  );
}
