// In place of what is not there yet, or could not be loaded.
import type { Loaded } from './use_loaded';
import { texts } from '../texts/texts';

export function Loading({ of }: { of: Loaded<unknown> }) {
  if (of.fault !== null) return <p class="notice bad" role="alert">{of.fault}</p>;
  return of.value === null ? <p class="muted" role="status">{texts().app.loading}</p> : null;
}
