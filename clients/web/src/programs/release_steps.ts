// Which steps the policy and the caller's role leave for a revision, and which revisions a machine runs. The server decides anyway. Pure.
import type { Program, ReleasePolicy, Revision, Session } from '../../generated/api';
import { hasRole, type Role } from '../api/permissions';

export const kSteps = ['submit', 'approve', 'reject', 'release', 'withdraw'] as const;
export type Step = (typeof kSteps)[number];

/// A role that is too low, or a text that the caller has pushed.
export type StepRefusal = { needs: Role } | { isOwn: true };

export interface OfferedStep {
  step: Step;
  needsComment: boolean;
  refusal: StepRefusal | null;
}

/// `all`: the program's revisions, which may have the same bytes from another author.
export function stepsOf(policy: ReleasePolicy, revision: Revision, all: Revision[], caller: Session): OfferedStep[] {
  if (revision.held) return [];
  const isOwn = all.some((other) => other.sha256 === revision.sha256 && other.author === caller.user);
  return kSteps.filter((step) => policy.steps[step].from.includes(revision.state)).map((step) => {
    const rule = policy.steps[step];
    const refusal = !hasRole(caller.role, rule.role) ? { needs: rule.role } : rule.four_eyes && isOwn ? { isOwn: true as const } : null;
    return { step, needsComment: rule.comment, refusal };
  });
}

/// Why a machine does not run a revision; null: it does, as far as the policy goes.
export type RunRefusal = { why: 'withdrawn' | 'notReleased' } | { why: 'proveOut'; needs: Role };

export function runRefusalOf(policy: ReleasePolicy, state: Revision['state'], machine: string, caller: Session): RunRefusal | null {
  if (state === 'withdrawn') return { why: 'withdrawn' };
  if (policy.runs === 'open' || state === 'released') return null;
  if (!policy.prove_out.machines.includes(machine)) return { why: 'notReleased' };
  return hasRole(caller.role, policy.prove_out.role) ? null : { why: 'proveOut', needs: policy.prove_out.role };
}

/// The revision that a start names: the newest, if the machine runs it; null: the server takes the latest that the machine does run.
export function revisionToStart(policy: ReleasePolicy | null, program: Program, machine: string, caller: Session): number | null {
  const isRefused = policy === null ? program.state === 'withdrawn' : runRefusalOf(policy, program.state, machine, caller) !== null;
  return isRefused || program.held ? null : program.revision;
}
