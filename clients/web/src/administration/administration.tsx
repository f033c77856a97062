// What looks after the server: its state, backups, archives, certificates, the serial ports, hot folders, webhooks, users, groups of machines, the release policy, and who changed what.
import { addressOf } from '../app/route';
import { Only } from '../parts/allowed';
import { Tabs } from '../parts/tabs';
import { texts } from '../texts/texts';
import { ArchiveList } from './archives';
import { AuditTrail } from './audit';
import { AuditState } from './audit_state';
import { BackupList } from './backups';
import { CertificateList } from './certificates';
import { Folders } from './folders';
import { Groups } from './groups';
import { Policy } from './policy';
import { Ports } from './ports';
import { ServerState } from './server_state';
import { Users } from './users';
import { Webhooks } from './webhooks';

const kTabs = ['server', 'backups', 'archives', 'certificates', 'ports', 'folders', 'webhooks', 'users', 'groups', 'policy', 'audit'] as const;

export default function AdministrationView({ path }: { path: string[] }) {
  const [tab = 'server'] = path;
  const t = texts().administration;
  return (
    <>
      <h1>{t.title}</h1>
      <Tabs label={t.title} tabs={kTabs.map((key) => ({ address: addressOf('administration', [key]), name: t.tabs[key], isShown: key === tab }))} />
      {tab === 'server' && <ServerState />}
      {tab === 'backups' && <Only to="administer"><BackupList /></Only>}
      {tab === 'archives' && <Only to="administer"><ArchiveList /></Only>}
      {tab === 'certificates' && <CertificateList />}
      {tab === 'ports' && <Ports />}
      {tab === 'folders' && <Folders />}
      {tab === 'webhooks' && <Only to="administer"><Webhooks /></Only>}
      {tab === 'users' && <Only to="administer"><Users chosen={path[1]} /></Only>}
      {tab === 'groups' && <Groups />}
      {tab === 'policy' && <Policy />}
      {tab === 'audit' && <Only to="approve"><AuditState /><AuditTrail /></Only>}
    </>
  );
}
