// What the control retained after its runs: variables and offsets that programs changed, beside what the setup says.
import type { Memory } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { Loading } from '../parts/loading';
import { useLoaded } from '../parts/use_loaded';
import { dateTimeText, texts } from '../texts/texts';

export function MachineMemory({ machine }: { machine: string }) {
  const t = texts().machine;
  const memory = useLoaded((signal) => get<{ memories: Memory[] }>(pathOf('machines', machine, 'memory'), { limit: 1 }, signal), [machine]);
  const newest = memory.value?.memories[0];
  return (
    <section aria-labelledby="memory">
      <h2 id="memory">{t.memory}</h2>
      <Loading of={memory} />
      {memory.value && !newest && <p class="muted">{t.noMemory}</p>}
      {newest && (
        <>
          <p class="muted">{t.memoryOf(newest.change?.what ?? newest.program ?? t.atTheMachine, dateTimeText(newest.time))}</p>
          <table class="data">
            <thead><tr><th scope="col">{t.cell}</th><th scope="col">{t.value}</th><th scope="col">{t.inSetup}</th></tr></thead>
            <tbody>
              {newest.cells.map((cell) => (
                <tr key={cell.name}><th scope="row">{cell.name}</th><td>{cell.value ?? t.vacant}</td><td>{cell.setup ?? '–'}</td></tr>
              ))}
            </tbody>
          </table>
        </>
      )}
    </section>
  );
}
