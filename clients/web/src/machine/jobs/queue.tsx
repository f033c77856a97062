// The job queue of a machine: what it is to make, in order; adding to it, holding it, and what was done.
import { useState } from 'preact/hooks';
import type { JobList, Machine } from '../../../generated/api';
import { get, pathOf } from '../../api/request';
import { useFeed } from '../../live/use_feed';
import { Allowed } from '../../parts/allowed';
import { Loading } from '../../parts/loading';
import { useLoaded } from '../../parts/use_loaded';
import { texts } from '../../texts/texts';
import { Hold } from './hold';
import { JobForm } from './job_form';
import { JobFacts, JobParts, JobPill, JobRow, JobTitle } from './job_row';
import { StartJob, startFault } from './start_job';
import { useJobs } from './use_jobs';

const kClosedShown = 50;

/// `version`: another one means that a job may have been closed.
function ClosedJobs({ machine, version }: { machine: string; version: string }) {
  const t = texts().jobs;
  const [isOpen, setOpen] = useState(false);
  const closed = useLoaded(async (signal) => (isOpen ? get<JobList>(pathOf('machines', machine, 'jobs'), { state: 'closed', limit: kClosedShown }, signal) : null), [isOpen, version]);
  return (
    <details onToggle={(e) => setOpen(e.currentTarget.open)}>
      <summary class="button">{t.closed}</summary>
      {isOpen && <Loading of={closed} />}
      {closed.value?.jobs.length === 0 && <p class="muted">{t.noneClosed}</p>}
      <ul class="list closed-jobs">
        {(closed.value?.jobs ?? []).map((job) => (
          <li key={job.id} class="panel">
            <div class="head"><JobTitle job={job} /><JobPill state={job.state} /></div>
            <p><JobParts job={job} />{job.comment && ` · ${job.comment}`}</p>
            <JobFacts job={job} />
          </li>
        ))}
      </ul>
    </details>
  );
}

export function MachineQueue({ name }: { name: string }) {
  const t = texts().jobs;
  const machine: Machine = useFeed(`machine:${name}`).machines.get(name)!;
  const queue = useJobs(name);
  const jobs = queue.value?.jobs ?? [];
  const hold = queue.value?.hold ?? null;
  const fault = startFault(machine, hold);
  return (
    <section aria-labelledby="queue">
      <h2 id="queue">{t.title}</h2>
      <Loading of={queue} />
      <Allowed to="operate" machine={name}>
        {queue.value && <Hold machine={name} hold={hold} />}
        {jobs.length > 0 && fault !== null && !hold && <p class="hint" role="status">{fault}</p>}
        {queue.value && jobs.length === 0 && <p class="muted">{t.none}</p>}
        <ol class="list jobs" aria-labelledby="queue">
          {jobs.map((job, i) => <JobRow key={job.id} job={job} index={i} count={jobs.length} hold={hold} />)}
        </ol>
        <section class="panel" aria-labelledby="add-job">
          <h3 id="add-job">{t.addTitle}</h3>
          <JobForm machine={name} control={machine.control} />
        </section>
      </Allowed>
      <ClosedJobs machine={name} version={jobs.map((job) => job.id).join(' ')} />
    </section>
  );
}

/// On the machine's first view: what it is to make next.
export function NextJob({ name }: { name: string }) {
  const t = texts().jobs;
  const queue = useJobs(name);
  const job = queue.value?.jobs[0];
  if (!job) return null;
  const hold = queue.value?.hold ?? null;
  return (
    <section class="panel" aria-labelledby="next-job">
      <h2 id="next-job">{t.next}</h2>
      <JobTitle job={job} />
      {job.comment && <p class="message">{job.comment}</p>}
      <p><JobParts job={job} /></p>
      {hold && <p class="notice warn">{t.isHeld(hold.who, hold.reason)}</p>}
      <Allowed to="operate" machine={name}><p class="buttons"><StartJob class="big primary" job={job} hold={hold} label={t.startNext} /></p></Allowed>
    </section>
  );
}
