// Cp, Cpk, Pp and Ppk of a characteristic with their intervals, beside its chart and of the same values.
import { useEffect } from 'preact/hooks';
import type { Capability as Study } from '../../generated/api';
import { get, pathOf, withQuery } from '../api/request';
import { feed } from '../live/feed';
import { Loading } from '../parts/loading';
import { Rows } from '../parts/rows';
import { useLoaded } from '../parts/use_loaded';
import { numberText, texts } from '../texts/texts';
import { indexText, remarksOf, rowsOf } from './study';
import { capabilityOf, kShapes, type Choices } from './tolerance';

const kIndices = ['cp', 'cpk', 'pp', 'ppk'] as const;

function Indices({ study }: { study: Study }) {
  const t = texts().studies;
  return (
    <dl class="indices">
      {kIndices.filter((name) => study.shape === 'normal' || name === 'pp' || name === 'ppk').map((name) => (
        <div key={name}><dt title={t.names[name]}>{t.indices[name]}</dt><dd>{indexText(study[name])}</dd></div>
      ))}
    </dl>
  );
}

export function Capability({ choices, choose }: { choices: Choices; choose: (changed: Partial<Choices>) => void }) {
  const t = texts().studies;
  const request = withQuery(pathOf('measurements', 'capability'), capabilityOf(choices));
  const loaded = useLoaded(async (signal) => ({ request, study: await get<Study>(request, {}, signal) }), [request]);
  useEffect(() => feed.on('parts', loaded.reload), []);
  // What was chosen before is not shown as what is chosen now.
  const study = loaded.value?.request === request && loaded.fault === null ? loaded.value.study : null;
  return (
    <section class="panel study" aria-labelledby="capability">
      <div class="head">
        <h2 id="capability">{t.capability}</h2>
        <label class="inline">
          {t.shape}{' '}
          <select value={choices.shape || 'normal'} onChange={(e) => choose({ shape: e.currentTarget.value === 'normal' ? '' : e.currentTarget.value })}>
            {kShapes.map((shape) => <option key={shape} value={shape}>{t.shapes[shape]}</option>)}
          </select>
        </label>
      </div>
      {loaded.fault !== null ? <p class="notice warn" role="status">{loaded.fault}</p> : study === null && <Loading of={{ ...loaded, value: null }} />}
      {study && (
        <>
          <Indices study={study} />
          <p class="hint">{t.confidence(numberText(study.confidence * 100))}</p>
          {remarksOf(study).map((remark) => <p key={remark} class="notice warn">{remark}</p>)}
          <Rows of={rowsOf(study)} />
        </>
      )}
    </section>
  );
}
