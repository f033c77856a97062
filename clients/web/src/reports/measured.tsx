// The measured values of a run as a chart, with limits. Series and limits are part of the address.
import type { Record as ReportRecord } from '../../generated/api';
import { addressOf } from '../app/route';
import { numberText, texts } from '../texts/texts';
import { Chart } from './chart';
import { readLimit, seriesOf, summaryOf } from './series';

export function Measured({ run, records, query }: { run: string; records: ReportRecord[]; query: URLSearchParams }) {
  const t = texts().reports;
  const all = seriesOf(records);
  const shown = all.find((series) => series.name === query.get('series')) ?? all[0];
  if (!shown) return null;
  const limits = { lower: readLimit(query.get('lower')), upper: readLimit(query.get('upper')) };
  const summary = summaryOf(shown.values, limits);
  const choose = (changed: Record<string, string>) => {
    const now = { series: shown.name, lower: query.get('lower') ?? '', upper: query.get('upper') ?? '' };
    location.replace(addressOf('reports', [run], { ...now, ...changed }));
  };
  const text = t.summary(String(summary.count), numberText(summary.smallest, 4), numberText(summary.largest, 4), numberText(summary.mean, 4));
  return (
    <section class="panel" aria-labelledby="measured">
      <h2 id="measured">{t.measured}</h2>
      <div class="tools">
        <label>{t.series}<select value={shown.name} onChange={(e) => choose({ series: e.currentTarget.value })}>{all.map(({ name }) => <option key={name}>{name}</option>)}</select></label>
        <label>{t.lower}<input inputMode="decimal" value={query.get('lower') ?? ''} onChange={(e) => choose({ lower: e.currentTarget.value })} /></label>
        <label>{t.upper}<input inputMode="decimal" value={query.get('upper') ?? ''} onChange={(e) => choose({ upper: e.currentTarget.value })} /></label>
      </div>
      <Chart key={shown.name} series={shown} limits={limits} label={t.chartOf(shown.name, text)} />
      <p>{text}{(limits.lower !== null || limits.upper !== null) && <b class={summary.outside > 0 ? 'outside' : ''}> {t.outside(summary.outside)}</b>}</p>
    </section>
  );
}
