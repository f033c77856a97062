// The tool path of the program that the machine executes: what has been executed in its colors, what is still to come pale, and where the tool is.
import { useMemo } from 'preact/hooks';
import type { Run, Status } from '../../generated/api';
import { addressOf } from '../app/route';
import type { Vector } from '../path/camera';
import { PathCanvas } from '../path/canvas';
import { ExecutedCursor } from '../path/executed';
import { usePath } from '../path/use_path';
import { numberText, texts } from '../texts/texts';

/// What a panel of this size can show; a longer path is made coarser.
const kMaxPoints = 200_000;

/// As the path is looked at: a lathe with Z to the right and X up.
function toolOf(position: { [axis: string]: number }, isLathe: boolean): Vector {
  const at = (axis: string) => position[axis] ?? 0;
  return isLathe ? [at('Z'), at('X'), at('Y')] : [at('X'), at('Y'), at('Z')];
}

export function ExecutedPath({ run, status }: { run: Run; status: NonNullable<Status> }) {
  const t = texts().path;
  const path = usePath({ program: run.program, revision: run.revision, size: run.size, machine: run.machine, maxPoints: kMaxPoints });
  const { polyline, begin, end } = path;
  const cursor = useMemo(() => new ExecutedCursor(polyline), [polyline]);
  const tool = toolOf(status.position, begin?.lathe ?? false);
  const isOver = status.execution === 'PROGRAM_COMPLETED';
  const point = isOver ? polyline.length - 1 : cursor.at({ executed: status.executed, line: status.line, tool });
  const percent = polyline.length > 1 ? (100 * Math.max(0, point)) / (polyline.length - 1) : 0;
  return (
    <section class="panel live" aria-labelledby="executed" data-executed={point} data-points={polyline.length} data-complete={end !== null}>
      <div class="head">
        <h2 id="executed">{t.title}</h2>
        <a href={addressOf('path', [run.program, String(run.revision)], { machine: run.machine, line: String(status.line) })}>{t.open}</a>
      </div>
      {path.fault !== null && <p class="notice">{path.fault}</p>}
      {end?.fault && <p class="notice warn">{end.fault.line > 0 && <b>{t.faultAt(numberText(end.fault.line))} </b>}{end.fault.id} {end.fault.text}</p>}
      <PathCanvas polyline={polyline} version={path.version} isComplete={end !== null} isLathe={begin?.lathe ?? false} selection={kNone} showsRapids isSmall
        executed={{ point, tool }} label={t.executedOf(run.program, numberText(percent))} onPick={nothing} onNext={nothing} />
      <p class="legend"><span class="key executed">{t.executed}</span><span class="key pending">{t.pending}</span><span class="key tool">{t.toolHere}</span></p>
    </section>
  );
}

const kNone: [] = [];
const nothing = () => {};
