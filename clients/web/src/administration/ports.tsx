// The serial ports: how each line is, its test, its monitor, its recording, and its settings.
import { useState } from 'preact/hooks';
import type { Port, PortTest, Ports as PortList } from '../../generated/api';
import { get, pathOf, send } from '../api/request';
import { Allowed, refusalText, useRefusal } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { Loading } from '../parts/loading';
import { SureButton } from '../parts/sure_button';
import { useRefreshed } from '../parts/use_refreshed';
import { download } from '../programs/download';
import { bytesText, dateTimeText, texts } from '../texts/texts';
import { LineMonitor } from './line_monitor';
import { PortForm } from './port_form';
import { PortTransfer, RulesTest, TransferState } from './port_transfer';

const kIntervalMs = 3000;

type Part = 'monitor' | 'settings' | 'transfer' | 'rules';

/// The control asked for a program while no run waited.
function Request({ request }: { request: NonNullable<Port['request']> }) {
  const t = texts().ports;
  return (
    <p class="notice warn">
      {t.asked(request.program ?? t.anyProgram, dateTimeText(request.since))} {request.answer ?? t.asksStill}
    </p>
  );
}

function PortCard({ port, onChanged }: { port: Port; onChanged: () => void }) {
  const t = texts().administration;
  const command = useCommand();
  const refusal = useRefusal('administer');
  const isOff = command.isBusy || refusal !== null;
  const [test, setTest] = useState<PortTest | null>(null);
  const [shown, setShown] = useState<Part | null>(null);
  const run = () => command.send(async () => setTest(await send<PortTest>('POST', pathOf('ports', port.name, 'test'))));
  const remove = async () => {
    if (await command.send(() => send('DELETE', pathOf('ports', port.name)))) onChanged();
  };
  const toggle = (part: Part) => setShown(shown === part ? null : part);
  const line = port.line;
  return (
    <li class="panel">
      <div class="head">
        <h3>{port.name}</h3>
        <span class={`pill ${port.open ? 'running' : port.enabled ? 'alarm' : 'offline'}`}>{port.open ? t.phases[line.phase] : port.enabled ? t.closed : t.disabled}</span>
      </div>
      <p class="muted">{port.machine} · {port.address}{port.template && ` · ${port.template}`}</p>
      {port.fault && <p class="message">{port.fault}</p>}
      {port.request && <Request request={port.request} />}
      <p>{t.passed(bytesText(port.sent), bytesText(port.received))}{line.waiting_for && ` · ${t.waitsFor(line.waiting_for)}`}</p>
      <p class="buttons">
        <button type="button" disabled={isOff} onClick={() => void run()}>{t.test}</button>
        <button type="button" aria-pressed={shown === 'monitor'} onClick={() => toggle('monitor')}>{t.monitor}</button>
        <button type="button" aria-pressed={shown === 'transfer'} onClick={() => toggle('transfer')}>{texts().ports.transfer}</button>
        {port.rules !== null && <button type="button" aria-pressed={shown === 'rules'} onClick={() => toggle('rules')}>{texts().ports.testRules}</button>}
        <button type="button" aria-pressed={shown === 'settings'} onClick={() => toggle('settings')}>{t.change}</button>
        <button type="button" onClick={() => void command.send(() => download(pathOf('ports', port.name, 'recording'), `${port.name}.jsonl`))}>{t.recording}</button>
        <SureButton class="danger" label={t.remove} question={t.removeSure(port.name)} disabled={isOff} onSure={() => void remove()} />
      </p>
      {refusal !== null && <p class="hint">{refusalText(refusal)}</p>}
      {test && (
        <div class={`notice ${test.passed ? '' : 'bad'}`} role="status">
          <b>{test.passed ? t.testPassed : t.testFailed}</b>
          <ul>{test.findings.map((finding) => <li key={finding}>{finding}</li>)}</ul>
        </div>
      )}
      <CommandFault command={command} />
      {shown === 'monitor' && <LineMonitor port={port.name} />}
      {(shown === 'transfer' || port.transfer?.state === 'sending') && <PortTransfer port={port} onChanged={onChanged} />}
      {shown !== 'transfer' && [port.transfer, port.reception].map((one) => one?.state === 'interrupted' && <TransferState key={one.id} transfer={one} />)}
      {shown === 'rules' && <RulesTest port={port.name} />}
      {shown === 'settings' && <Allowed to="administer"><PortForm port={port} onStored={() => { setShown(null); onChanged(); }} /></Allowed>}
    </li>
  );
}

export function Ports() {
  const t = texts().administration;
  const ports = useRefreshed((signal) => get<PortList>(pathOf('ports'), {}, signal), () => kIntervalMs);
  const [count, setCount] = useState(0); // an empty form after each port
  return (
    <section aria-labelledby="ports">
      <h2 id="ports">{t.ports}</h2>
      <Loading of={ports} />
      {ports.value?.ports.length === 0 && <p class="muted">{t.noPorts}</p>}
      <ul class="list">{(ports.value?.ports ?? []).map((port) => <PortCard key={port.name} port={port} onChanged={ports.reload} />)}</ul>
      <details>
        <summary class="button">{t.add}</summary>
        <div class="panel"><Allowed to="administer"><PortForm key={count} port={null} onStored={() => { setCount(count + 1); ports.reload(); }} /></Allowed></div>
      </details>
    </section>
  );
}
