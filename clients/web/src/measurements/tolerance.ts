// Where a value is between its limits, for the eye; and the choices of a list of measurements, which are its address. Pure.
import type { Measurement } from '../../generated/api';

/// On a scale on which the limits are at a quarter and three quarters; what is farther out is at the edge.
export interface TolerancePlace {
  /// 0 to 1.
  actual: number;
  nominal: number | null;
  isOut: boolean;
}

const kEdge = 0.25;

/// null: it has not both limits, or no width between them that is a number.
export function placeOf({ lower, upper, nominal, actual }: Pick<Measurement, 'lower' | 'upper' | 'nominal' | 'actual'>): TolerancePlace | null {
  if (lower === null || upper === null || upper <= lower || !Number.isFinite(upper - lower)) return null;
  const scale = (value: number) => Math.min(1, Math.max(0, kEdge + ((1 - 2 * kEdge) * (value - lower)) / (upper - lower)));
  return { actual: scale(actual), nominal: nominal === null ? null : scale(nominal), isOut: actual < lower || actual > upper };
}

export const kChoices = ['characteristic', 'machine', 'run', 'part', 'since', 'until', 'verdict', 'kind', 'rules', 'subgroup', 'shape'] as const;
export type Choice = (typeof kChoices)[number];
export type Choices = Record<Choice, string>;

export function choicesOf(query: URLSearchParams): Choices {
  return Object.fromEntries(kChoices.map((choice) => [choice, query.get(choice) ?? ''])) as Choices;
}

/// "2026-11-24T20:05", which the browser's field gives in its own time zone, as the server reads it; empty: no limit.
export function utcOf(local: string): string {
  const time = new Date(local);
  return local === '' || Number.isNaN(time.getTime()) ? '' : time.toISOString();
}

/// Which measurements, in the API's words.
export function filterOf({ characteristic, machine, run, part, since, until, verdict }: Choices) {
  return { characteristic, machine, run, part, since: utcOf(since), until: utcOf(until), verdict };
}

export const kKinds = ['individuals', 'xbar-r', 'xbar-s', 'ewma', 'cusum', 'histogram', 'trend'] as const;
export const kRules = ['limits', 'western_electric', 'nelson'] as const;

export const kShapes = ['normal', 'lognormal', 'empirical'] as const;

/// A chart or a study has no part and no verdict: it is of all values in their order.
function allOf({ characteristic, machine, run, since, until }: Choices) {
  return { characteristic, machine, run, since: utcOf(since), until: utcOf(until) };
}

export function chartOf(choices: Choices) {
  const { kind, rules, subgroup, shape } = choices;
  const hasRules = kind !== 'histogram' && kind !== 'trend';
  return { ...allOf(choices), kind, rules: hasRules ? rules : '', subgroup: kind.startsWith('xbar') ? subgroup : '', shape: kind === 'histogram' ? shape : '' };
}

/// Sigma within is that of the subgroups which the chart shows.
export function capabilityOf(choices: Choices) {
  return { ...allOf(choices), shape: choices.shape, subgroup: choices.kind.startsWith('xbar') ? choices.subgroup || '5' : '' };
}

export interface GaugeChoice {
  method: 'anova' | 'ranges';
  /// As it is typed; empty: none.
  tolerance: string;
}

export function gaugeOf(choices: Choices, { method, tolerance }: GaugeChoice) {
  return { ...allOf(choices), method, tolerance };
}
