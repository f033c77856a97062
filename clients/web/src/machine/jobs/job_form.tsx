// Adds a program to the queue of a machine: how many parts, how many a run makes, and what the operator should know.
import { useState } from 'preact/hooks';
import type { Job, Programs } from '../../../generated/api';
import { get, pathOf, send } from '../../api/request';
import { CommandFault, useCommand } from '../../parts/command';
import { useLoaded } from '../../parts/use_loaded';
import { texts } from '../../texts/texts';
import { requestOf, type JobText } from './job_steps';

const kMaxListed = 1000;
const kMaxQuantity = 1_000_000;
const kMaxPartsPerRun = 10_000;
const kMaxComment = 1024;

interface Props {
  machine: string;
  /// Of the machine, to offer what fits it.
  control?: string | null;
  /// This one and no other; absent: one is chosen.
  fixed?: { program: string; revision: number };
  /// Absent: the event of the queue is enough.
  onAdded?: (job: Job) => void;
}

function ProgramField({ control, value, onChange }: { control: string | null; value: string; onChange: (name: string) => void }) {
  const { value: list } = useLoaded((signal) => get<Programs>(pathOf('programs'), { limit: kMaxListed, control }, signal), [control]);
  return (
    <>
      <label>{texts().machine.program}<input required list="job-programs" autocomplete="off" maxLength={128} value={value} onInput={(e) => onChange(e.currentTarget.value)} /></label>
      <datalist id="job-programs">{(list?.programs ?? []).map((p) => <option key={p.name} value={p.name}>{p.title ?? ''}</option>)}</datalist>
    </>
  );
}

export function JobForm({ machine, control = null, fixed, onAdded }: Props) {
  const t = texts().jobs;
  const command = useCommand();
  const [job, setJob] = useState<JobText>({ program: fixed?.program ?? '', revision: '', quantity: 1, partsPerRun: 1, counts: 'made', isFirst: false, comment: '' });
  const set = (changed: Partial<JobText>) => setJob({ ...job, ...changed });
  const add = async (event: Event) => {
    event.preventDefault();
    await command.send(async () => {
      const added = await send<Job>('POST', pathOf('machines', machine, 'jobs'), { json: requestOf(job) });
      setJob({ ...job, program: fixed?.program ?? '', comment: '', isFirst: false });
      onAdded?.(added);
    });
  };
  return (
    <form class="job-form" onSubmit={(event) => void add(event)}>
      {!fixed && <ProgramField control={control} value={job.program} onChange={(program) => set({ program })} />}
      {fixed ? (
        <label>
          {t.revision}
          <select value={job.revision} onChange={(e) => set({ revision: e.currentTarget.value })}>
            <option value="">{t.latest}</option>
            <option value={fixed.revision}>{texts().programs.revisionNumber(fixed.revision)}</option>
          </select>
        </label>
      ) : (
        <label>{t.revision}<input type="number" min={1} step={1} placeholder={texts().machine.latest} value={job.revision} onInput={(e) => set({ revision: e.currentTarget.value })} /></label>
      )}
      <label>{t.quantity}<input type="number" required min={1} max={kMaxQuantity} step={1} value={job.quantity} onInput={(e) => set({ quantity: e.currentTarget.valueAsNumber })} /></label>
      <label>{t.partsPerRun}<input type="number" required min={1} max={kMaxPartsPerRun} step={1} value={job.partsPerRun} onInput={(e) => set({ partsPerRun: e.currentTarget.valueAsNumber })} /></label>
      <label>
        {t.counts}
        <select value={job.counts} title={t.countsHint} onChange={(e) => set({ counts: e.currentTarget.value as Job['counts'] })}>
          <option value="made">{t.countsMade}</option>
          <option value="good">{t.countsGood}</option>
        </select>
      </label>
      <label class="wide">{t.comment}<input maxLength={kMaxComment} autocomplete="off" placeholder={t.commentHint} value={job.comment} onInput={(e) => set({ comment: e.currentTarget.value })} /></label>
      <label class="check"><input type="checkbox" checked={job.isFirst} onChange={(e) => set({ isFirst: e.currentTarget.checked })} />{t.asFirst}</label>
      <button type="submit" class="primary" disabled={command.isBusy}>{t.add}</button>
      <CommandFault command={command} />
    </form>
  );
}
