// The tool table, the offsets and the variables of a setup's text, as cells that change the text where they are written.
import { Heads } from '../../parts/heads';
import { texts } from '../../texts/texts';
import { addRow, columnsOf, readTables, setCell, type TableName } from './setup_tables';

export function SetupTable({ table, text, onChange }: { table: TableName; text: string; onChange: (text: string) => void }) {
  const t = texts().setup;
  const rows = readTables(text).filter((row) => row.table === table);
  const columns = columnsOf(rows);
  return (
    <section class="panel" aria-labelledby={`table-${table}`}>
      <h2 id={`table-${table}`}>{t.tables[table]}</h2>
      {rows.length > 0 && (
        <div class="scroll">
          <table class="cells">
            <Heads of={columns} />
            <tbody>
              {rows.map((row, i) => (
                <tr key={i}>
                  {columns.map((key) => (
                    <td key={key}>
                      <input class="mono" aria-label={`${t.tables[table]}, ${t.row(i + 1)}, ${key}`} value={row.cells.find((c) => c.key === key)?.text ?? ''}
                        onInput={(e) => onChange(setCell(text, row, key, e.currentTarget.value))} />
                    </td>
                  ))}
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
      <button type="button" onClick={() => onChange(addRow(text, table, columns))}>{t.add[table]}</button>
    </section>
  );
}
