// One part: its verdict, every measurement, what of its report was not understood; and deriving it again after a template was changed.
import { useEffect } from 'preact/hooks';
import type { Measurement, Measurements, Part, Parts, ReportFindings } from '../../generated/api';
import { get, pathOf, send } from '../api/request';
import { addressOf } from '../app/route';
import { feed } from '../live/feed';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { Loading } from '../parts/loading';
import { SureButton } from '../parts/sure_button';
import { useLoaded } from '../parts/use_loaded';
import { VerdictPill } from '../parts/verdict_pill';
import { dateTimeText, numberText, texts } from '../texts/texts';
import { MeasurementExports } from './exports';
import { FindingTable } from './finding_list';
import { isFinal, partName } from './part_list';
import { ValueTable } from './value_table';

const kPage = 1000;
const kMax = 10_000;

async function loadValues(part: string, superseded: boolean, signal: AbortSignal): Promise<Measurement[]> {
  const all: Measurement[] = [];
  for (let after = ''; all.length < kMax;) {
    const { measurements, next } = await get<Measurements>(pathOf('measurements'), { part, superseded: superseded ? 'yes' : null, after, limit: kPage }, signal);
    all.push(...measurements);
    if (next === null) break;
    after = next;
  }
  return all;
}

function DeriveAgain({ part }: { part: Part & { run: string } }) {
  const t = texts().measurements;
  const command = useCommand();
  const derive = () => command.send(async () => {
    await send<Parts>('POST', pathOf('runs', part.run, 'measurements'), { json: {} });
    location.hash = addressOf('measurements', ['parts'], { run: part.run }); // the parts of the run have other numbers now
  });
  return (
    <details>
      <summary class="button">{t.derive}</summary>
      <div class="panel">
        <p class="hint">{t.deriveHint}</p>
        <Allowed to="program"><SureButton label={t.derive} question={t.deriveSure(part.run.slice(0, 8))} disabled={command.isBusy} onSure={() => void derive()} /></Allowed>
        <CommandFault command={command} />
      </div>
    </details>
  );
}

function Facts({ part }: { part: Part }) {
  const t = texts().measurements;
  return (
    <p class="muted">
      <a href={addressOf('machine', [part.machine])}>{part.machine}</a>
      {part.program !== null && <> · <a href={addressOf('programs', part.revision === null ? [part.program] : [part.program, String(part.revision)])}>{part.program}</a>{part.revision !== null && ` ${texts().machine.revision(part.revision)}`}</>}
      {part.run !== null && <> · <a href={addressOf('reports', [part.run])}>{t.onlyRun(part.run.slice(0, 8))}</a></>}
      {' · '}{t.readBy(part.template, part.template_version)} · {dateTimeText(part.begun)} – {part.ended === null ? t.open : dateTimeText(part.ended)}
    </p>
  );
}

export function PartPage({ id }: { id: string }) {
  const t = texts().measurements;
  const part = useLoaded((signal) => get<Part>(pathOf('parts', id), {}, signal), [id]);
  useEffect(() => feed.on('parts', part.reload), []);
  const { value } = part;
  const values = useLoaded(async (signal) => (value ? loadValues(id, value.superseded, signal) : null), [id, value?.measurements, value?.ended, value?.superseded]);
  const findings = useLoaded(async (signal) => (value?.findings ? get<ReportFindings>(pathOf('report-findings'), { machine: value.machine, run: value.run, limit: kPage }, signal) : null), [id, value?.findings]);
  const command = useCommand();
  if (!value) return <><h1>{t.part}</h1><Loading of={part} /></>;
  const own = (findings.value?.findings ?? []).filter((found) => found.part === value.id);
  const out = (values.value ?? []).filter(({ verdict }) => verdict !== 'good').length;
  return (
    <>
      <p class="back"><a href={addressOf('measurements', ['parts'], { machine: value.machine })}>← {t.tabs.parts}</a></p>
      <div class="machine-head live"><h1>{partName(value)}</h1>{isFinal(value) && <VerdictPill verdict={value.verdict} />}</div>
      <Facts part={value} />
      {value.superseded && <p class="notice warn">{t.superseded}</p>}
      <Loading of={values} />
      {values.value && (
        <>
          <div class="head values-head">
            <span>{t.valueCount(values.value.length)}{out > 0 && <b class="outside"> {t.notGood(numberText(out))}</b>}</span>
            <MeasurementExports query={{ part: id, superseded: value.superseded ? 'yes' : null }} name={`part-${id}`} command={command} />
          </div>
          {values.value.length > 0 && <ValueTable values={values.value} label={t.tabs.values} isOfPart />}
        </>
      )}
      {own.length > 0 && <section class="part-findings"><h2>{t.findings}</h2><FindingTable findings={own} label={t.findings} /></section>}
      <CommandFault command={command} />
      {value.run !== null && !value.superseded && <DeriveAgain part={{ ...value, run: value.run }} />}
    </>
  );
}
