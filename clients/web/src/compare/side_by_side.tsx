// Two texts beside each other, where they differ. A change is a sign and a word for those who do not see it, and a color.
import type { ComparedText } from '../../generated/api';
import { texts } from '../texts/texts';
import { rowsOf, type Row, type Side } from './rows';

const kSigns = { same: '', changed: '≠', removed: '−', added: '+', gap: '⋯' };

function Cells({ side }: { side: Side | null }) {
  return <><td class="number">{side?.line}</td><td class={side ? 'text' : 'none'}>{side?.text}</td></>;
}

function TableRow({ row }: { row: Row }) {
  if (row.kind === 'gap') return <tr class="gap"><td colSpan={5}>{kSigns.gap}</td></tr>;
  return <tr class={row.kind}><Cells side={row.first} /><td class="sign">{kSigns[row.kind]}</td><Cells side={row.second} /></tr>;
}

export function SideBySide({ text, from, to }: { text: ComparedText; from: string; to: string }) {
  const t = texts().compare;
  return (
    <div class="side-by-side" tabIndex={0} role="region" aria-label={t.fromTo(from, to)}>
      <table class="mono">
        <colgroup><col class="lines" /><col /><col class="signs" /><col class="lines" /><col /></colgroup>
        <thead><tr><th scope="col" colSpan={2}>{from}</th><td /><th scope="col" colSpan={2}>{to}</th></tr></thead>
        <tbody>{rowsOf(text.hunks).map((row, i) => <TableRow key={i} row={row} />)}</tbody>
      </table>
    </div>
  );
}
