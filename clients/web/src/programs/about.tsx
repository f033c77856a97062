// What a program is for (part, operation, material, machine group), and the CAM file of the revision that is shown: read, and changed.
import { useState } from 'preact/hooks';
import type { MachineGroups, ProgramWithRevisions, Revision } from '../../generated/api';
import { get, pathOf, send } from '../api/request';
import { addressOf } from '../app/route';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { Disclosure } from '../parts/disclosure';
import { useLoaded } from '../parts/use_loaded';
import { texts } from '../texts/texts';
import { changeOf, fieldsOf, kFields, kProgramFields, type Field, type Fields } from './fields';

const kMaxLength = 200;

/// A value leads to the programs that have it too.
function Value({ field, value }: { field: Field; value: string }) {
  if (value === '') return <>–</>;
  return field === 'cam_file' ? <span class="record-text">{value}</span> : <a href={addressOf('programs', [], { [field]: value })}>{value}</a>;
}

function AboutForm({ program, shown, onStored }: { program: ProgramWithRevisions; shown: Revision; onStored: () => void }) {
  const t = texts().library;
  const command = useCommand();
  const before = fieldsOf({ ...program, cam_file: shown.cam_file });
  const [fields, setFields] = useState<Fields>(before);
  const groups = useLoaded((signal) => get<MachineGroups>(pathOf('machine-groups'), {}, signal), []);
  const change = changeOf(before, fields, shown.revision);
  const store = async (event: Event) => {
    event.preventDefault();
    if (await command.send(() => send('PUT', pathOf('programs', program.name, 'fields'), { json: change }))) onStored();
  };
  return (
    <form onSubmit={(event) => void store(event)}>
      <Allowed to="program">
        {kFields.map((field) => (
          <label key={field}>
            {t.fields[field]}
            <input maxLength={kMaxLength} autocomplete="off" {...(field === 'machine_group' && { list: 'field-groups' })} value={fields[field]}
              onInput={(e) => setFields({ ...fields, [field]: e.currentTarget.value })} />
          </label>
        ))}
        <datalist id="field-groups">{(groups.value?.groups ?? []).map(({ name }) => <option key={name} value={name} />)}</datalist>
        <p class="hint">{t.camFileOf(shown.revision)}</p>
        <p class="buttons"><button type="submit" class="primary" disabled={change === null || command.isBusy}>{t.store}</button></p>
      </Allowed>
      <CommandFault command={command} />
    </form>
  );
}

export function About({ program, shown, onStored }: { program: ProgramWithRevisions; shown: Revision; onStored: () => void }) {
  const t = texts().library;
  const [count, setCount] = useState(0); // a form with the stored values after each change
  const fields = fieldsOf({ ...program, cam_file: shown.cam_file });
  return (
    <section class="panel" aria-labelledby="about">
      <h2 id="about">{t.about}</h2>
      <dl class="rows">
        {[...kProgramFields, 'cam_file' as const].map((field) => <div key={field}><dt>{t.fields[field]}</dt><dd><Value field={field} value={fields[field]} /></dd></div>)}
      </dl>
      <Disclosure key={count} summary={t.change}><AboutForm program={program} shown={shown} onStored={() => { setCount(count + 1); onStored(); }} /></Disclosure>
    </section>
  );
}
