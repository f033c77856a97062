// The views that are about what was made: runs, parts, measurements, findings, corrections; and the templates by which reports are read.
import { addressOf } from '../app/route';
import { useFeed } from '../live/use_feed';
import { texts } from '../texts/texts';
import { Tabs } from './tabs';

const kTabs = {
  runs: addressOf('reports'), parts: addressOf('measurements', ['parts']), values: addressOf('measurements'), findings: addressOf('measurements', ['findings']),
  corrections: addressOf('corrections'), templates: addressOf('templates'),
};
export type ReportTab = keyof typeof kTabs;

export function ReportTabs({ shown }: { shown: ReportTab }) {
  const t = texts().measurements;
  const pending = useFeed('offsets').offsets.size;
  const nameOf = (tab: ReportTab) => (tab === 'corrections' && pending > 0 ? t.tabWithCount(t.tabs[tab], pending) : t.tabs[tab]);
  return <Tabs label={texts().reports.title} tabs={(Object.keys(kTabs) as ReportTab[]).map((tab) => ({ address: kTabs[tab], name: nameOf(tab), isShown: tab === shown }))} />;
}
