// Adds a port, or replaces one. The template gives a control's usual line; what is written here overrides it. Beside it is what each setting
// decides, and the value in force.
import { useState } from 'preact/hooks';
import type { Port, PortTemplates } from '../../generated/api';
import { get, pathOf, send } from '../api/request';
import { CommandFault, useCommand } from '../parts/command';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { texts } from '../texts/texts';
import { readSettings, readTypedSettings, shownSettings, unknownSettings } from './port_settings';

function Decides({ templates, template, own }: { templates: PortTemplates; template: string; own: Record<string, string> }) {
  const t = texts().ports;
  const shown = shownSettings(templates.settings, templates.templates.find((row) => row.name === template), own);
  const unknown = unknownSettings(templates.settings, own);
  return (
    <details>
      <summary class="button">{t.decides}</summary>
      {unknown.length > 0 && <p class="notice warn">{t.unknownSettings(unknown.join(', '))}</p>}
      <div class="scroll settings-table" tabIndex={0} role="region" aria-label={t.decides}>
        <table>
          <Heads of={[t.setting, t.value, t.valueFrom, t.meaning]} />
          <tbody>
            {shown.map((row) => (
              <tr key={row.key} class={row.from}>
                <th scope="row" class="mono">{row.key}</th>
                <td class="mono">{row.value ?? '–'}</td>
                <td>{t.origins[row.from]}</td>
                <td>{row.text} <span class="muted">({row.type})</span></td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </details>
  );
}

export function PortForm({ port, onStored }: { port: Port | null; onStored: () => void }) {
  const t = texts().administration;
  const templates = useLoaded((signal) => get<PortTemplates>(pathOf('port-templates'), {}, signal), []);
  const command = useCommand();
  const [name, setName] = useState(port?.name ?? '');
  const [machine, setMachine] = useState(port?.machine ?? '');
  const [address, setAddress] = useState(port?.address ?? '');
  const [template, setTemplate] = useState(port?.template ?? '');
  const [settings, setSettings] = useState(Object.entries(port?.settings ?? {}).map(([key, value]) => `${key} = ${value}`).join('\n'));
  const [rules, setRules] = useState(port?.rules ?? '');
  const [isEnabled, setEnabled] = useState(port?.enabled ?? true);
  const store = async (event: Event) => {
    event.preventDefault();
    const isStored = await command.send(() => send('PUT', pathOf('ports', name), { json: {
      machine, address, ...(template !== '' && { template }), settings: readSettings(settings, t.notASetting), enabled: isEnabled,
      ...(rules.trim() !== '' && { rules }),
    } }));
    if (isStored) onStored();
  };
  return (
    <form onSubmit={(event) => void store(event)}>
      <label>{t.name}<input required value={name} disabled={port !== null} onInput={(e) => setName(e.currentTarget.value)} /></label>
      <label>{t.machine}<input required value={machine} onInput={(e) => setMachine(e.currentTarget.value)} /></label>
      <label>{t.address}<input required value={address} placeholder="/dev/ttyUSB0, tcp://host:port, rfc2217://host:port" onInput={(e) => setAddress(e.currentTarget.value)} /></label>
      <p class="hint">{texts().ports.doctor} <span class="mono">dnc port doctor {address || '/dev/ttyUSB0'}</span></p>
      <label>
        {t.template}
        <select value={template} onChange={(e) => setTemplate(e.currentTarget.value)}>
          <option value="">–</option>
          {(templates.value?.templates ?? []).map((row) => <option key={row.name} value={row.name}>{row.name} · {row.title}</option>)}
        </select>
      </label>
      <Loading of={templates} />
      <label>{t.settings}<textarea rows={4} spellcheck={false} placeholder="line = 9600e72" value={settings} onInput={(e) => setSettings(e.currentTarget.value)} /></label>
      {templates.value && <Decides templates={templates.value} template={template} own={readTypedSettings(settings)} />}
      <label>{texts().ports.rules}<textarea rows={3} spellcheck={false} value={rules} onInput={(e) => setRules(e.currentTarget.value)} /></label>
      <label class="check"><input type="checkbox" checked={isEnabled} onChange={(e) => setEnabled(e.currentTarget.checked)} />{t.enabled}</label>
      <p class="buttons"><button type="submit" class="primary" disabled={command.isBusy}>{t.store}</button></p>
      <CommandFault command={command} />
    </form>
  );
}
