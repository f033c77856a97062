// The corrections that were applied, rejected, or replaced by a newer one.
import { useState } from 'preact/hooks';
import type { Offset, Offsets } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { useFeed } from '../live/use_feed';
import { Loading } from '../parts/loading';
import { Pages } from '../parts/pages';
import { useOffset } from '../parts/use_kept';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, texts } from '../texts/texts';
import { valueText } from './steps';

const kPage = 50;
const kStates = ['applied', 'rejected', 'superseded'] as const;

function Row({ offset }: { offset: Offset }) {
  const t = texts().corrections;
  return (
    <tr>
      <th scope="row"><a class="target" href={addressOf('corrections', [offset.machine], { target: offset.target })}>{offset.target}</a></th>
      <td>{offset.machine}</td>
      <td class="number">{valueText(offset.old_value, offset.unit)}</td>
      <td class="number">{valueText(offset.new_value, offset.unit)}</td>
      <td>{offset.decided === null ? '–' : dateTimeText(offset.decided)}</td>
      <td>{offset.automatic ? t.automatic : (offset.who ?? '–')}</td>
      <td class="record-text">{offset.comment ?? '–'}</td>
    </tr>
  );
}

export function Decided() {
  const t = texts().corrections;
  const { offsets: pending } = useFeed('offsets');
  const [state, setState] = useState<(typeof kStates)[number]>('applied');
  const [offset, setOffset] = useOffset(state);
  const decided = useLoaded((signal) => get<Offsets>(pathOf('offsets'), { state, limit: kPage, offset }, signal), [state, offset, [...pending.keys()].join(' ')]);
  const list = decided.value?.offsets ?? [];
  return (
    <section class="decided" aria-labelledby="decided">
      <h2 id="decided">{t.decided}</h2>
      <div class="chips" role="group" aria-labelledby="decided">
        {kStates.map((key) => <button key={key} type="button" aria-pressed={key === state} onClick={() => setState(key)}>{t.states[key]}</button>)}
      </div>
      <Loading of={decided} />
      {decided.value && list.length === 0 && <p class="muted">{t.none}</p>}
      {list.length > 0 && (
        <div class="scroll" tabIndex={0} role="region" aria-label={t.states[state]}>
          <table class="data">
            <thead>
              <tr>
                {[t.target, texts().reports.machine, t.before, t.after, t.decidedAt, t.who, t.comment].map((name, i) => <th scope="col" key={name} class={i === 2 || i === 3 ? 'number' : ''}>{name}</th>)}
              </tr>
            </thead>
            <tbody>{list.map((row) => <Row key={row.id} offset={row} />)}</tbody>
          </table>
        </div>
      )}
      {(offset > 0 || list.length === kPage) && <Pages offset={offset} size={kPage} count={list.length} onOffset={setOffset} />}
    </section>
  );
}
