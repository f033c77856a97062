// Whether other servers wait for the library of this one, its hand-over to one of them, and the program text on this server's own disk.
import { useState } from 'preact/hooks';
import type { Server, Sharing } from '../../generated/api';
import { pathOf, send } from '../api/request';
import { Allowed } from '../parts/allowed';
import { CommandFault, useCommand } from '../parts/command';
import { Rows } from '../parts/rows';
import { SureButton } from '../parts/sure_button';
import { bytesText, numberText, texts } from '../texts/texts';

type Cache = NonNullable<Server['program_cache']>;

function HandOver({ standbys }: { standbys: string[] }) {
  const t = texts().sharing;
  const command = useCommand();
  const [taker, setTaker] = useState('');
  const handOver = async () => setTaker((await send<Sharing>('POST', pathOf('server', 'drain'))).standbys.join(', '));
  return (
    <Allowed to="administer">
      <p class="buttons">
        <SureButton label={t.handOver} question={t.handOverSure(standbys.join(', '))} disabled={standbys.length === 0 || command.isBusy || taker !== ''} onSure={() => void command.send(handOver)} />
      </p>
      {taker !== '' && <p role="status" class="notice">{t.handedOver(taker)}</p>}
      <CommandFault command={command} />
    </Allowed>
  );
}

function CacheState({ cache }: { cache: Cache }) {
  const t = texts().sharing;
  const rows: Array<[string, string]> = [
    [t.cacheUsed, t.cacheUsedOf(bytesText(cache.used_bytes), bytesText(cache.size_bytes))],
    [t.cacheAsked, t.cacheAskedOf(numberText(cache.hits), numberText(cache.misses))],
    [t.cacheAhead, numberText(cache.fetched)],
  ];
  return (
    <>
      <h3>{t.cache}</h3>
      {cache.fault !== null && <p class="notice warn" role="alert">{cache.fault}</p>}
      {cache.damaged > 0 && <p class="notice bad">{t.cacheDamaged(numberText(cache.damaged))}</p>}
      <Rows of={rows} />
    </>
  );
}

/// `sharing` null: no other server can take the library over.
export function SharingState({ sharing, cache }: { sharing: Sharing | null; cache: Cache | null }) {
  const t = texts().sharing;
  return (
    <section class="panel" aria-labelledby="sharing">
      <h2 id="sharing">{t.title}</h2>
      {!sharing && <p class="muted">{t.alone}</p>}
      {sharing && <Rows of={[[t.term, String(sharing.term)], [t.standbys, sharing.standbys.length === 0 ? t.noStandby : sharing.standbys.join(', ')]]} />}
      {sharing && <HandOver standbys={sharing.standbys} />}
      {cache && <CacheState cache={cache} />}
    </section>
  );
}
