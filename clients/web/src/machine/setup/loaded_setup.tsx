// A control at the end of a line gets no setup with a start: someone loads it there, and says here which one it has.
import type { LoadedSetup as Loaded } from '../../../generated/api';
import { getIfThere, pathOf, send } from '../../api/request';
import { Allowed } from '../../parts/allowed';
import { CommandFault, useCommand } from '../../parts/command';
import { Loading } from '../../parts/loading';
import { SureButton } from '../../parts/sure_button';
import { useLoaded } from '../../parts/use_loaded';
import { dateTimeText, texts } from '../../texts/texts';

async function loadLoaded(machine: string, signal: AbortSignal): Promise<Loaded | 'unsaid'> {
  return (await getIfThere<Loaded>(pathOf('machines', machine, 'setup', 'loaded'), {}, signal)) ?? 'unsaid';
}

export function LoadedSetup({ machine, newest }: { machine: string; newest: number }) {
  const t = texts().setup;
  const loaded = useLoaded((signal) => loadLoaded(machine, signal), [machine]);
  const command = useCommand();
  const state = async (revision: number | null) => {
    await command.send(() => send('PUT', pathOf('machines', machine, 'setup', 'loaded'), { json: revision === null ? {} : { revision } }));
    loaded.reload();
  };
  const said = loaded.value;
  if (said === null) return <Loading of={loaded} />;
  const revision = said === 'unsaid' ? null : said.revision;
  return (
    <section class={revision === newest ? 'panel' : 'notice warn'} aria-labelledby="loaded-setup">
      <h2 id="loaded-setup">{t.inControl}</h2>
      <p>{revision === null ? t.inControlUnknown : t.inControlRevision(revision)}{said !== 'unsaid' && ` ${t.inControlSaid(said.who ?? '–', dateTimeText(said.time))}`}</p>
      {revision !== newest && <p>{t.inControlHint}</p>}
      <Allowed to="operate" machine={machine}><p class="buttons">
        <SureButton label={t.isLoaded(newest)} question={t.isLoadedSure(newest, machine)} disabled={revision === newest || command.isBusy} onSure={() => void state(newest)} />
        <button type="button" disabled={revision === null || command.isBusy} onClick={() => void state(null)}>{t.notKnown}</button>
      </p></Allowed>
      <CommandFault command={command} />
      <Loading of={loaded} />
    </section>
  );
}
