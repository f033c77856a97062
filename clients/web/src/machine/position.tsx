// Where the axes are, as a control's position display has it.
import type { Machine, Status } from '../../generated/api';
import { texts } from '../texts/texts';
import { positionsOf } from './screen';
import { axisText, isDiameter, sortAxes, unitOf } from './units';

export function Position({ machine: { display }, status }: { machine: Machine; status: NonNullable<Status> }) {
  const t = texts().machine;
  const unit = unitOf(display);
  const axes = sortAxes(Object.keys(status.position));
  const shown = positionsOf(status);
  return (
    <section class="panel live" aria-labelledby="position">
      <h2 id="position">{t.position} <span class="muted">({unit.name})</span></h2>
      <div class="scroll" tabIndex={0} role="group" aria-labelledby="position"><table class="position">
        <thead><tr><th scope="col">{t.axis}</th>{shown.map(([kind]) => <th scope="col" key={kind}>{t.positions[kind]}</th>)}</tr></thead>
        <tbody>
          {axes.map((axis) => (
            <tr key={axis}>
              <th scope="row">{axis}{isDiameter(axis, display) && <span class="diameter"> ⌀<span class="visually-hidden"> {t.diameter}</span></span>}</th>
              {shown.map(([kind, values]) => <td key={kind}>{axisText(axis, values[axis], unit, isDiameter(axis, display))}</td>)}
            </tr>
          ))}
        </tbody>
      </table></div>
    </section>
  );
}
