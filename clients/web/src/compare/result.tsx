// What a comparison of two revisions has found: a sentence, the class of the edit, the places where the motion differs, both texts.
import type { Comparison } from '../../generated/api';
import type { ProgramRevision } from '../path/block_text';
import { numberText, texts } from '../texts/texts';
import { Conditions, distanceText, Places } from './motion';
import { SideBySide } from './side_by_side';

function summaryOf({ by, text, motion }: Comparison): string {
  const t = texts().compare;
  if (motion && motion.same)
    return motion.conditions.length > 0 ? t.sameOnConditions : t.sameMotion(String(motion.tolerance), numberText(motion.actions.first));
  if (motion) return t.differentMotion(t.places(numberText(motion.place_count)), distanceText(motion.max_distance));
  if (text.same) return by === 'normalized' ? t.sameNormalized : t.sameText;
  return t.differentText(t.places(numberText(text.hunk_count)), numberText(text.removed), numberText(text.added));
}

export function Result({ result, from, to }: { result: Comparison; from: ProgramRevision; to: ProgramRevision }) {
  const t = texts().compare;
  const { motion, text } = result;
  return (
    <>
      <section class="panel" aria-labelledby="result" data-complete="true">
        <h2 id="result">{t.result}</h2>
        <p class={`notice ${result.same ? 'good' : ''}`} role="status"><b>{summaryOf(result)}</b></p>
        <p>{t.editClass}: <b>{t.classes[result.class]}</b>.</p>
        {result.by === 'normalized' && <p class="hint">{t.normalizedHint}</p>}
        {motion?.across_controls && <p class="hint">{t.acrossControls}</p>}
        {motion && <Conditions motion={motion} from={from} to={to} />}
      </section>
      {motion && <Places motion={motion} from={from} to={to} />}
      {!text.same && (
        <section class="panel" aria-labelledby="texts">
          <h2 id="texts">{t.sideBySide}</h2>
          <SideBySide text={text} from={t.around(from.revision)} to={t.around(to.revision)} />
          {!text.complete && <p class="notice">{t.notComplete}</p>}
        </section>
      )}
    </>
  );
}
