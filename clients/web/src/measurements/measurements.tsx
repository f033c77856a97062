// What was measured: values with their chart (#/measurements?characteristic=D12&machine=mill-1), parts (#/measurements/parts, #/measurements/parts/12),
// and what of the reports was not understood (#/measurements/findings).
import { ReportTabs } from '../parts/report_tabs';
import { texts } from '../texts/texts';
import { FindingList } from './finding_list';
import { PartList } from './part_list';
import { PartPage } from './part_page';
import { ValueList } from './value_list';

export default function MeasurementsView({ path, query }: { path: string[]; query: URLSearchParams }) {
  const [first = 'values', id] = path;
  if (first === 'parts' && id !== undefined) return <PartPage key={id} id={id} />;
  return (
    <>
      <h1>{texts().reports.title}</h1>
      <ReportTabs shown={first === 'parts' || first === 'findings' ? first : 'values'} />
      {first === 'parts' ? <PartList query={query} /> : first === 'findings' ? <FindingList query={query} /> : <ValueList query={query} />}
    </>
  );
}
