// The results of a capability or gauge study as text. Pure.
import type { Capability, CapabilityIndex } from '../../generated/api';
import { numberText, texts } from '../texts/texts';

const kIndexDigits = 2;
const kDigits = 5;

/// "1.33 (1.02 to 1.64)"; of a shape without a formula for it there is no interval.
export function indexText(index: CapabilityIndex | null): string {
  if (!index) return '–';
  const value = numberText(index.value, kIndexDigits);
  if (index.low === null || index.high === null) return value;
  return texts().studies.interval(value, numberText(index.low, kIndexDigits), numberText(index.high, kIndexDigits));
}

/// What the reader has to know besides the numbers.
export function remarksOf({ anderson_darling: test, shape, percentiles_reached, lower, upper }: Capability): string[] {
  const t = texts().studies;
  const remarks: string[] = [];
  if (shape === 'normal' && test && test.p_value < 0.05) remarks.push(t.notNormal(numberText(test.p_value, 3)));
  if (shape === 'empirical' && !percentiles_reached) remarks.push(t.fewForPercentiles);
  if (lower === null || upper === null) remarks.push(t.oneLimit);
  return remarks;
}

export function rowsOf(study: Capability): Array<[string, string]> {
  const t = texts().studies;
  const number = (value: number | null) => (value === null ? '–' : numberText(value, kDigits));
  const rows: Array<[string, string]> = [
    [t.values, numberText(study.count)], [t.mean, number(study.mean)], [t.deviation, number(study.standard_deviation)],
    [t.limits, `${number(study.lower)} … ${number(study.upper)}`],
  ];
  if (study.shape === 'normal') rows.push([t.within, number(study.sigma_within)]);
  else rows.push([t.percentiles, study.percentiles.map(number).join(' · ')]);
  rows.push([t.outside, t.belowAbove(numberText(study.below), numberText(study.above))], [t.expected, t.ppm(numberText(study.expected_outside_ppm, 1))]);
  if (study.anderson_darling) rows.push([t.normality, t.pValue(numberText(study.anderson_darling.p_value, 3))]);
  return rows;
}
