// Loads what the server has no event for, again and again.
import { useEffect } from 'preact/hooks';
import { useLoaded, type Loaded } from './use_loaded';

export function useRefreshed<T>(load: (signal: AbortSignal) => Promise<T>, intervalMs: number): Loaded<T> {
  const loaded = useLoaded(load, []);
  useEffect(() => {
    const timer = setInterval(loaded.reload, intervalMs);
    return () => clearInterval(timer);
  }, [intervalMs]);
  return loaded;
}
