// What looks after the server: its state, the serial ports, and who changed what.
import { addressOf } from '../app/route';
import { Tabs } from '../parts/tabs';
import { texts } from '../texts/texts';
import { AuditTrail } from './audit';
import { Ports } from './ports';
import { ServerState } from './server_state';

const kTabs = ['server', 'ports', 'audit'] as const;

export default function AdministrationView({ path }: { path: string[] }) {
  const [tab = 'server'] = path;
  const t = texts().administration;
  return (
    <>
      <h1>{t.title}</h1>
      <Tabs label={t.title} tabs={kTabs.map((key) => ({ address: addressOf('administration', [key]), name: t.tabs[key], isShown: key === tab }))} />
      {tab === 'server' && <ServerState />}
      {tab === 'ports' && <Ports />}
      {tab === 'audit' && <AuditTrail />}
    </>
  );
}
