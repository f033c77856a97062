// Feed, spindle, tool and the modal state, as a control's status window has them.
import type { Display, Machine, Status } from '../../generated/api';
import { Rows } from '../parts/rows';
import { bufferedText, numberText, texts } from '../texts/texts';
import { lengthText, unitOf } from './units';

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
  const tool = [modes.tool ?? '–', modes.tool_offset !== null ? t.toolOffset(modes.tool_offset) : null, modes.next_tool !== null ? t.nextTool(modes.next_tool) : null];
  rows.push(
    [t.tool, tool.filter((part) => part !== null).join(', ')],
    [t.toolLengths, `X ${lengthText(modes.tool_length_x, unit)}  Z ${lengthText(modes.tool_length_z, unit)}`],
    [t.toolRadius, lengthText(modes.tool_radius, unit)],
    [t.motion, t.motions[modes.motion]],
    [t.compensation, t.compensations[modes.compensation]],
    [t.programmedFeed, `${programmedFeed} ${feedUnit}${modes.feed_limited ? `, ${t.limited}` : ''}`],
    [t.programmedSpeed, `${speed}${modes.spindle ? `, ${t.spindles[modes.spindle]}` : ''}`],
    [t.words, `${modes.incremental ? t.incremental : t.absolute}, ${modes.units}`],
    [t.workSystem, modes.work_system ?? '–'],
    [t.cycle, modes.cycle ?? '–'],
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
