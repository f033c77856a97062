// The import queue: programs that machines sent (#/imports, #/imports/decided), or one of them (#/imports/O0200/4).
import { addressOf } from '../app/route';
import { Tabs } from '../parts/tabs';
import { texts } from '../texts/texts';
import { DecidedList, PendingList } from './import_list';
import { ImportPage } from './import_page';

const kTabs = ['pending', 'decided'] as const;

export default function ImportsView({ path }: { path: string[] }) {
  const t = texts().imports;
  const [first = 'pending', revision] = path;
  if (revision !== undefined) return <ImportPage key={`${first} ${revision}`} program={first} revision={Number(revision)} />;
  const tabs = kTabs.map((key) => ({ address: addressOf('imports', key === 'pending' ? [] : [key]), name: t.tabs[key], isShown: key === first }));
  return (
    <>
      <h1>{t.title}</h1>
      <p class="hint">{t.hint}</p>
      <Tabs label={t.title} tabs={tabs} />
      {first === 'decided' ? <DecidedList /> : <PendingList />}
    </>
  );
}
