// The blocks on the control's screen: the executing one and its neighbors, as its settings allow. They are the gateway's, so they are there for called
// programs and for what comes over a line too.
import type { Status } from '../../generated/api';
import { texts } from '../texts/texts';
import { blocksOf } from './screen';

export function Blocks({ status }: { status: NonNullable<Status> }) {
  const shown = blocksOf(status);
  if (shown.length === 0) return null;
  return (
    <section class="panel live" aria-labelledby="blocks">
      <h2 id="blocks">{texts().machine.screenBlocks}</h2>
      <ol class="screen-blocks mono" tabIndex={0} aria-labelledby="blocks">
        {shown.map((block, i) => <li key={i} aria-current={block.isExecuting ? 'step' : undefined}><span class="text">{block.text}</span></li>)}
      </ol>
    </section>
  );
}
