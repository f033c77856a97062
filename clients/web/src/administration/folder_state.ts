// How a hot folder and a webhook are, as a color of the page. Pure.
import type { Folder, Webhook } from '../../generated/api';

/// A folder that cannot be read takes nothing; a file that was refused needs a look.
export function folderTone({ fault, waiting, failed, last_refused }: Folder): 'alarm' | 'waiting' | 'running' | 'ready' {
  if (fault !== null) return 'alarm';
  if (failed > 0 || last_refused !== null) return 'waiting';
  return waiting > 0 ? 'running' : 'ready';
}

export function webhookTone({ failures, lost }: Webhook): 'alarm' | 'waiting' | 'ready' {
  if (lost > 0) return 'alarm';
  return failures > 0 ? 'waiting' : 'ready';
}

export const kKinds: Webhook['kinds'] = ['revision', 'run', 'alarm', 'import', 'job', 'part'];

/// All of them is what a webhook without kinds gets, new ones too.
export function kindsToSend(chosen: Webhook['kinds']): { kinds?: Webhook['kinds'] } {
  return chosen.length === kKinds.length ? {} : { kinds: kKinds.filter((kind) => chosen.includes(kind)) };
}
