// Who is signed in. The server knows by a cookie that no script can read; the page keeps nothing that proves it.
import type { MachineGroups, Session } from '../../generated/api';
import { ApiError, get, onStatus, pathOf, send } from './request';
import type { Permission } from './permissions';
import { refusalOf, type Refusal } from './permissions';

/// `expired`: the session has ended while the page was open. What is on screen stays until a user signs in.
export type SessionState = { is: 'unknown' } | { is: 'out' } | { is: 'in'; session: Session } | { is: 'expired'; session: Session };

const kRetryMs = 1000;

let state: SessionState = { is: 'unknown' };
/// The machines of the session's groups; null: every machine.
let machines: Set<string> | null = null;
const listeners = new Set<() => void>();

export function sessionState(): SessionState {
  return state;
}

export function onSession(listener: () => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

/// What keeps the caller from it; null: nothing. The server decides anyway.
export function findRefusal(permission: Permission, machine?: string): Refusal | null {
  return 'session' in state ? refusalOf(state.session, machines, permission, machine) : null;
}

/// Asks the server whether this browser is signed in, until it answers.
export async function beginSession(): Promise<void> {
  while (state.is === 'unknown') {
    try {
      await refreshSession();
    } catch (failure) {
      if (failure instanceof ApiError && failure.status === 401) change({ is: 'out' });
      else await new Promise((done) => setTimeout(done, kRetryMs));
    }
  }
}

export interface SignIn {
  user: string;
  password: string;
  /// Of the session; the server's usual time without it.
  hours?: number;
}

export async function signIn({ user, password, hours }: SignIn): Promise<void> {
  await enter(await send<Session>('POST', pathOf('session'), { json: { user, password, ...(hours !== undefined && { hours }) } }));
}

/// For a user who has no password yet: one of the user's tokens allows to set it. The token is sent and not kept.
export async function setFirstPassword(token: string, password: string): Promise<void> {
  const secret = { Authorization: `Bearer ${token}` };
  const { user } = await get<Session>(pathOf('session'), {}, undefined, secret);
  await send('PUT', pathOf('users', user, 'password'), { json: { password }, headers: secret });
  await signIn({ user, password });
}

export async function signOut(): Promise<void> {
  try {
    await send('DELETE', pathOf('session'));
  } catch (failure) {
    if (!(failure instanceof ApiError && failure.status === 401)) throw failure;
  }
  change({ is: 'out' });
}

/// Role and groups may have changed.
export async function refreshSession(): Promise<void> {
  await enter(await get<Session>(pathOf('session')));
}

async function enter(session: Session): Promise<void> {
  machines = await machinesOf(session);
  change({ is: 'in', session });
}

async function machinesOf(session: Session): Promise<Set<string> | null> {
  if (session.role === 'administrator' || session.groups.includes('all')) return null;
  const { groups } = await get<MachineGroups>(pathOf('machine-groups'));
  return new Set(groups.filter((group) => session.groups.includes(group.name)).flatMap((group) => group.machines));
}

function change(next: SessionState): void {
  state = next;
  for (const listener of [...listeners]) listener();
}

onStatus((status) => {
  if (status === 401 && state.is === 'in') change({ is: 'expired', session: state.session });
  if (status === 403 && state.is === 'in') refreshSession().catch(() => {}); // the next request finds out
});
