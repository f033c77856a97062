// The reports: all runs, or one with its records (#/reports/RUN).
import { ReportList } from './report_list';
import { RunReport } from './run_report';

export default function ReportsView({ path, query }: { path: string[]; query: URLSearchParams }) {
  const [id] = path;
  return id === undefined ? <ReportList query={query} /> : <RunReport id={id} query={query} />;
}
