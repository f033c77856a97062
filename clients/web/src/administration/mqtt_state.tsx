// Whether records and states reach the MQTT broker: since when, how many records wait, what was published, and the last fault.
import type { Server } from '../../generated/api';
import { Rows } from '../parts/rows';
import { dateTimeText, numberText, texts } from '../texts/texts';

type Mqtt = NonNullable<Server['mqtt']>;

/// What the rows say; "last fault" alone while nothing is wrong now.
export function mqttRows(mqtt: Mqtt): Array<[string, string]> {
  const t = texts().mqtt;
  const rows: Array<[string, string]> = [[t.broker, mqtt.broker]];
  if (mqtt.since) rows.push([mqtt.connected ? t.connectedSince : t.awaySince, dateTimeText(mqtt.since)]);
  rows.push([t.waiting, numberText(mqtt.records_waiting)], [t.published, t.publishedCounts(numberText(mqtt.records_published), numberText(mqtt.states_published))]);
  if (mqtt.connected && mqtt.fault) rows.push([t.lastFault, mqtt.fault]);
  return rows;
}

type Sparkplug = NonNullable<Mqtt['sparkplug']>;

/// The machines as devices of a node: a connection of its own.
function SparkplugState({ node }: { node: Sparkplug }) {
  const t = texts().mqtt;
  const rows: Array<[string, string]> = [[t.node, node.node]];
  if (node.since) rows.push([node.connected ? t.connectedSince : t.awaySince, dateTimeText(node.since)]);
  rows.push([t.published, t.messages(numberText(node.messages_published))], [t.rebirths, numberText(node.rebirths)]);
  if (node.connected && node.fault) rows.push([t.lastFault, node.fault]);
  return (
    <>
      <div class="head">
        <h3>{t.sparkplug}</h3>
        <span class={`pill ${node.connected ? 'running' : 'waiting'}`}>{node.connected ? t.connected : t.away}</span>
      </div>
      {!node.connected && node.fault && <p class="notice warn" role="alert">{node.fault}</p>}
      <Rows of={rows} />
    </>
  );
}

/// null: the server has no broker.
export function MqttState({ mqtt }: { mqtt: Mqtt | null }) {
  const t = texts().mqtt;
  return (
    <section class="panel" aria-labelledby="mqtt">
      <div class="head">
        <h2 id="mqtt">{t.title}</h2>
        {mqtt && <span class={`pill ${mqtt.connected ? 'running' : 'waiting'}`}>{mqtt.connected ? t.connected : t.away}</span>}
      </div>
      {!mqtt && <p class="muted">{t.off}</p>}
      {mqtt && !mqtt.connected && mqtt.fault && <p class="notice warn" role="alert">{mqtt.fault}</p>}
      {mqtt && mqtt.records_missing > 0 && <p class="notice bad">{t.missing(numberText(mqtt.records_missing))}</p>}
      {mqtt && <Rows of={mqttRows(mqtt)} />}
      {mqtt?.sparkplug && <SparkplugState node={mqtt.sparkplug} />}
    </section>
  );
}
