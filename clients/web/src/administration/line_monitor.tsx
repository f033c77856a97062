// Every character of a line in both directions, as it passes.
import { useEffect, useState } from 'preact/hooks';
import type { Traffic } from '../../generated/api';
import { pathOf } from '../api/request';
import { readEvents } from '../live/event_stream';
import { faultText } from '../parts/command';
import { texts, timeText } from '../texts/texts';
import { readableBytes } from './bytes_text';

const kShown = 200;

export function LineMonitor({ port }: { port: string }) {
  const t = texts().administration;
  const [traffic, setTraffic] = useState<Traffic[]>([]);
  const [fault, setFault] = useState<string | null>(null);
  useEffect(() => {
    const ending = new AbortController();
    const waiting: Traffic[] = [];
    const show = setInterval(() => {
      if (waiting.length > 0) setTraffic((before) => [...before, ...waiting.splice(0)].slice(-kShown));
    }, 250);
    readEvents(pathOf('ports', port, 'traffic'), ending.signal, () => setFault(null), (event) => {
      if (event.name === 'traffic') waiting.push(JSON.parse(event.data) as Traffic);
    }).then(() => setFault(t.monitorEnded), (failure: unknown) => { if (!ending.signal.aborted) setFault(faultText(failure, false)); });
    return () => {
      clearInterval(show);
      ending.abort();
    };
  }, [port]);
  return (
    <>
      {fault !== null && <p class="notice warn" role="status">{fault}</p>}
      <ol class="records monitor" tabIndex={0} aria-label={t.monitorOf(port)}>
        {traffic.map((item, i) => (
          <li key={i} class={item.what}>
            <time dateTime={item.time}>{timeText(item.time)}</time><span class="kind">{t.traffic[item.what]}</span>
            <span class="text mono">{item.bytes === '' ? item.text : readableBytes(item.bytes)}</span>
          </li>
        ))}
      </ol>
    </>
  );
}
