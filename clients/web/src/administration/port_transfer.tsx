// Programs into a control's memory and out of it, without a run; and what the port's rules make of a text that the control sends.
import { useState } from 'preact/hooks';
import type { Port, Programs, RuleVerdict, Transfer } from '../../generated/api';
import { get, pathOf, send } from '../api/request';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { SureButton } from '../parts/sure_button';
import { useLoaded } from '../parts/use_loaded';
import { bytesText, texts } from '../texts/texts';

const kMaxListed = 1000;

export function TransferState({ transfer }: { transfer: NonNullable<Transfer> }) {
  const t = texts().ports;
  const isOver = transfer.state !== 'sending' && transfer.state !== 'receiving';
  return (
    <div class={`notice ${isOver && transfer.state !== 'completed' ? 'bad' : ''}`} role="status">
      <p><b>{t.transferStates[transfer.state]}</b>: {transfer.programs.join(', ')} ({t.sentOf(bytesText(transfer.sent), bytesText(transfer.size))})</p>
      {!isOver && <progress value={transfer.size > 0 ? transfer.sent / transfer.size : 0} max={1} aria-label={t.transferStates.sending} />}
      {transfer.reason !== null && <p>{transfer.reason}</p>}
    </div>
  );
}

/// "O0100, O0200@3": as the API takes them.
export function readNames(text: string): string[] {
  return text.split(/[\s,]+/).filter((name) => name !== '');
}

export function PortTransfer({ port, onChanged }: { port: Port; onChanged: () => void }) {
  const t = texts().ports;
  const command = useCommand();
  const [text, setText] = useState('');
  const programs = useLoaded((signal) => get<Programs>(pathOf('programs'), { limit: kMaxListed }, signal), []);
  const names = readNames(text);
  const act = async (action: () => Promise<unknown>) => { if (await command.send(action)) onChanged(); };
  const list = `programs-${port.name}`;
  return (
    <div class="panel">
      <Allowed to="operate" machine={port.machine}>
        <label>{t.programs}<input list={list} autocomplete="off" placeholder="O0100, O0200@3" value={text} onInput={(e) => setText(e.currentTarget.value)} /></label>
        <datalist id={list}>{(programs.value?.programs ?? []).map((row) => <option key={row.name} value={row.name} />)}</datalist>
        <p class="buttons">
          <SureButton class="primary" label={t.send} question={t.sendSure(names.join(', '), port.machine)} disabled={names.length === 0 || command.isBusy}
            onSure={() => void act(() => send('POST', pathOf('ports', port.name, 'transfers'), { json: { programs: names } }))} />
          <button type="button" disabled={command.isBusy} title={t.receiveHint} onClick={() => void act(() => send('POST', pathOf('ports', port.name, 'receive')))}>{t.receive}</button>
          <button type="button" class="danger" disabled={command.isBusy} onClick={() => void act(() => send('DELETE', pathOf('ports', port.name, 'transfers')))}>{t.stop}</button>
        </p>
        {port.sends_at_once && (
          <p class="buttons">
            <SureButton label={t.confirmReset} question={t.confirmResetSure(port.machine)} disabled={command.isBusy}
              onSure={() => void act(() => send('POST', pathOf('ports', port.name, 'confirm-reset')))} />
            <span class="hint">{t.confirmResetHint}</span>
          </p>
        )}
        <CommandFault command={command} />
      </Allowed>
      {port.transfer && <TransferState transfer={port.transfer} />}
      {port.reception && <TransferState transfer={port.reception} />}
    </div>
  );
}

export function RulesTest({ port }: { port: string }) {
  const t = texts().ports;
  const command = useCommand();
  const [text, setText] = useState('');
  const [verdict, setVerdict] = useState<RuleVerdict | null>(null);
  const ask = async (event: Event) => {
    event.preventDefault();
    await command.send(async () => setVerdict(await send<RuleVerdict>('POST', pathOf('ports', port, 'test-rules'), { json: { text } })));
  };
  return (
    <form class="panel" onSubmit={(event) => void ask(event)}>
      <label>{t.sentText}<textarea rows={3} spellcheck={false} value={text} onInput={(e) => setText(e.currentTarget.value)} /></label>
      <p class="buttons"><button type="submit" disabled={command.isBusy || text === ''}>{t.askRules}</button></p>
      <CommandFault command={command} />
      {verdict && (
        <div class="notice" role="status">
          <p><b>{verdict.rule ?? t.noRule}</b>: {verdict.action} {verdict.argument}</p>
          <ul>{verdict.why.map((line, i) => <li key={i}>{line}</li>)}</ul>
        </div>
      )}
    </form>
  );
}
