// Reads an event stream of the API over fetch(), which can carry the sign-in; the browser's EventSource cannot.
import { fetchApi } from '../api/request';
import { EventParser, type StreamEvent } from './event_parser';

/// The server writes something at least every 3 s; a silence of this length means that the line is dead, or the server frozen: another one may have taken over.
const kLongestSilenceMs = 10_000;

/// Returns when the stream has ended or `signal` says so; throws what keeps it from beginning.
export async function readEvents(path: string, signal: AbortSignal, onOpen: () => void, onEvent: (event: StreamEvent) => void): Promise<void> {
  const ending = new AbortController();
  const end = () => ending.abort();
  signal.addEventListener('abort', end);
  let watch = setTimeout(end, kLongestSilenceMs);
  try {
    const response = await fetchApi('GET', path, {}, ending.signal);
    const reader = response.body!.pipeThrough(new TextDecoderStream()).getReader();
    const parser = new EventParser();
    onOpen();
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return;
      clearTimeout(watch);
      watch = setTimeout(end, kLongestSilenceMs);
      for (const event of parser.take(value)) onEvent(event);
    }
  } finally {
    end(); // also when an event was refused
    clearTimeout(watch);
    signal.removeEventListener('abort', end);
  }
}
