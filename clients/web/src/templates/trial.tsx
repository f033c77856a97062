// What the text of a template makes of a run, line by line: also before it is stored. Nothing is stored by it.
import { useState } from 'preact/hooks';
import type { Run, Runs, TemplateAssignment, TemplateTrial } from '../../generated/api';
import { get, pathOf, send, withQuery } from '../api/request';
import { CommandFault, useCommand } from '../parts/command';
import { Heads } from '../parts/heads';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, numberText, texts } from '../texts/texts';
import { runsFor } from './runs_for';
import { eventText, fieldsText, type TrialEvent, type TriedLine } from './trial_text';

const kPage = 200;
const kRuns = 200;

interface Tried {
  trial: TemplateTrial;
  text: string;
  offset: number;
}

function Brings({ events }: { events: TrialEvent[] }) {
  return <ul class="plain">{events.map((event, i) => <li key={i} class={event.event === 'finding' ? 'outside' : ''}>{eventText(event)}</li>)}</ul>;
}

function Line({ of }: { of: TriedLine }) {
  const t = texts().templates;
  return (
    <tr>
      <td class="mono record-text">{of.line}</td>
      <td><span class={`pill ${of.understood ? 'running' : 'alarm'}`}>{of.understood ? t.understood : t.notUnderstood}</span></td>
      <td>{of.template_line === null ? '–' : t.ruleLine(of.template_line)}</td>
      <td>
        {of.events.length > 0 ? <Brings events={of.events} /> : of.understood && t.ignored}
        {Object.keys(of.fields).length > 0 && <p class="hint mono">{fieldsText(of.fields)}</p>}
      </td>
    </tr>
  );
}

function Lines({ trial, offset, total, onOffset }: { trial: TemplateTrial; offset: number; total: number; onOffset: (offset: number) => void }) {
  const t = texts().templates;
  const r = texts().reports;
  return (
    <>
      <div class="scroll" tabIndex={0} role="group" aria-labelledby="trial">
        <table class="data">
          <Heads of={[t.line, t.result, t.rule, t.brings]} />
          <tbody>{trial.shown.map((line, i) => <Line key={offset + i} of={line} />)}</tbody>
        </table>
      </div>
      {total > kPage && (
        <p class="buttons">
          <span>{t.shown(offset + 1, offset + trial.shown.length, numberText(total))}</span>
          <button type="button" disabled={offset === 0} onClick={() => onOffset(Math.max(0, offset - kPage))}>{r.earlier}</button>
          <button type="button" disabled={offset + kPage >= total} onClick={() => onOffset(offset + kPage)}>{r.later}</button>
        </p>
      )}
    </>
  );
}

function nameOf(run: Run): string {
  return `${texts().templates.runText(run.program, run.machine, dateTimeText(run.started ?? run.created))} · ${run.id.slice(0, 8)}`;
}

interface Props {
  /// As it is typed.
  text: string;
  /// A run that came with the address.
  asked: string;
  assignments: TemplateAssignment[];
}

export function Trial({ text, asked, assignments }: Props) {
  const t = texts().templates;
  const runs = useLoaded((signal) => get<Runs>(pathOf('runs'), { limit: kRuns }, signal), []);
  const [chosen, setChosen] = useState<string | null>(null);
  const [isOnly, setOnly] = useState(false);
  const [tried, setTried] = useState<Tried | null>(null);
  const command = useCommand();
  const fitting = runsFor(runs.value?.runs ?? [], assignments);
  const run = chosen ?? (asked !== '' ? asked : (fitting[0]?.id ?? ''));
  const tryAt = (offset: number, isOnlyUnmatched: boolean) => void command.send(async () => {
    setTried(null);
    const path = withQuery(pathOf('runs', run, 'template-trial'), { limit: kPage, offset, unmatched: isOnlyUnmatched ? 'yes' : null });
    setTried({ text, offset, trial: await send<TemplateTrial>('POST', path, { raw: text }) });
  });
  const total = tried === null ? 0 : isOnly ? tried.trial.unmatched : tried.trial.lines;
  return (
    <section class="panel" aria-labelledby="trial">
      <h2 id="trial">{t.trial}</h2>
      <p class="hint">{t.trialHint}</p>
      <div class="with-button trial-choice">
        <label>
          {t.run}
          <select value={run} onChange={(e) => { setChosen(e.currentTarget.value); setTried(null); }}>
            {run === '' && <option value="">–</option>}
            {asked !== '' && !fitting.some(({ id }) => id === asked) && <option value={asked}>{asked.slice(0, 8)}</option>}
            {fitting.map((one) => <option key={one.id} value={one.id}>{nameOf(one)}</option>)}
          </select>
        </label>
        <button type="button" class="primary" disabled={run === '' || text.trim() === '' || command.isBusy} onClick={() => tryAt(0, isOnly)}>{t.tryIt}</button>
      </div>
      <label class="check"><input type="checkbox" checked={isOnly} onChange={(e) => { setOnly(e.currentTarget.checked); if (tried) tryAt(0, e.currentTarget.checked); }} />{t.onlyUnmatched}</label>
      <CommandFault command={command} />
      {tried && (
        <>
          <p role="status"><b class={tried.trial.unmatched > 0 ? 'outside' : ''}>{t.counts(numberText(tried.trial.lines), numberText(tried.trial.unmatched), numberText(tried.trial.measurements))}</b></p>
          {tried.text !== text && <p class="notice warn">{t.old}</p>}
          {total === 0 && <p class="notice">{tried.trial.lines === 0 ? t.noLines : t.allUnderstood}</p>}
          {tried.trial.shown.length > 0 && <Lines trial={tried.trial} offset={tried.offset} total={total} onOffset={(offset) => tryAt(offset, isOnly)} />}
          {tried.trial.at_end.length > 0 && <><h3>{t.atEnd}</h3><Brings events={tried.trial.at_end} /></>}
        </>
      )}
    </section>
  );
}
