// The machine's runs, newest first, and where one that was cut off can be continued.
import { useEffect, useState } from 'preact/hooks';
import type { Run, Runs } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { feed } from '../live/feed';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { Loading } from '../parts/loading';
import { RunPill } from '../parts/run_pill';
import { SureButton } from '../parts/sure_button';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, numberText, texts } from '../texts/texts';
import { restartRun } from './commands';

const kShown = 50;
const kCutOff: Array<Run['state']> = ['aborted', 'alarmed', 'interrupted'];

function Restart({ run, onStarted }: { run: Run; onStarted: () => void }) {
  const t = texts().machine;
  const command = useCommand();
  const [at, setAt] = useState('');
  const restart = async () => {
    if (await command.send(() => restartRun(run.id, at.trim()))) onStarted();
  };
  return (
    <details class="restart">
      <summary class="button">{t.restart}</summary>
      <div class="panel">
        <label>
          {t.restartAt}
          <input name="at" maxLength={48} autocomplete="off" placeholder={t.restartHint} value={at} onInput={(e) => setAt(e.currentTarget.value)} />
        </label>
        <p class="hint">{t.restartNote}</p>
        <Allowed to="operate" machine={run.machine}>
          <SureButton class="primary" label={t.restart} question={t.restartSure(run.program, at.trim())} disabled={command.isBusy} onSure={() => void restart()} />
        </Allowed>
        <CommandFault command={command} />
      </div>
    </details>
  );
}

export function MachineRuns({ machine }: { machine: string }) {
  const t = texts().machine;
  const runs = useLoaded((signal) => get<Runs>(pathOf('runs'), { machine, limit: kShown }, signal), [machine]);
  useEffect(() => feed.on(`runs:${machine}`, runs.reload), [machine]);
  const list = runs.value?.runs ?? [];
  return (
    <section aria-labelledby="runs">
      <h2 id="runs">{t.runs}</h2>
      <Loading of={runs} />
      {runs.value && list.length === 0 && <p class="muted">{t.noRuns}</p>}
      <ul class="list">
        {list.map((run) => (
          <li key={run.id} class="panel run">
            <div class="head"><h3>{run.program} <span class="muted">{t.revision(run.revision)}</span></h3><RunPill state={run.state} /></div>
            <p class="muted">{dateTimeText(run.created)}{run.author && ` · ${run.author}`}{run.test && ` · ${t.testRun}`} · {t.executed(numberText(run.executed))} · {t.line(run.line)}</p>
            {run.reason && <p class="message">{run.reason}</p>}
            <div class="head">
              <a href={addressOf('reports', [run.id])}>{t.report(run.outputs)}</a>
              {kCutOff.includes(run.state) && !run.test && <Restart run={run} onStarted={runs.reload} />}
            </div>
          </li>
        ))}
      </ul>
    </section>
  );
}
