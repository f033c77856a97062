// The open jobs of a machine, in their order: read again when its queue was changed, a run of the machine has begun or ended, or one of its parts was measured.
import { useEffect } from 'preact/hooks';
import type { JobList } from '../../../generated/api';
import { get, pathOf } from '../../api/request';
import { feed } from '../../live/feed';
import { useLoaded, type Loaded } from '../../parts/use_loaded';

const kMaxJobs = 1000;

export function useJobs(machine: string): Loaded<JobList> {
  const jobs = useLoaded((signal) => get<JobList>(pathOf('machines', machine, 'jobs'), { limit: kMaxJobs }, signal), [machine]);
  useEffect(() => {
    const ends = [feed.on(`jobs:${machine}`, jobs.reload), feed.on(`runs:${machine}`, jobs.reload), feed.on(`parts:${machine}`, jobs.reload)];
    return () => ends.forEach((end) => end());
  }, [machine]);
  return jobs;
}
