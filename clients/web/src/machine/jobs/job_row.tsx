// One job of the queue: what is to be made and how far it is, its place, its start.
import type { Job, JobList } from '../../../generated/api';
import { pathOf, send } from '../../api/request';
import { addressOf } from '../../app/route';
import { CommandFault, useCommand } from '../../parts/command';
import { SureButton } from '../../parts/sure_button';
import { dateTimeText, numberText, texts } from '../../texts/texts';
import { countedOf, fractionOf, isMeasured, movesOf } from './job_steps';
import { StartJob } from './start_job';

const kTones = { waiting: 'offline', active: 'running', done: 'done', removed: 'offline' } as const;

export function JobPill({ state }: { state: Job['state'] }) {
  return <span class={`pill ${kTones[state]}`}>{texts().jobs.states[state]}</span>;
}

export function JobFacts({ job }: { job: Job }) {
  const t = texts().jobs;
  const facts = [
    job.parts_per_run > 1 && t.perRun(numberText(job.parts_per_run)), job.runs > 0 && t.runs(job.runs), `${job.author}, ${dateTimeText(job.created)}`, t.number(job.id),
  ];
  return <p class="muted">{facts.filter(Boolean).join(' · ')}</p>;
}

/// How many of them are wanted and there, and what was measured of them.
export function JobParts({ job }: { job: Job }) {
  const t = texts().jobs;
  const counted = (job.counts === 'good' ? t.completedGood : t.completed)(numberText(countedOf(job)), numberText(job.quantity));
  if (!isMeasured(job)) return <>{counted}</>;
  return <>{counted} <span class="muted">{t.verdicts(numberText(job.completed), numberText(job.good), numberText(job.rework), numberText(job.scrap), numberText(job.unknown))}</span></>;
}

export function JobTitle({ job }: { job: Job }) {
  const t = texts().jobs;
  return (
    <h3>
      <a href={addressOf('programs', job.revision === null ? [job.program] : [job.program, String(job.revision)])}>{job.program}</a>{' '}
      <span class="muted">{job.revision === null ? t.latest : texts().machine.revision(job.revision)}</span>
    </h3>
  );
}

interface Props {
  job: Job;
  index: number;
  count: number;
  hold: JobList['hold'];
}

/// What is changed here comes back as an event of the queue.
export function JobRow({ job, index, count, hold }: Props) {
  const t = texts().jobs;
  const command = useCommand();
  const moves = movesOf(index, count);
  const path = pathOf('machines', job.machine, 'jobs', job.id);
  const move = (place: number | null) => () => void command.send(() => send('PUT', path, { json: { place } }));
  return (
    <li class="panel job">
      <span class="place" aria-hidden="true">{index + 1}</span>
      <div class="what">
        <div class="head"><JobTitle job={job} /><JobPill state={job.state} /></div>
        {job.comment && <p class="message">{job.comment}</p>}
        <p class="progress-row">
          <progress value={fractionOf(job)} max={1} aria-label={t.progressOf(job.program)} />
          <span><JobParts job={job} /></span>
        </p>
        <JobFacts job={job} />
        <p class="buttons">
          <StartJob class={index === 0 ? 'primary' : ''} job={job} hold={hold} label={index === 0 ? t.startNext : t.startThis} />
          {([['first', '⤒'], ['up', '↑'], ['down', '↓']] as const).map(([where, sign]) => (
            <button key={where} type="button" class="square" aria-label={t.moves[where](job.program)} title={t.moves[where](job.program)}
              disabled={moves[where] === null || command.isBusy} onClick={move(moves[where])}>{sign}</button>
          ))}
          <SureButton class="danger" label={t.remove} question={t.removeSure(job.program, numberText(job.quantity - Math.min(job.quantity, countedOf(job))))}
            disabled={job.state === 'active' || command.isBusy} onSure={() => void command.send(() => send('DELETE', path))} />
        </p>
        <CommandFault command={command} />
      </div>
    </li>
  );
}
