// Starts a program on a machine. The revision is the latest unless one is named; the second press of the button names all of it.
import { useState } from 'preact/hooks';
import type { Machine, Programs } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { Allowed, useSessionState } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { SureButton } from '../parts/sure_button';
import { useLoaded } from '../parts/use_loaded';
import { usePolicy } from '../parts/use_policy';
import { revisionToStart } from '../programs/release_steps';
import { texts } from '../texts/texts';
import { kNoOptions, startRun, type StartOptions } from './commands';
import { StartOptionFields } from './start_options';
import { canStartAt, kExamples } from './start_places';

const kMaxListed = 1000;

/// "N120 (block), T3 (tool)": what the control of this machine goes to.
function placesText({ starts }: Machine): string {
  return starts.at.map((place) => texts().start.places[place](kExamples[place])).join(', ');
}

export function StartForm({ machine }: { machine: Machine }) {
  const t = texts().machine;
  const command = useCommand();
  const [program, setProgram] = useState('');
  const [from, setFrom] = useState('');
  const [options, setOptions] = useState<StartOptions>(kNoOptions);
  const { value } = useLoaded((signal) => get<Programs>(pathOf('programs'), { limit: kMaxListed }, signal), []);
  const fitting = (value?.programs ?? []).filter((p) => p.control === null || p.control === machine.control);
  const chosen = fitting.find((p) => p.name === program);
  const session = useSessionState();
  const policy = usePolicy().value;
  const revision = chosen && 'session' in session ? revisionToStart(policy, chosen, machine.name, session.session) : null;
  const canStart = canStartAt(from, machine.starts);
  const latest = policy?.runs === 'release' ? t.latestReleased : t.latest;
  const start = async () => {
    // The revision that the question named, whatever has been uploaded since.
    const request = { machine: machine.name, program, revision, from: from.trim(), options };
    if (!(await command.send(() => startRun(request)))) return;
    setFrom('');
    setOptions(kNoOptions);
  };
  return (
    <section class="panel" aria-labelledby="start">
      <h2 id="start">{t.start}</h2>
      <Allowed to="operate" machine={machine.name}>
      <label>
        {t.program}
        <input name="program" list="programs" autocomplete="off" value={program} onInput={(e) => setProgram(e.currentTarget.value)} />
      </label>
      <datalist id="programs">{fitting.map((p) => <option key={p.name} value={p.name}>{p.title ?? ''}</option>)}</datalist>
      {machine.starts.at.length === 0 ? <p class="hint">{texts().start.noSearch}</p> : (
        <label>
          {t.from}
          <input name="from" autocomplete="off" maxLength={24} placeholder={placesText(machine)} value={from} aria-invalid={!canStart} onInput={(e) => setFrom(e.currentTarget.value)} />
        </label>
      )}
      {!canStart && <p class="notice warn" role="status">{texts().start.notThere(from.trim(), placesText(machine))}</p>}
      {from.trim() !== '' && <StartOptionFields starts={machine.starts} options={options} onChange={setOptions} />}
      <SureButton class="big primary" label={t.start} disabled={program === '' || !canStart || command.isBusy || !machine.connected}
        question={t.startSure(program, revision === null ? latest : String(revision), machine.name, from.trim())} onSure={() => void start()} />
      <CommandFault command={command} />
      </Allowed>
    </section>
  );
}
