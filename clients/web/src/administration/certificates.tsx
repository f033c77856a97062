// The certificates that server and machines depend on, and when they expire.
import type { Certificate, Certificates } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { Heads } from '../parts/heads';
import { Loading } from '../parts/loading';
import { useRefreshed } from '../parts/use_refreshed';
import { dateTimeText, relativeText, texts } from '../texts/texts';

const kIntervalMs = 60_000;
const kTones = { ok: 'running', expiring: 'waiting', expired: 'alarm' } as const;

/// What ends first is first.
export function sortCertificates(certificates: Certificate[]): Certificate[] {
  return [...certificates].sort((a, b) => Date.parse(a.expires) - Date.parse(b.expires));
}

export function CertificateList() {
  const t = texts().certificates;
  const certificates = useRefreshed((signal) => get<Certificates>(pathOf('certificates'), {}, signal), () => kIntervalMs);
  const list = sortCertificates(certificates.value?.certificates ?? []);
  return (
    <section class="panel" aria-labelledby="certificates">
      <h2 id="certificates">{t.title}</h2>
      <p class="hint">{t.hint}</p>
      <Loading of={certificates} />
      {certificates.value && list.length === 0 && <p class="notice">{t.none}</p>}
      {list.length > 0 && (
        <div class="scroll" tabIndex={0} role="group" aria-labelledby="certificates">
          <table class="data">
            <Heads of={[t.of, t.expires, t.state]} />
            <tbody>
              {list.map((row) => (
                <tr key={`${row.use} ${row.machine}`}>
                  <th scope="row">{t.uses[row.use]}{row.machine !== null && ` ${row.machine}`}</th>
                  <td>{dateTimeText(row.expires)} <span class="muted">{relativeText(row.expires)}</span></td>
                  <td><span class={`pill ${kTones[row.state]}`}>{t.states[row.state]}</span></td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
    </section>
  );
}
