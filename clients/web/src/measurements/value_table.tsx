// Measurements as rows: the value, what it must be, and where between its limits it is.
import type { Measurement } from '../../generated/api';
import { addressOf } from '../app/route';
import { VerdictPill } from '../parts/verdict_pill';
import { dateTimeText, numberText, texts } from '../texts/texts';
import { placeOf } from './tolerance';

/// The limits are at a quarter and three quarters of the bar.
function ToleranceBar({ of }: { of: Measurement }) {
  const place = placeOf(of);
  if (!place) return <>–</>;
  const x = (at: number) => 4 + at * 112;
  return (
    <svg class={`tolerance ${place.isOut ? 'out' : ''}`} viewBox="0 0 120 20" width="120" height="20" aria-hidden="true">
      <rect class="allowed" x={x(0.25)} y="4" width="56" height="12" />
      {place.nominal !== null && <line class="nominal" x1={x(place.nominal)} x2={x(place.nominal)} y1="3" y2="17" />}
      <circle class="actual" cx={x(place.actual)} cy="10" r="4" />
    </svg>
  );
}

const kUnits: Record<string, string> = { deg: '°' };

export function valueText(value: number | null, { decimals, unit }: Measurement, isSigned = false): string {
  if (value === null) return '–';
  return `${isSigned && value > 0 ? '+' : ''}${numberText(value, decimals)}\u00a0${kUnits[unit] ?? unit}`;
}

/// "0.9900 … 1.0100": in the unit of the values beside them.
function limitsText({ lower, upper, decimals }: Measurement): string {
  const text = (limit: number | null) => (limit === null ? '' : numberText(limit, decimals));
  return lower === null && upper === null ? '–' : `${text(lower)} … ${text(upper)}`.trim();
}

/// `isOfPart`: of one part, whose name needs no column; otherwise each value leads to its part.
export function ValueTable({ values, label, isOfPart = false }: { values: Measurement[]; label: string; isOfPart?: boolean }) {
  const t = texts().measurements;
  const heads: Array<[string, boolean]> = [
    [t.characteristic, false], [t.actual, true], [t.deviation, true], [t.inTolerance, false], [t.verdict, false], [t.nominal, true], [t.limits, false],
    ...(isOfPart ? [] : [[t.part, false] as [string, boolean], [texts().reports.machine, false] as [string, boolean]]), [texts().machine.tool, false], [t.time, false],
  ];
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={label}>
      <table class="data values">
        <thead><tr>{heads.map(([name, isNumber]) => <th scope="col" key={name} class={isNumber ? 'number' : ''}>{name}</th>)}</tr></thead>
        <tbody>
          {values.map((one) => (
            <tr key={one.id}>
              <th scope="row"><a class="target" href={addressOf('measurements', [], { characteristic: one.characteristic, machine: one.machine })}>{one.characteristic}</a></th>
              <td class="number"><b>{valueText(one.actual, one)}</b></td>
              <td class="number">{valueText(one.deviation, one, true)}</td>
              <td><ToleranceBar of={one} /></td>
              <td><VerdictPill verdict={one.verdict} /></td>
              <td class="number">{valueText(one.nominal, one)}</td>
              <td>{limitsText(one)}</td>
              {!isOfPart && <td><a href={addressOf('measurements', ['parts', String(one.part)])}>{one.serial ?? one.part}</a></td>}
              {!isOfPart && <td>{one.machine}</td>}
              <td>{one.tool ?? '–'}</td>
              <td>{dateTimeText(one.time)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
