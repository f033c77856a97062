// Around what only some roles may do: for the others its controls are disabled, and the reason is beside them.
import type { ComponentChildren } from 'preact';
import { useReducer, useEffect } from 'preact/hooks';
import type { Permission, Refusal } from '../api/permissions';
import { findRefusal, onSession, sessionState } from '../api/session';
import { texts } from '../texts/texts';

export function useSessionState() {
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  useEffect(() => onSession(() => redraw(undefined)), []);
  return sessionState();
}

/// null: the caller may.
export function useRefusal(permission: Permission, machine?: string): Refusal | null {
  useSessionState();
  return findRefusal(permission, machine);
}

export function refusalText(refusal: Refusal): string {
  const t = texts().session;
  const state = sessionState();
  if ('machine' in refusal) return t.noGroup(refusal.machine);
  return t.needsRole('session' in state ? t.roles[state.session.role] : '', t.roles[refusal.needs]);
}

/// Unlike Allowed, what a role may not do is not even loaded.
export function Only({ to, children }: { to: Permission; children: ComponentChildren }) {
  return useRefusal(to) === null ? <>{children}</> : <Allowed to={to}>{null}</Allowed>;
}

/// The same element in both cases, so that a change of rights loses nothing that was typed.
export function Allowed({ to, machine, children }: { to: Permission; machine?: string; children: ComponentChildren }) {
  const refusal = useRefusal(to, machine);
  return (
    <fieldset class="allowed" disabled={refusal !== null}>
      {refusal !== null && <p class="notice refusal">{refusalText(refusal)}</p>}
      {children}
    </fieldset>
  );
}
