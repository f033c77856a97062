// What a role may do, as the server's table has it (server/identity/permission.cpp, `x-permission` in openapi.json). Pure.
import type { Session } from '../../generated/api';

export type Role = Session['role'];
export type Permission = 'view' | 'operate' | 'program' | 'set_up' | 'approve' | 'administer';

export const kRoles: Role[] = ['viewer', 'operator', 'programmer', 'approver', 'administrator'];
export const kLowestRoles: Record<Permission, Role> = {
  view: 'viewer', operate: 'operator', program: 'programmer', set_up: 'programmer', approve: 'approver', administer: 'administrator',
};

export function hasRole(role: Role, needs: Role): boolean {
  return kRoles.indexOf(role) >= kRoles.indexOf(needs);
}

/// The role is too low, or none of the caller's groups has the machine.
export type Refusal = { needs: Role } | { machine: string };

/// `machines`: those of the session's groups; null: every machine.
export function refusalOf(session: Session, machines: Set<string> | null, permission: Permission, machine?: string): Refusal | null {
  const needs = kLowestRoles[permission];
  if (!hasRole(session.role, needs)) return { needs };
  return machine !== undefined && machines !== null && !machines.has(machine) ? { machine } : null;
}
