// Loads what a view shows besides the feed, again when one of `inputs` changes, when the server is back, or when asked to.
import { useCallback, useEffect, useRef, useState } from 'preact/hooks';
import { feed } from '../live/feed';
import { faultText } from './command';

export interface Loaded<T> {
  /// What was loaded last, also while something newer is on its way; null: nothing yet.
  value: T | null;
  fault: string | null;
  reload(): void;
}

export function useLoaded<T>(load: (signal: AbortSignal) => Promise<T>, inputs: unknown[]): Loaded<T> {
  const [state, setState] = useState<{ value: T | null; fault: string | null }>({ value: null, fault: null });
  const [count, setCount] = useState(0);
  const reload = useCallback(() => setCount((before) => before + 1), []);
  useEffect(() => {
    const ending = new AbortController();
    load(ending.signal).then(
      (value) => { if (!ending.signal.aborted) setState({ value, fault: null }); },
      (failure: unknown) => { if (!ending.signal.aborted) setState((before) => ({ ...before, fault: faultText(failure, false) })); });
    return () => ending.abort();
  }, [...inputs, count]);
  const hasFailed = useRef(false);
  hasFailed.current = state.fault !== null;
  useEffect(() => {
    let { link } = feed;
    return feed.on('link', () => {
      // The first connection is no return of the server, and what was loaded while it was made is current; nor is one that was
      // made before this began to listen, whose word comes a little later.
      const isBack = feed.link !== link && link.state !== 'connecting';
      if (feed.link.state === 'live' && (isBack || hasFailed.current)) reload();
      link = feed.link;
    });
  }, []);
  return { ...state, reload };
}
