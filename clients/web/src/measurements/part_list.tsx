// The measured parts with their verdicts, the newest first. A new verdict is there at once.
import { useEffect } from 'preact/hooks';
import type { Part, Parts } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { feed } from '../live/feed';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { MachineChoice } from '../parts/machine_choice';
import { Pages } from '../parts/pages';
import { useOffset } from '../parts/use_kept';
import { useLoaded } from '../parts/use_loaded';
import { kVerdicts, kVerdictTones, VerdictPill } from '../parts/verdict_pill';
import { dateTimeText, numberText, texts } from '../texts/texts';

const kPage = 100;

/// How a part is called: by its serial number or its number, otherwise as the server counts it.
export function partName(part: Part): string {
  return [part.part_number, part.serial].filter(Boolean).join(' · ') || texts().measurements.partNumber(part.id);
}

/// A part that has not ended is not good yet; what is outside its limits stays so.
export function isFinal(part: Part): boolean {
  return part.ended !== null || part.verdict === 'rework' || part.verdict === 'scrap';
}

export function PartTable({ parts, label }: { parts: Part[]; label: string }) {
  const t = texts().measurements;
  return (
    <div class="scroll" tabIndex={0} role="group" aria-label={label}>
      <table class="data">
        <Heads of={[t.part, t.verdict, texts().reports.machine, texts().reports.program, t.ended, t.count, t.findings]} />
        <tbody>
          {parts.map((part) => (
            <tr key={part.id}>
              <th scope="row"><a class="target" href={addressOf('measurements', ['parts', String(part.id)])}>{partName(part)}</a></th>
              <td>{isFinal(part) ? <VerdictPill verdict={part.verdict} /> : '–'}</td>
              <td>{part.machine}</td>
              <td>{part.program ?? '–'}{part.revision !== null && <span class="muted"> {part.revision}</span>}</td>
              <td>{part.ended === null ? t.open : dateTimeText(part.ended)}</td>
              <td>{numberText(part.measurements)}</td>
              <td>{part.findings === 0 ? '–' : <b class="outside">{numberText(part.findings)}</b>}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

export function PartList({ query }: { query: URLSearchParams }) {
  const t = texts().measurements;
  const choice = { machine: query.get('machine') ?? '', verdict: query.get('verdict') ?? '', run: query.get('run') ?? '' };
  const inputs = Object.values(choice);
  const [offset, setOffset] = useOffset(...inputs);
  const parts = useLoaded((signal) => get<Parts>(pathOf('parts'), { ...choice, limit: kPage, offset }, signal), [...inputs, offset]);
  useEffect(() => feed.on('parts', parts.reload), []);
  const choose = (changed: Partial<typeof choice>) => location.replace(addressOf('measurements', ['parts'], { ...choice, ...changed }));
  const list = parts.value?.parts ?? [];
  return (
    <>
      <div class="tools">
        <MachineChoice value={choice.machine} onChoose={(machine) => choose({ machine })} />
        <div class="chips" role="group" aria-label={t.verdict}>
          <button type="button" aria-pressed={choice.verdict === ''} onClick={() => choose({ verdict: '' })}>{texts().floor.all}</button>
          {kVerdicts.map((verdict) => (
            <button key={verdict} type="button" class={kVerdictTones[verdict]} aria-pressed={choice.verdict === verdict} onClick={() => choose({ verdict: choice.verdict === verdict ? '' : verdict })}>{t.verdicts[verdict]}</button>
          ))}
        </div>
        {choice.run !== '' && <button type="button" onClick={() => choose({ run: '' })}>{t.onlyRun(choice.run.slice(0, 8))} ×</button>}
      </div>
      <Loading of={parts} />
      {parts.value && list.length === 0 && <p class="notice">{inputs.every((value) => value === '') && offset === 0 ? t.noneMeasured : t.noneFits}</p>}
      {list.length > 0 && <PartTable parts={list} label={t.tabs.parts} />}
      {(offset > 0 || list.length === kPage) && <Pages offset={offset} size={kPage} count={list.length} onOffset={setOffset} />}
    </>
  );
}
