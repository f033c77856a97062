// The formats in which the API gives report lines.
import { texts } from '../texts/texts';

export const kFormats = ['text', 'csv', 'json'] as const;

export function Exports({ onExport }: { onExport: (format: string) => void }) {
  const t = texts().reports;
  return (
    <span class="buttons" role="group" aria-label={t.export}>
      {kFormats.map((format) => <button key={format} type="button" onClick={() => onExport(format)}>{format === 'text' ? t.asText : format.toUpperCase()}</button>)}
    </span>
  );
}
