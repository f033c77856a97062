// The webhooks: where events go, how they are delivered; added with a secret that is shown once, tested, removed.
import { useState } from 'preact/hooks';
import type { Webhook, Webhooks as WebhookList, WebhookTest } from '../../generated/api';
import { get, pathOf, send } from '../api/request';
import { CommandFault, useCommand } from '../parts/command';
import { Loading } from '../parts/loading';
import { Secret } from '../parts/secret';
import { SureButton } from '../parts/sure_button';
import { useRefreshed } from '../parts/use_refreshed';
import { dateTimeText, numberText, relativeText, texts } from '../texts/texts';
import { kindsToSend, kKinds, webhookTone } from './folder_state';

const kIntervalMs = 5000;
const kMaxUrl = 512;

function NewWebhook({ onMade }: { onMade: (webhook: Webhook) => void }) {
  const t = texts().webhooks;
  const command = useCommand();
  const [name, setName] = useState('');
  const [url, setUrl] = useState('');
  const [kinds, setKinds] = useState<Webhook['kinds']>(kKinds);
  const make = async (event: Event) => {
    event.preventDefault();
    await command.send(async () => onMade(await send<Webhook>('POST', pathOf('webhooks'), { json: { name: name.trim(), url: url.trim(), ...kindsToSend(kinds) } })));
  };
  return (
    <form class="panel" onSubmit={(event) => void make(event)}>
      <label>{t.name}<input required maxLength={64} autocomplete="off" autocapitalize="none" value={name} onInput={(e) => setName(e.currentTarget.value)} /></label>
      <label>{t.url}<input type="url" required maxLength={kMaxUrl} autocomplete="off" placeholder="https://mes.example/dripline" value={url} onInput={(e) => setUrl(e.currentTarget.value)} /></label>
      <fieldset class="choice">
        <legend>{t.events}</legend>
        {kKinds.map((kind) => (
          <label key={kind} class="check">
            <input type="checkbox" checked={kinds.includes(kind)} onChange={(e) => setKinds(e.currentTarget.checked ? [...kinds, kind] : kinds.filter((other) => other !== kind))} />{t.kinds[kind]}
          </label>
        ))}
      </fieldset>
      <p class="hint">{t.signed}</p>
      <p class="buttons"><button type="submit" class="primary" disabled={kinds.length === 0 || command.isBusy}>{t.add}</button></p>
      <CommandFault command={command} />
    </form>
  );
}

function Card({ webhook, onChanged }: { webhook: Webhook; onChanged: () => void }) {
  const t = texts().webhooks;
  const command = useCommand();
  const [test, setTest] = useState<WebhookTest | null>(null);
  const tone = webhookTone(webhook);
  const run = async () => {
    setTest(null);
    await command.send(async () => setTest(await send<WebhookTest>('POST', pathOf('webhooks', webhook.name, 'test'))));
    onChanged();
  };
  const remove = async () => {
    if (await command.send(() => send('DELETE', pathOf('webhooks', webhook.name)))) onChanged();
  };
  const facts = [
    webhook.delivered_at === null ? t.neverDelivered : t.deliveredAt(relativeText(webhook.delivered_at)), t.waiting(numberText(webhook.waiting)), `${webhook.author}, ${dateTimeText(webhook.created)}`,
  ];
  return (
    <li class="panel">
      <div class="head"><h3>{webhook.name}</h3><span class={`pill ${tone}`}>{t.tones[tone]}</span></div>
      <p class="mono record-text">{webhook.url}</p>
      <p class="muted">{webhook.kinds.length === kKinds.length ? t.allEvents : webhook.kinds.map((kind) => t.kinds[kind]).join(', ')}</p>
      <p class="muted">{facts.join(' · ')}</p>
      {webhook.lost > 0 && <p class="notice bad">{t.lost(numberText(webhook.lost))}</p>}
      {webhook.fault !== null && <p class="notice warn">{webhook.failing_since !== null && <b>{t.failing(numberText(webhook.failures), dateTimeText(webhook.failing_since))}</b>} {webhook.fault}</p>}
      <p class="buttons">
        <button type="button" aria-label={t.testOf(webhook.name)} disabled={command.isBusy} onClick={() => void run()}>{t.test}</button>
        <SureButton class="danger" label={t.remove} question={t.removeSure(webhook.name)} disabled={command.isBusy} onSure={() => void remove()} />
      </p>
      {test && <p class={`notice ${test.delivered ? '' : 'bad'}`} role="status">{test.delivered ? t.testDelivered : t.testFailed(test.fault ?? '')}</p>}
      <CommandFault command={command} />
    </li>
  );
}

export function Webhooks() {
  const t = texts().webhooks;
  const webhooks = useRefreshed((signal) => get<WebhookList>(pathOf('webhooks'), {}, signal), () => kIntervalMs);
  const [issued, setIssued] = useState<Webhook | null>(null);
  const take = (webhook: Webhook) => {
    setIssued(webhook);
    webhooks.reload();
  };
  return (
    <section aria-labelledby="webhooks">
      <h2 id="webhooks">{t.title}</h2>
      <p class="hint">{t.hint}</p>
      <Loading of={webhooks} />
      {webhooks.value?.webhooks.length === 0 && <p class="muted">{t.none}</p>}
      <ul class="list">{(webhooks.value?.webhooks ?? []).map((webhook) => <Card key={webhook.name} webhook={webhook} onChanged={webhooks.reload} />)}</ul>
      {issued ? <Secret title={t.issued(issued.name)} secret={issued.secret ?? ''} onDone={() => setIssued(null)} /> : (
        <details>
          <summary class="button">{t.add}</summary>
          <NewWebhook onMade={take} />
        </details>
      )}
    </section>
  );
}
