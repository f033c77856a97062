// How far a revision is: the steps that the policy has from here, with a comment, and who took which before.
import { useState } from 'preact/hooks';
import type { Closure, Decision, Pin, ReleasePolicy, Revision, RevisionStates } from '../../generated/api';
import { get, pathOf, send } from '../api/request';
import { addressOf } from '../app/route';
import { refusalText, useSessionState } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { Loading } from '../parts/loading';
import { RevisionPill } from '../parts/revision_pill';
import { SureButton } from '../parts/sure_button';
import { useLoaded, type Loaded } from '../parts/use_loaded';
import { dateTimeText, texts } from '../texts/texts';
import { canPin, releaseOf, type ClosureChoice } from './calls';
import { saveText } from './download';
import { stepsOf, type OfferedStep, type Step, type StepRefusal } from './release_steps';

const kMaxComment = 1024;

function stepRefusalText(refusal: StepRefusal): string {
  return 'isOwn' in refusal ? texts().release.fourEyes : refusalText(refusal);
}

interface StepsProps extends ClosureProps {
  revision: Revision;
  steps: OfferedStep[];
  onDecided: () => void;
}

function Steps({ revision, steps, closure, choice, onDecided }: StepsProps) {
  const t = texts().release;
  const command = useCommand();
  const [comment, setComment] = useState('');
  const isEmpty = comment.trim() === '';
  const canRelease = steps.some(({ step, refusal }) => step === 'release' && refusal === null);
  const hasCalls = closure !== null && (closure.calls.length > 0 || closure.computed.length > 0);
  // Unless the user decides, what is called is released along when it can be: a later subprogram changes nothing then.
  const [chosen, setChosen] = useState<boolean | null>(null);
  const isPinning = canRelease && hasCalls && (chosen ?? canPin(closure));
  const take = async (step: Step) => {
    const json = { ...(!isEmpty && { comment: comment.trim() }), ...(step === 'release' && releaseOf(isPinning, choice)) };
    if (!(await command.send(() => send('POST', pathOf('programs', revision.program, 'revisions', revision.revision, step), { json })))) return;
    setComment('');
    onDecided();
  };
  const refusals = [...new Set(steps.flatMap(({ step, refusal }) => (refusal ? [`${t.steps[step]}: ${stepRefusalText(refusal)}`] : [])))];
  const needing = steps.filter((offered) => offered.needsComment && offered.refusal === null).map(({ step }) => t.steps[step]);
  return (
    <>
      <label>
        {t.comment}
        <input value={comment} maxLength={kMaxComment} disabled={steps.every(({ refusal }) => refusal !== null)} onInput={(e) => setComment(e.currentTarget.value)} />
      </label>
      {needing.length > 0 && isEmpty && <p class="hint">{t.needsComment(needing.join(', '))}</p>}
      {canRelease && hasCalls && (
        <label class="check"><input type="checkbox" checked={isPinning} onChange={(e) => setChosen(e.currentTarget.checked)} />{texts().library.pin(closure.calls.length)}</label>
      )}
      <p class="buttons">
        {steps.map(({ step, needsComment, refusal }) => (
          <SureButton key={step} class={step === 'reject' || step === 'withdraw' ? 'danger' : 'primary'} label={t.steps[step]}
            question={t.sure(t.steps[step], revision.program, revision.revision) + (step === 'release' && isPinning ? texts().library.pinSure(closure!.calls.length) : '')} disabled={refusal !== null || (needsComment && isEmpty) || command.isBusy}
            onSure={() => void take(step)} />
        ))}
      </p>
      {refusals.map((text) => <p key={text} class="hint">{text}</p>)}
      <CommandFault command={command} />
    </>
  );
}

function Pinned({ pins }: { pins: Pin[] }) {
  const links = pins.map((pin, i) => (
    <span key={pin.program}>{i > 0 && ', '}<a href={addressOf('programs', [pin.program, String(pin.revision)])}>{pin.program}</a> {texts().machine.revision(pin.revision)}</span>
  ));
  return <p>{texts().library.pinned} {links}</p>;
}

function History({ decisions }: { decisions: Decision[] }) {
  const t = texts().release;
  return (
    <ol class="list decisions" aria-label={t.history}>
      {[...decisions].reverse().map((decision) => (
        <li key={decision.id}>
          <b>{t.done[decision.step]}</b> <span class="muted">{decision.who}, {dateTimeText(decision.time)} · {t.number(decision.id)}</span>
          {decision.comment !== null && <p class="record-text">{decision.comment}</p>}
          {decision.closure !== null && <Pinned pins={decision.closure} />}
        </li>
      ))}
    </ol>
  );
}

function ruleText(policy: ReleasePolicy): string {
  const t = texts().release;
  return policy.runs === 'open' ? t.runsOpen : policy.prove_out.machines.length > 0 ? t.runsReleasedBut(policy.prove_out.machines.join(', ')) : t.runsReleased;
}

interface ClosureProps {
  /// null: not known, or not yet.
  closure: Closure | null;
  choice: ClosureChoice;
}

interface Props extends ClosureProps {
  policy: Loaded<ReleasePolicy>;
  revision: Revision;
  /// All of the program.
  revisions: Revision[];
  onDecided: () => void;
}

export function ReleaseState({ policy, revision, revisions, closure, choice, onDecided }: Props) {
  const t = texts().release;
  const session = useSessionState();
  const states = useLoaded(
    (signal) => get<RevisionStates>(pathOf('programs', revision.program, 'revisions', revision.revision, 'states'), {}, signal),
    [revision.program, revision.revision, revision.state]);
  const steps = policy.value && 'session' in session ? stepsOf(policy.value, revision, revisions, session.session) : [];
  const { value } = states;
  return (
    <section class="panel" aria-labelledby="release">
      <div class="head"><h2 id="release">{t.title}</h2><RevisionPill revision={revision} /></div>
      {policy.value && <p class="hint">{ruleText(policy.value)}</p>}
      <Loading of={policy} />
      {steps.length > 0 && <Steps key={revision.revision} revision={revision} steps={steps} closure={closure} choice={choice} onDecided={onDecided} />}
      {states.fault !== null && <Loading of={states} />}
      {value && value.steps.length > 0 && (
        <>
          <h3>{t.history}</h3>
          <History decisions={value.steps} />
          <p class="buttons">
            <button type="button" onClick={() => saveText(JSON.stringify(value, null, 2), `${revision.program}-${revision.revision}.json`)}>{t.signatures}</button>
          </p>
        </>
      )}
    </section>
  );
}
