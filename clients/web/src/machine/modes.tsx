// Feed, spindle, tool and the modal state, as a control's status window has them.
import type { Display, Machine, Status } from '../../generated/api';
import { Rows } from '../parts/rows';
import { bufferedText, numberText, texts } from '../texts/texts';
import { hasField } from './screen';
import { lengthText, unitOf } from './units';

function toolLengths(modes: NonNullable<NonNullable<Status>['modes']>, display: Display): Array<[string, string]> {
  const t = texts().machine;
  const unit = unitOf(display);
  const z = lengthText(modes.tool_length_z, unit);
  if (hasField(display, 'tool_length_x')) return [[t.toolLengths, `X ${lengthText(modes.tool_length_x, unit)}  Z ${z}`]];
  return hasField(display, 'tool_length_z') ? [[t.toolLength, z]] : [];
}

function rowsOf(status: NonNullable<Status>, display: Display): Array<[string, string]> {
  const t = texts().machine;
  const unit = unitOf(display);
  const rows: Array<[string, string]> = [
    [t.mode, t.modes[status.mode]],
    [t.feed, `${lengthText(status.feed_mm_per_min, { ...unit, digits: unit.name === 'mm' ? 0 : 2 })} ${unit.name}/min`],
    [t.spindle, `${numberText(status.spindle_rpm)} 1/min`],
    [t.blocks, t.blockCounts(numberText(status.executed), numberText(status.accepted))],
    [t.buffered, bufferedText(status.buffered_seconds)],
  ];
  const { modes } = status;
  if (!modes) return rows;
  const feedUnit = modes.feed_unit === 'per_minute' ? `${unit.name}/min` : modes.feed_unit === 'per_revolution' ? t.perRevolution(unit.name) : t.inverseTime;
  const programmedFeed = modes.feed_unit === 'inverse_time' ? numberText(modes.feed, 3) : lengthText(modes.feed, unit);
  const speed = modes.surface_speed ? `${numberText(modes.spindle_speed / 1000, 1)} m/min` : `${numberText(modes.spindle_speed)} 1/min`;
  // What the control does not have is left out.
  const own = (field: Parameters<typeof hasField>[1], name: string, value: string): Array<[string, string]> => (hasField(display, field) ? [[name, value]] : []);
  const tool = [modes.tool ?? '–', modes.tool_offset !== null ? t.toolOffset(modes.tool_offset) : null, modes.next_tool !== null ? t.nextTool(modes.next_tool) : null];
  rows.push(
    [t.tool, tool.filter((part) => part !== null).join(', ')],
    ...toolLengths(modes, display),
    ...own('tool_radius', t.toolRadius, lengthText(modes.tool_radius, unit)),
    [t.motion, t.motions[modes.motion]],
    ...own('compensation', t.compensation, t.compensations[modes.compensation]),
    [t.programmedFeed, `${programmedFeed} ${feedUnit}${modes.feed_limited ? `, ${t.limited}` : ''}`],
    [t.programmedSpeed, `${speed}${modes.spindle ? `, ${t.spindles[modes.spindle]}` : ''}`],
    ...own('incremental', t.words, `${modes.incremental ? t.incremental : t.absolute}, ${modes.units}`),
    ...own('work_system', t.workSystem, modes.work_system ?? '–'),
    ...own('cycle', t.cycle, modes.cycle ?? '–'),
    [t.coolant, [modes.flood ? t.flood : null, modes.mist ? t.mist : null].filter(Boolean).join(', ') || t.off],
  );
  if (modes.dwell_seconds > 0) rows.push([t.dwell, `${numberText(modes.dwell_seconds, 1)} s`]);
  if (modes.spindle_load !== null) rows.push([t.spindleLoad, `${numberText(modes.spindle_load * 100)} %`]);
  return rows;
}

export function Modes({ machine, status }: { machine: Machine; status: NonNullable<Status> }) {
  return (
    <section class="panel live" aria-labelledby="modes">
      <h2 id="modes">{texts().machine.state}</h2>
      <Rows of={rowsOf(status, machine.display)} />
    </section>
  );
}
