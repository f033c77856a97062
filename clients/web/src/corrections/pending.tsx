// What waits for a decision: the value and its change, why it is proposed, and the decision itself by who may approve.
import { useState } from 'preact/hooks';
import type { Offset } from '../../generated/api';
import { pathOf, send } from '../api/request';
import { addressOf } from '../app/route';
import { useFeed } from '../live/use_feed';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { MachineChoice } from '../parts/machine_choice';
import { SureButton } from '../parts/sure_button';
import { dateTimeText, numberText, texts } from '../texts/texts';
import { valueText } from './steps';

const kMaxComment = 512;

export function Change({ of }: { of: Offset }) {
  return (
    <p class="correction">
      <span class="from">{valueText(of.old_value, of.unit)}</span> <span aria-hidden="true">→</span><span class="visually-hidden">{texts().corrections.becomes}</span>{' '}
      <b>{valueText(of.new_value, of.unit)}</b> <span class="muted">{valueText(of.new_value - of.old_value, of.unit, true)}</span>
    </p>
  );
}

function Decision({ offset }: { offset: Offset }) {
  const t = texts().corrections;
  const command = useCommand();
  const [comment, setComment] = useState('');
  const text = comment.trim();
  // The event of the decision takes the card away.
  const decide = (step: 'approve' | 'reject') => () =>
    void command.send(() => send('POST', pathOf('machines', offset.machine, 'offsets', offset.id, step), { json: text === '' ? {} : { comment: text } }));
  return (
    <Allowed to="approve" machine={offset.machine}>
      <label>{t.comment}<input maxLength={kMaxComment} autocomplete="off" value={comment} onInput={(e) => setComment(e.currentTarget.value)} /></label>
      {text === '' && <p class="hint">{t.rejectNeedsComment}</p>}
      <p class="buttons">
        <SureButton class="primary" label={t.approve} question={t.approveSure(offset.target, offset.machine, valueText(offset.new_value, offset.unit))} disabled={command.isBusy} onSure={decide('approve')} />
        <SureButton class="danger" label={t.reject} question={t.rejectSure(offset.target, offset.machine)} disabled={text === '' || command.isBusy} onSure={decide('reject')} />
      </p>
      <CommandFault command={command} />
    </Allowed>
  );
}

function Card({ offset }: { offset: Offset }) {
  const t = texts().corrections;
  return (
    <li class="panel">
      <div class="head">
        <h3><a href={addressOf('corrections', [offset.machine], { target: offset.target })}>{offset.target}</a> <span class="muted">{offset.machine}</span></h3>
        <span class="muted">{dateTimeText(offset.created)}</span>
      </div>
      <Change of={offset} />
      <p class="muted">{t.basis(numberText(offset.used), valueText(offset.mean, offset.unit, true), offset.rule)}{offset.left_out > 0 && ` ${t.leftOut(offset.left_out)}`}</p>
      <ul class="reasons" aria-label={t.reasons}>{offset.reasons.map((reason) => <li key={reason}>{reason}</li>)}</ul>
      <p class="hint">{offset.base === 0 ? t.noBase : t.base(offset.base)}</p>
      <Decision offset={offset} />
    </li>
  );
}

export function Pending() {
  const t = texts().corrections;
  const feed = useFeed('offsets', 'link');
  const pending = [...feed.offsets.values()].sort((a, b) => a.created.localeCompare(b.created));
  return (
    <section aria-labelledby="pending">
      <div class="head">
        <h2 id="pending">{t.pending}</h2>
        <div class="of-machine"><MachineChoice label={t.ofMachine} value="" onChoose={(machine) => { if (machine !== '') location.hash = addressOf('corrections', [machine]); }} /></div>
      </div>
      {pending.length === 0 && <p class="muted">{feed.link.state === 'connecting' ? texts().app.loading : t.nonePending}</p>}
      <ul class="list correction-list">{pending.map((offset) => <Card key={offset.id} offset={offset} />)}</ul>
    </section>
  );
}
