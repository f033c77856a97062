// Where the axes are, as a control's position display has it.
import type { Machine, Status } from '../../generated/api';
import { texts } from '../texts/texts';
import { axisText, isDiameter, sortAxes, unitOf } from './units';

export function Position({ machine: { display }, status }: { machine: Machine; status: NonNullable<Status> }) {
  const t = texts().machine;
  const unit = unitOf(display);
  const { coordinates } = status;
  const axes = sortAxes(Object.keys(status.position));
  const columns: Array<[string, { [axis: string]: number } | null | undefined]> = [
    [t.inProgram, coordinates?.program?.position], [t.inMachine, status.position], [t.distanceToGo, coordinates?.distance_to_go],
    [t.followingError, coordinates?.following_error]];
  const shown = columns.filter(([, values]) => values);
  return (
    <section class="panel live" aria-labelledby="position">
      <h2 id="position">{t.position} <span class="muted">({unit.name})</span></h2>
      <div class="scroll" tabIndex={0} role="group" aria-labelledby="position"><table class="position">
        <thead><tr><th scope="col">{t.axis}</th>{shown.map(([name]) => <th scope="col" key={name}>{name}</th>)}</tr></thead>
        <tbody>
          {axes.map((axis) => (
            <tr key={axis}>
              <th scope="row">{axis}{isDiameter(axis, display) && <span class="diameter"> ⌀<span class="visually-hidden"> {t.diameter}</span></span>}</th>
              {shown.map(([name, values]) => <td key={name}>{axisText(axis, values?.[axis], unit, isDiameter(axis, display))}</td>)}
            </tr>
          ))}
        </tbody>
      </table></div>
    </section>
  );
}
