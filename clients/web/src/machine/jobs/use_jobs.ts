// The open jobs of a machine, in their order. A run of a job comes as an event; what others change in the queue does not, so that it is looked at again.
import { useEffect } from 'preact/hooks';
import type { JobList } from '../../../generated/api';
import { get, pathOf } from '../../api/request';
import { feed } from '../../live/feed';
import type { Loaded } from '../../parts/use_loaded';
import { useRefreshed } from '../../parts/use_refreshed';

const kIntervalMs = 5000;
const kMaxJobs = 1000;

/// `machine` stays the same as long as the view does.
export function useJobs(machine: string): Loaded<JobList> {
  const jobs = useRefreshed((signal) => get<JobList>(pathOf('machines', machine, 'jobs'), { limit: kMaxJobs }, signal), () => kIntervalMs);
  useEffect(() => feed.on('runs', jobs.reload), [machine]);
  return jobs;
}
