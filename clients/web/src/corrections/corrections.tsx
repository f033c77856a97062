// Corrections of tool wear and work offsets that measurements propose: those that wait and those that are decided (#/corrections), and of a machine every
// value that a tool or an offset had, and its rules (#/corrections/lathe-1?target=T3).
import { ReportTabs } from '../parts/report_tabs';
import { texts } from '../texts/texts';
import { Decided } from './decided';
import { MachineCorrections } from './machine_corrections';
import { Pending } from './pending';

export default function CorrectionsView({ path, query }: { path: string[]; query: URLSearchParams }) {
  const [machine] = path;
  if (machine !== undefined) return <MachineCorrections key={machine} machine={machine} target={query.get('target') ?? ''} />;
  return (
    <>
      <h1>{texts().reports.title}</h1>
      <ReportTabs shown="corrections" />
      <Pending />
      <Decided />
    </>
  );
}
