// Where the motion of two revisions differs: a list, and both texts around the chosen place.
import { useState } from 'preact/hooks';
import type { ComparedBlock, ComparedMotion, ComparedPlace } from '../../generated/api';
import { BlockText, type ProgramRevision } from '../path/block_text';
import { numberText, texts } from '../texts/texts';

export function distanceText(mm: number): string {
  return mm.toFixed(mm < 0.01 ? 6 : 4);
}

function Block({ block }: { block: ComparedBlock }) {
  const t = texts().compare;
  const line = numberText(block.line);
  return (
    <span class="compared-block">
      <span class="muted">{block.called ? t.calledLine(line) : t.line(line)}</span>
      <span class="mono">{block.text}</span>
      <span>{block.actions === 0 ? t.nothing : block.action}{block.actions > 1 && ` ${t.more(numberText(block.actions - 1))}`}</span>
    </span>
  );
}

function Place({ place, isChosen, onChoose }: { place: ComparedPlace; isChosen: boolean; onChoose: () => void }) {
  const t = texts().compare;
  return (
    <li>
      <button type="button" class="compared-place" aria-pressed={isChosen} onClick={onChoose}>
        <b>{place.differences.map((difference) => t.differences[difference]).join(', ')}{place.distance !== null && ` · ${t.apart(distanceText(place.distance))}`}</b>
        <Block block={place.first} />
        <Block block={place.second} />
      </button>
    </li>
  );
}

function Around({ of, block }: { of: ProgramRevision; block: ComparedBlock }) {
  const t = texts().compare;
  return (
    <div>
      <h3>{t.around(of.revision)}</h3>
      {block.called ? <p class="muted">{t.calledLine(numberText(block.line))}</p> : <BlockText key={block.offset} of={of} line={block.line} offset={block.offset} />}
    </div>
  );
}

export function Conditions({ motion, from, to }: { motion: ComparedMotion; from: ProgramRevision; to: ProgramRevision }) {
  const t = texts().compare;
  if (motion.conditions.length === 0) return null;
  return (
    <div class="notice warn">
      <h3>{t.conditions}</h3>
      <ul>
        {motion.conditions.map((condition, i) => (
          <li key={i}>
            {t.conditionKinds[condition.kind]}{condition.text !== '' && <>: <b>{condition.text}</b></>} (
            {t.conditionAt((condition.program === 'first' ? from : to).revision, numberText(condition.line))}: <span class="mono">{condition.line_text}</span>)
          </li>
        ))}
      </ul>
    </div>
  );
}

export function Places({ motion, from, to }: { motion: ComparedMotion; from: ProgramRevision; to: ProgramRevision }) {
  const t = texts().compare;
  const [chosen, setChosen] = useState<number | null>(null);
  const place = chosen === null ? undefined : motion.places[chosen];
  if (motion.places.length === 0) return null;
  return (
    <section class="panel" aria-labelledby="places">
      <h2 id="places">{t.motionPlaces}</h2>
      <div class="compared-places">
        <ol aria-label={t.motionPlaces}>
          {motion.places.map((row, i) => <Place key={i} place={row} isChosen={i === chosen} onChoose={() => setChosen(i)} />)}
        </ol>
        <div aria-live="polite">
          {place ? <><Around of={from} block={place.first} /><Around of={to} block={place.second} /></> : <p class="muted">{t.choosePlace}</p>}
        </div>
      </div>
      {!motion.complete && <p class="notice">{t.notComplete}</p>}
    </section>
  );
}
