// The server's release policy: what the steps of a revision need, and what machines run. It changes only when the server starts again.
import type { ReleasePolicy } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { useLoaded, type Loaded } from './use_loaded';

export function usePolicy(): Loaded<ReleasePolicy> {
  return useLoaded((signal) => get<ReleasePolicy>(pathOf('release-policy'), {}, signal), []);
}
