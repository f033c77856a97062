// On which runs a template can be tried: those that reported something, its own first. Pure.
import type { Run, TemplateAssignment } from '../../generated/api';

function isOf({ program, machine }: Run, assignments: TemplateAssignment[]): boolean {
  return assignments.some(({ scope, subject }) => (scope === 'program' && subject === program) || (scope === 'machine' && subject === machine));
}

/// In their order otherwise, the newest first.
export function runsFor(runs: Run[], assignments: TemplateAssignment[]): Run[] {
  const reporting = runs.filter(({ outputs }) => outputs > 0);
  return [...reporting.filter((run) => isOf(run, assignments)), ...reporting.filter((run) => !isOf(run, assignments))];
}
