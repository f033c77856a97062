// How the server is: its health with every reason, what it keeps, the servers that wait for it, and its MQTT broker.
import type { Server } from '../../generated/api';
import { get, pathOf } from '../api/request';
import { Loading } from '../parts/loading';
import { Rows } from '../parts/rows';
import { useRefreshed } from '../parts/use_refreshed';
import { MqttState } from './mqtt_state';
import { SharingState } from './sharing_state';
import { durationText } from '../live/progress';
import { dateTimeText, numberText, texts } from '../texts/texts';

/// The server checks itself as often.
const kIntervalMs = 10_000;
const kTones = { ok: 'running', degraded: 'waiting', failed: 'alarm' } as const;

export function ServerState() {
  const t = texts().administration;
  const server = useRefreshed((signal) => get<Server>(pathOf('server'), {}, signal), () => kIntervalMs);
  const { value } = server;
  if (!value) return <Loading of={server} />;
  const rows: Array<[string, string]> = [
    [t.name, value.name], [t.version, value.version], [t.started, `${dateTimeText(value.started)} (${durationText(value.uptime_s)})`], [t.dataFolder, value.data_dir],
    [t.machines, t.connectedOf(value.machines_connected, value.machines)], [t.programs, numberText(value.programs)], [t.runsActive, numberText(value.runs_active)],
    [t.ddsDomain, String(value.dds.domain)], [t.rejected, numberText(value.dds.rejected)],
  ];
  return (
    <>
      <section class="panel" aria-labelledby="server">
        <div class="head"><h2 id="server">{t.server}</h2><span class={`pill ${kTones[value.health.status]}`}>{t.health[value.health.status]}</span></div>
        {value.health.reasons.map((reason) => (
          <p key={reason.subject + reason.detail} class={`notice ${reason.status === 'failed' ? 'bad' : 'warn'}`}><b>{reason.message}</b> {reason.detail}</p>
        ))}
        <Rows of={rows} />
      </section>
      <SharingState sharing={value.sharing} cache={value.program_cache} />
      <MqttState mqtt={value.mqtt} />
    </>
  );
}
