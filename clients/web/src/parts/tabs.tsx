// The parts of a view, each with an address of its own.
export interface Tab {
  address: string;
  name: string;
  isShown: boolean;
}

export function Tabs({ label, tabs }: { label: string; tabs: Tab[] }) {
  return (
    <nav class="tabs" aria-label={label}>
      {tabs.map((tab) => <a key={tab.address} href={tab.address} aria-current={tab.isShown ? 'page' : undefined}>{tab.name}</a>)}
    </nav>
  );
}
