// Repeatability and reproducibility: several machines have measured the same parts several times. Computed when it is asked for.
import { useState } from 'preact/hooks';
import type { GaugeComponent, GaugeStudy } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { CommandFault, useCommand } from '../parts/command';
import { numberText, texts } from '../texts/texts';
import { gaugeOf, type Choices, type GaugeChoice } from './tolerance';

const kSources = ['repeatability', 'reproducibility', 'gauge', 'parts'] as const;

function Source({ name, of }: { name: (typeof kSources)[number]; of: GaugeComponent }) {
  return (
    <tr>
      <th scope="row">{texts().studies.sources[name]}</th>
      <td class="number">{numberText(of.deviation, 5)}</td>
      <td class="number">{numberText(of.study_percent, 1)} %</td>
      <td class="number">{numberText(of.contribution_percent, 1)} %</td>
    </tr>
  );
}

function Result({ study }: { study: GaugeStudy }) {
  const t = texts().studies;
  const heads: Array<[string, boolean]> = [[t.source, false], [t.deviation, true], [t.ofStudy, true], [t.ofVariance, true]];
  return (
    <div role="status">
      <div class="scroll" tabIndex={0} role="group" aria-labelledby="gauge">
        <table class="data">
          <thead><tr>{heads.map(([name, isNumber]) => <th scope="col" key={name} class={isNumber ? 'number' : ''}>{name}</th>)}</tr></thead>
          <tbody>{kSources.map((name) => <Source key={name} name={name} of={study[name]} />)}</tbody>
        </table>
      </div>
      <p>{t.categories(study.distinct_categories)}{study.tolerance_percent !== null && ` ${t.ofTolerance(numberText(study.tolerance_percent, 1))}`}</p>
    </div>
  );
}

export function Gauge({ choices }: { choices: Choices }) {
  const t = texts().studies;
  const command = useCommand();
  const [choice, setChoice] = useState<GaugeChoice>({ method: 'anova', tolerance: '' });
  const [study, setStudy] = useState<GaugeStudy | null>(null);
  const compute = (event: Event) => {
    event.preventDefault();
    setStudy(null);
    void command.send(async () => setStudy(await get<GaugeStudy>(pathOf('measurements', 'gauge'), gaugeOf(choices, choice))));
  };
  const set = (changed: Partial<GaugeChoice>) => {
    setChoice({ ...choice, ...changed });
    setStudy(null);
  };
  return (
    <details>
      <summary class="button">{t.gauge}</summary>
      <section class="panel study" aria-labelledby="gauge">
        <h2 id="gauge">{t.gaugeOf(choices.characteristic)}</h2>
        <p class="hint">{t.gaugeHint}</p>
        <form class="with-button" onSubmit={compute}>
          <label>
            {t.method}
            <select value={choice.method} onChange={(e) => set({ method: e.currentTarget.value as GaugeChoice['method'] })}>
              {(['anova', 'ranges'] as const).map((method) => <option key={method} value={method}>{t.methods[method]}</option>)}
            </select>
          </label>
          <label>{t.tolerance}<input type="number" min="0" step="any" placeholder={t.noTolerance} value={choice.tolerance} onInput={(e) => set({ tolerance: e.currentTarget.value })} /></label>
          <button type="submit" class="primary" disabled={command.isBusy}>{t.compute}</button>
        </form>
        <CommandFault command={command} />
        {study && <Result study={study} />}
      </section>
    </details>
  );
}
