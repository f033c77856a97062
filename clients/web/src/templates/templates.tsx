// Report templates: all of them with what they are for (#/templates), and one with its versions, its text, its assignments, and a trial on a run
// (#/templates/bore?version=2&run=...).
import { ReportTabs } from '../parts/report_tabs';
import { texts } from '../texts/texts';
import { TemplateList } from './template_list';
import { TemplatePage } from './template_page';

export default function TemplatesView({ path, query }: { path: string[]; query: URLSearchParams }) {
  const [name] = path;
  if (name !== undefined) return <TemplatePage key={name} name={name} query={query} />;
  return (
    <>
      <h1>{texts().reports.title}</h1>
      <ReportTabs shown="templates" />
      <TemplateList />
    </>
  );
}
