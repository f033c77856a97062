// Measurements as files: for spreadsheets, for quality systems, for people on paper, and digitized points for CAD.
import { pathOf, withQuery, type Query } from '../api/request';
import type { Command } from '../parts/command';
import { download } from '../programs/download';
import { texts } from '../texts/texts';

export type Format = 'csv' | 'jsonl' | 'dfq' | 'qif' | 'html' | 'points' | 'dxf' | 'stl';

const kAtOnce: Format[] = ['csv', 'jsonl'];
const kMore: Format[] = ['dfq', 'qif', 'html', 'points', 'dxf', 'stl'];

/// Two formats would end in .csv.
export function fileNameOf(name: string, format: Format): string {
  return format === 'points' ? `${name}-points.csv` : `${name}.${format}`;
}

interface Props {
  /// Which measurements, in the API's words.
  query: Query;
  /// Of the file, without its ending.
  name: string;
  command: Command;
}

export function MeasurementExports({ query, name, command }: Props) {
  const t = texts().measurements;
  const save = (format: Format) => void command.send(() => download(withQuery(pathOf('measurements'), { ...query, format }), fileNameOf(name, format)));
  const button = (format: Format) => <button key={format} type="button" disabled={command.isBusy} onClick={() => save(format)}>{t.formats[format]}</button>;
  return (
    <div class="exports" role="group" aria-label={texts().reports.export}>
      <span class="buttons">{kAtOnce.map(button)}</span>
      <details>
        <summary class="button">{t.moreFormats}</summary>
        <div class="panel">
          <p class="hint">{t.formatsHint}</p>
          <p class="buttons">{kMore.map(button)}</p>
        </div>
      </details>
    </div>
  );
}
