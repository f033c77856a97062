// The values of tools and work offsets that were in force for a run, at all of its blocks; each leads to every value that it had.
import { useState } from 'preact/hooks';
import type { OffsetsInForce } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { addressOf } from '../app/route';
import { valueText } from '../corrections/steps';
import { Disclosure } from '../parts/disclosure';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { numberText, texts } from '../texts/texts';

function unitOf({ unit }: OffsetsInForce): 'mm' | 'in' {
  return unit === 'in' ? 'in' : 'mm';
}

function Values({ inForce }: { inForce: OffsetsInForce }) {
  const t = texts().corrections;
  const [wanted, setWanted] = useState('');
  const shown = inForce.values.filter(({ target }) => target.toLowerCase().startsWith(wanted.trim().toLowerCase()));
  return (
    <>
      <p>{inForce.last_block === 0 ? t.noBlocks : t.blocks(numberText(inForce.first_block), numberText(inForce.last_block))} {inForce.setup !== null && t.ofSetup(inForce.setup)}</p>
      <label class="tools">{t.target}<input autocomplete="off" placeholder="T3, T3.wear.X, G54" value={wanted} onInput={(e) => setWanted(e.currentTarget.value)} /></label>
      {shown.length === 0 ? <p class="muted">{t.noHistory}</p> : (
        <div class="scroll" tabIndex={0} role="group" aria-labelledby="in-force">
          <table class="data">
            <Heads of={[t.target, t.value]} />
            <tbody>
              {shown.map(({ target, value }) => (
                <tr key={target}>
                  <th scope="row" class="nowrap"><a class="target" href={addressOf('corrections', [inForce.machine], { target })}>{target}</a></th>
                  <td>{valueText(value, unitOf(inForce))}</td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
    </>
  );
}

function Shown({ run }: { run: string }) {
  const t = texts().corrections;
  const loaded = useLoaded((signal) => get<OffsetsInForce>(pathOf('runs', run, 'offsets'), {}, signal), [run]);
  const { value } = loaded;
  return (
    <section class="panel" aria-labelledby="in-force">
      <h2 id="in-force">{t.inForce}</h2>
      <Loading of={loaded} />
      {value && (value.setup === null ? <p class="muted">{t.withoutSetup}</p> : <Values inForce={value} />)}
    </section>
  );
}

export function RunOffsets({ run }: { run: string }) {
  return <Disclosure summary={texts().corrections.inForce}><Shown run={run} /></Disclosure>;
}
