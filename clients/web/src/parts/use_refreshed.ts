// Loads what the server has no event for, again and again.
import { useEffect } from 'preact/hooks';
import { useLoaded, type Loaded } from './use_loaded';

/// `intervalOf`: by what was loaded last; null: nothing yet.
export function useRefreshed<T>(load: (signal: AbortSignal) => Promise<T>, intervalOf: (value: T | null) => number): Loaded<T> {
  const loaded = useLoaded(load, []);
  const intervalMs = intervalOf(loaded.value);
  useEffect(() => {
    const timer = setInterval(loaded.reload, intervalMs);
    return () => clearInterval(timer);
  }, [intervalMs]);
  return loaded;
}
