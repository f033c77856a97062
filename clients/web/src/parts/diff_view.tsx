// Shows what changed between two texts: by sign and by color.
import { texts } from '../texts/texts';
import { diffLines, foldDiff } from './diff';

const kSigns = { same: ' ', removed: '−', added: '+' };

export function DiffView({ before, after }: { before: string; after: string }) {
  const folded = foldDiff(diffLines(before, after));
  if (folded.length === 0) return <p class="muted">{texts().diff.same}</p>;
  return (
    <pre class="diff mono" tabIndex={0} aria-label={texts().diff.title}>
      {folded.map((line, i) => (
        <span key={i} class={line?.kind ?? 'gap'}>{line ? `${kSigns[line.kind]} ${line.text}\n` : '⋯\n'}</span>
      ))}
    </pre>
  );
}
