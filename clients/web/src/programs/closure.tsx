// The programs that a revision calls, and those that they call: what a run now would take, and what a release can pin.
import type { Closure as CallClosure, Revision } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { RevisionPill } from '../parts/revision_pill';
import { SetupChoice, useMachinesOf } from '../parts/setup_choice';
import { useLoaded, type Loaded } from '../parts/use_loaded';
import { numberText, texts } from '../texts/texts';
import { namesOf, type ClosureChoice } from './calls';

/// Looked through without being asked for, as a check is.
const kMaxAtOnce = 2 * 1024 * 1024;

/// Another choice has no closure before its own is read: a release must not pin what another revision calls.
export function useClosure(revision: Revision | undefined, { machine, with: typed }: ClosureChoice, version: unknown): Loaded<CallClosure | null> {
  const isRead = revision !== undefined && revision.control !== null && revision.size <= kMaxAtOnce;
  const names = namesOf(typed).join(',');
  const of = JSON.stringify([revision?.program, revision?.revision, machine, names]);
  const loaded = useLoaded(async (signal) => {
    if (!isRead) return { of, closure: null };
    return { of, closure: await get<CallClosure>(pathOf('programs', revision.program, 'closure'), { revision: revision.revision, machine, with: names }, signal) };
  }, [of, isRead, version]);
  return { ...loaded, value: loaded.value?.of === of ? loaded.value.closure : null };
}

function Site({ site }: { site: CallClosure['computed'][number] }) {
  const { program, revision, line } = site;
  return <a href={addressOf('programs', [program, String(revision)], { line: String(line) })}>{texts().library.site(program, numberText(line))}</a>;
}

function Calls({ closure }: { closure: CallClosure }) {
  const t = texts().library;
  return (
    <div class="scroll" tabIndex={0} role="group" aria-labelledby="closure">
      <table>
        <Heads of={[t.calledAs, texts().programs.revision, texts().programs.state, t.calledIn]} />
        <tbody>
          {closure.calls.map((call) => (
            <tr key={`${call.program} ${call.revision}`}>
              <th scope="row"><a href={addressOf('programs', [call.program, String(call.revision)])}>{call.program}</a>{call.name !== call.program && <span class="muted"> {call.name}</span>}</th>
              <td>{call.revision}</td>
              <td><RevisionPill revision={{ state: call.state, held: false }} /></td>
              <td>{call.site === null ? t.namedHere : <Site site={call.site} />}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

interface Props {
  revision: Revision;
  closure: Loaded<CallClosure | null>;
  choice: ClosureChoice;
  onChoose: (choice: ClosureChoice) => void;
}

export function Closure({ revision, closure, choice, onChoose }: Props) {
  const t = texts().library;
  const machines = useMachinesOf(revision.control);
  const { value } = closure;
  const hasMore = choice.with !== '' || (value !== null && value.computed.length > 0);
  return (
    <section class="panel" aria-labelledby="closure">
      <h2 id="closure">{t.calls}</h2>
      {revision.size > kMaxAtOnce ? <p class="hint">{t.tooLongForCalls}</p> : <Loading of={closure} />}
      {value && value.calls.length === 0 && value.missing.length === 0 && value.computed.length === 0 && <p class="muted">{t.noCalls}</p>}
      {value && value.calls.length > 0 && <Calls closure={value} />}
      {value?.missing.map(({ name, site }) => <p key={name} class="notice bad">{t.missing(name)} <Site site={site} /></p>)}
      {value?.computed.map((site) => <p key={`${site.program} ${site.line}`} class="notice warn">{t.computed} <Site site={site} /></p>)}
      {machines.length > 0 && <SetupChoice machines={machines} value={choice.machine} onChoose={(machine) => onChoose({ ...choice, machine })} />}
      {hasMore && <label>{t.with}<input placeholder="O0210, O0220@3" autocomplete="off" value={choice.with} onChange={(e) => onChoose({ ...choice, with: e.currentTarget.value })} /></label>}
    </section>
  );
}
