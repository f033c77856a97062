// One machine of the floor. It listens to its own machine alone, so that a change draws one card, and while it is not in sight only now and then.
import { memo } from '../parts/memo';
import { addressOf } from '../app/route';
import { questionOf } from '../live/machine_state';
import { durationText, percentDigits, progressOf } from '../live/progress';
import { useFeedNear } from '../live/use_feed';
import { StatePill } from '../parts/state_pill';
import { bufferedText, dateTimeText, numberText, texts } from '../texts/texts';
import { useNear } from './use_near';

export const MachineCard = memo(function MachineCard({ name }: { name: string }) {
  const { ref, isNear } = useNear<HTMLLIElement>();
  const feed = useFeedNear(`machine:${name}`, isNear);
  const t = texts().floor;
  const machine = feed.machines.get(name);
  if (!machine) return null;
  const run = feed.runOf(machine);
  const state = feed.stateOf(machine);
  const { status } = machine;
  const message = questionOf(machine) ?? state.message;
  const program = status?.program ?? run?.program; // the one that ended last
  const progress = machine.connected ? progressOf(status, run) : null;
  return (
    <li ref={ref} class={`card ${state.tone}`} data-machine={name} data-time={status?.time}>
      <div class="head">
        <h2><a href={addressOf('machine', [name])} aria-label={t.open(name)}>{name}</a></h2>
        <StatePill state={state} />
      </div>
      <p class="sub">{[machine.control, machine.description].filter(Boolean).join(' · ')}</p>
      <p class="program">
        <span class={program ? 'value' : 'muted'}>{program ?? t.noProgram}</span>
        {status?.program && <span class="muted"> {t.line(status.line)}</span>}
      </p>
      {progress && (
        <div class="progress-row">
          <progress value={progress.fraction} max={1} aria-label={t.progress} />
          <span>{numberText(progress.fraction * 100, percentDigits(progress.fraction))} %</span>
          {progress.secondsLeft !== null && <span class="muted">{t.timeLeft(durationText(progress.secondsLeft))}</span>}
        </div>
      )}
      {!machine.connected && <p class="muted">{t.lastSeen(dateTimeText(machine.last_seen))}</p>}
      {message && <p class="message">{message}</p>}
      {machine.held && <p class="message">{t.heldBy(machine.held.who, machine.held.reason)}</p>}
      {machine.queue_hold && <p class="message">{t.queueHeldBy(machine.queue_hold.reason)}</p>}
      {machine.notices.map((notice) => <p key={notice} class="message">{notice}</p>)}
      {machine.connected && status?.run && (
        <dl class="facts">
          <dt>{t.buffered}</dt><dd>{bufferedText(status.buffered_seconds)}</dd>
          <dt>{t.feedOverride}</dt><dd>{numberText(status.feed_override * 100)} %</dd>
        </dl>
      )}
    </li>
  );
});
