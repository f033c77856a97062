// A control chart, histogram or trend, drawn by the server and shown as a picture: nothing in it runs.
import { useEffect, useRef } from 'preact/hooks';
import { fetchApi, pathOf, withQuery } from '../api/request';
import { feed } from '../live/feed';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { saveText } from '../programs/download';
import { texts } from '../texts/texts';
import { chartOf, type Choices } from './tolerance';

const kWide = { width: 1120, height: 560 };
const kNarrow = { width: 720, height: 540 };
const kPhone = { width: 400, height: 460 };

export function ChartPicture({ choices }: { choices: Choices }) {
  const t = texts().measurements;
  const { current: size } = useRef(innerWidth < 500 ? kPhone : innerWidth < 1000 ? kNarrow : kWide);
  const request = withQuery(pathOf('measurements', 'chart'), { ...chartOf(choices), ...size });
  const picture = useLoaded(async (signal) => ({ request, svg: await (await fetchApi('GET', request, {}, signal)).text() }), [request]);
  useEffect(() => feed.on('parts', picture.reload), []);
  // What was chosen before is not shown as what is chosen now.
  const shown = picture.value?.request === request && picture.fault === null ? picture.value.svg : null;
  const name = `${choices.characteristic}-${choices.kind || 'individuals'}.svg`;
  return (
    <section class="panel" aria-labelledby="chart">
      <div class="head">
        <h2 id="chart">{t.chartTitle(choices.characteristic)}</h2>
        {shown !== null && <button type="button" onClick={() => saveText(shown, name)}>{t.savePicture}</button>}
      </div>
      {picture.fault !== null ? <p class="notice warn" role="status">{picture.fault}</p> : shown === null && <Loading of={{ ...picture, value: null }} />}
      {shown !== null && <img class="chart-picture" src={`data:image/svg+xml;charset=utf-8,${encodeURIComponent(shown)}`} alt={t.chartOf(t.kinds[(choices.kind || 'individuals') as keyof typeof t.kinds] ?? choices.kind, choices.characteristic)} {...size} />}
    </section>
  );
}
