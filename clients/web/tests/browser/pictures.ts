// Pictures of every view at both widths and in both themes, to be looked at: tests/run pictures FOLDER [VIEW]. With ONE_SCREEN=1 they show
// what fits a screen, as those of deploy/docs do; with NARROW=1 as a telephone shows it.
import { mkdirSync } from 'node:fs';
import path from 'node:path';
import type { Page } from 'playwright-core';
import { exampleShop } from './example_shop';
import { kThemes, kWidths, openBrowser, visit } from './page';

const kNarrow = 390;

const kPlaces: Record<string, string> = {
  floor: '#/floor',
  wall: '#/floor?wall=1',
  machine: '#/machine/mill-1',
  prompt: '#/machine/lathe-1',
  setup: '#/machine/mill-1/setup',
  queue: '#/machine/mill-2/queue',
  'queue-held': '#/machine/mill-3/queue',
  'next-job': '#/machine/mill-3',
  runs: '#/machine/mill-2/runs',
  programs: '#/programs',
  program: '#/programs/O0600',
  search: '#/programs?words=pocket',
  filtered: '#/programs?part=Bracket+7-114',
  library: '#/programs/O0620',
  check: '#/programs/O0900',
  imports: '#/imports',
  import: '#/imports/O0700/3',
  path: '#/path/O0600?machine=mill-1&line=60',
  lathe: '#/path/O0500',
  compare: '#/compare/O0700/1/2?by=motion&machine=mill-1',
  normalized: '#/compare/O0700/1/2?by=normalized',
  reports: '#/reports',
  report: '#/reports/RUN?series=Z&lower=-1.9',
  parts: '#/measurements/parts',
  part: '#/measurements/parts/5',
  values: '#/measurements?characteristic=L&machine=lathe-3&rules=nelson',
  findings: '#/measurements/findings',
  studies: '#/measurements?characteristic=DIA&machine=lathe-3&kind=histogram',
  templates: '#/templates',
  template: '#/templates/shaft',
  archives: '#/administration/archives',
  corrections: '#/corrections',
  history: '#/corrections/lathe-3?target=T3.wear.Z',
  folders: '#/administration/folders',
  webhooks: '#/administration/webhooks',
  server: '#/administration/server',
  ports: '#/administration/ports',
  backups: '#/administration/backups',
  certificates: '#/administration/certificates',
  policy: '#/administration/policy',
  users: '#/administration/users/anna',
  groups: '#/administration/groups',
  audit: '#/administration/audit',
  account: '#/account',
  signin: '#/floor',
};

/// What is opened before a picture is taken.
const kPressed: Record<string, (page: Page) => Promise<void>> = {
  template: (page) => page.getByRole('button', { name: 'Try it' }).click(),
  archives: (page) => page.getByRole('button', { name: /^Read / }).first().click(),
  history: (page) => page.getByRole('button', { name: /of \d+$/ }).last().click(),
  report: (page) => page.locator('summary', { hasText: 'Tools and offsets' }).click(),
  part: (page) => page.getByText('More formats').click(),
  studies: async (page) => {
    await page.getByText('Gauge study (R&R)').click();
    await page.getByRole('button', { name: 'Compute' }).click();
  },
};

async function main(): Promise<void> {
  const folder = path.resolve(process.argv[2]!);
  mkdirSync(folder, { recursive: true });
  const shop = await exampleShop();
  const browser = await openBrowser();
  try {
    for (const [name, place] of Object.entries(kPlaces)) {
      if (process.argv[3] && !process.argv[3].split(',').some((part) => name.includes(part))) continue;
      const measured = await shop.api<{ runs: Array<{ id: string }> }>('GET', 'runs?machine=lathe-2&limit=1');
      const { page, complaints } = await visit(browser, shop, place.replace('RUN', measured?.runs[0]?.id ?? ''), name === 'signin' ? { user: null } : {});
      await page.waitForLoadState('networkidle', { timeout: 2000 }).catch(() => {}); // the event stream stays open
      await kPressed[name]?.(page);
      for (const theme of kThemes) {
        for (const width of process.env.NARROW ? [kNarrow] : kWidths) {
          await page.emulateMedia({ colorScheme: theme });
          await page.setViewportSize({ width, height: 900 });
          await page.waitForTimeout(400);
          await page.screenshot({ path: path.join(folder, `${name}-${theme}-${width}.png`), fullPage: name !== 'wall' && !process.env.ONE_SCREEN });
        }
      }
      if (complaints.length > 0) console.error(name, complaints);
      await page.context().close();
    }
  } finally {
    await browser.close();
    await shop.stop();
  }
}

void main();
