// From where to where a program moves each axis, as it would write it.
import { axisText, kInch, kMillimeter, lengthText, sortAxes } from '../machine/units';
import { texts } from '../texts/texts';

export interface Extended {
  inch: boolean;
  x_is_diameter: boolean;
  /// The smallest and the largest coordinate, mm or degrees; X as radius.
  extents: { [axis: string]: number[] };
}

/// "12.500 mm"
export function lengthOf(mm: number, isInch: boolean): string {
  const unit = isInch ? kInch : kMillimeter;
  return `${lengthText(mm, unit)} ${unit.name}`;
}

export function Extents({ of }: { of: Extended }) {
  const t = texts().path;
  const unit = of.inch ? kInch : kMillimeter;
  const isDiameter = (axis: string) => axis === 'X' && of.x_is_diameter;
  return (
    <table>
      <thead><tr>{[`${t.axis} (${unit.name})`, t.least, t.most].map((name, i) => <th scope="col" key={name} class={i > 0 ? 'number' : ''}>{name}</th>)}</tr></thead>
      <tbody>
        {sortAxes(Object.keys(of.extents)).map((axis) => (
          <tr key={axis}>
            <th scope="row">{axis}{isDiameter(axis) && ' ⌀'}</th>
            {of.extents[axis]!.map((at, i) => <td key={i} class="number">{axisText(axis, at, unit, isDiameter(axis))}</td>)}
          </tr>
        ))}
      </tbody>
    </table>
  );
}
