// From where the axes of a machine without a run are: the datum of a work offset, a tool's length, or the words of a block. Nothing moves. The second
// press of the button names what will be set.
import { useState } from 'preact/hooks';
import type { Machine, PlaybackBlock, PositionSet, Status } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { SureButton } from '../parts/sure_button';
import { texts } from '../texts/texts';
import { setPosition, type PositionToSet } from './commands';
import { isRotary, sortAxes, unitOf } from './units';

/// null: not a number as it is typed, comma or point.
export function readNumber(text: string): number | null {
  const typed = text.trim().replace(',', '.');
  return /^[+-]?(\d+\.?\d*|\.\d+)$/.test(typed) ? Number(typed) : null;
}

const kDatum = 'datum';

function SetForm({ machine, axes }: { machine: Machine; axes: string[] }) {
  const t = texts().machine;
  const { positions, display } = machine;
  const command = useCommand();
  const [kind, setKind] = useState(positions.datum_axes === '' ? 'tool' : kDatum);
  const [tool, setTool] = useState('');
  const [offset, setOffset] = useState(positions.offsets[0] ?? '');
  const [axis, setAxis] = useState('');
  const [typed, setTyped] = useState('0');
  const [answer, setAnswer] = useState('');
  const isTool = kind === 'tool';
  const usable = axes.filter((letter) => (isTool ? positions.tool_axes : positions.datum_axes).includes(letter));
  const chosen = usable.includes(axis) ? axis : (usable[0] ?? '');
  const isFixed = !isTool && positions.zero_only;
  const value = isFixed ? 0 : readNumber(typed);
  const number = Number(tool);
  const isGood = chosen !== '' && value !== null && (!isTool || (Number.isInteger(number) && number > 0));
  const unit = unitOf(display).name;
  const shownUnit = isRotary(chosen) ? '°' : unit;
  const setting: PositionToSet = {
    axis: chosen, value: value ?? 0, unit: isRotary(chosen) ? 'deg' : unit === 'inch' ? 'in' : 'mm', ...(offset !== '' && { offset }), ...(isTool && { tool: number }),
  };
  const thing = isTool ? t.lengthOf(tool) : offset;
  const send = () => command.send(async () => setAnswer((await setPosition(machine.name, setting) as PositionSet).text));
  return (
    <>
      <div class="tools">
        {positions.datum_axes !== '' && positions.tool_axes !== '' && (
          <label>{t.whatIsSet}<select value={kind} onChange={(e) => setKind(e.currentTarget.value)}>
            <option value={kDatum}>{t.datum}</option><option value="tool">{t.toolLength}</option>
          </select></label>
        )}
        {isTool && <label>{t.tool}<input inputMode="numeric" size={4} value={tool} onInput={(e) => setTool(e.currentTarget.value.trim())} /></label>}
        {positions.offsets.length > 0 && <label>{t.workOffset}<input list="work-offsets" size={8} value={offset} onInput={(e) => setOffset(e.currentTarget.value.trim().toUpperCase())} /></label>}
        <datalist id="work-offsets">{positions.offsets.map((name) => <option key={name} value={name} />)}</datalist>
        <label>{t.axis}<select value={chosen} onChange={(e) => setAxis(e.currentTarget.value)}>{usable.map((letter) => <option key={letter}>{letter}</option>)}</select></label>
        <label>
          {t.becomes(shownUnit, chosen === 'X' && positions.x_diameter)}
          <input inputMode="decimal" size={9} value={isFixed ? '0' : typed} disabled={isFixed} aria-invalid={value === null} onInput={(e) => setTyped(e.currentTarget.value)} />
        </label>
      </div>
      <SureButton label={t.set} disabled={!isGood || command.isBusy || !machine.connected}
        question={t.setSure(`${thing} ${chosen} = ${value ?? ''} ${shownUnit}`.trim(), machine.name)} onSure={() => void send()} />
      {answer !== '' && command.fault === null && <p role="status">{answer}</p>}
      <CommandFault command={command} />
    </>
  );
}

function Playback({ machine, axes }: { machine: Machine; axes: string[] }) {
  const t = texts().machine;
  const command = useCommand();
  const [block, setBlock] = useState('');
  const take = () => command.send(async () => setBlock((await get<PlaybackBlock>(pathOf('machines', machine.name, 'playback'), { axes: axes.join('') })).block));
  return (
    <>
      <button type="button" disabled={command.isBusy || !machine.connected} onClick={() => void take()}>{t.playback}</button>
      {block !== '' && <label>{t.playbackBlock}<input readOnly value={block} size={Math.max(20, block.length)} onFocus={(e) => e.currentTarget.select()} /></label>}
      <CommandFault command={command} />
    </>
  );
}

export function SetPosition({ machine, status }: { machine: Machine; status: NonNullable<Status> }) {
  const t = texts().machine;
  const { positions } = machine;
  const axes = sortAxes(Object.keys(status.position));
  if (positions.datum_axes === '' && positions.tool_axes === '' && !positions.playback) return null;
  return (
    <section class="panel" aria-labelledby="set-position">
      <h2 id="set-position">{t.setPosition}</h2>
      <Allowed to="operate" machine={machine.name}>
        <SetForm machine={machine} axes={axes} />
      </Allowed>
      {positions.playback && <Playback machine={machine} axes={axes} />}
    </section>
  );
}
