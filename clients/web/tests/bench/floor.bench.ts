// The floor with many machines: what page and server take of a core, how old a status on screen is, and how large and how quick the first view is.
// MACHINES (1000) gateways of bench_page_fleet write CHANGES (5) statuses a second each, for SECONDS (30). Prints one JSON object a figure.
import { spawn, type ChildProcess } from 'node:child_process';
import path from 'node:path';
import type { Page } from 'playwright-core';
import { openBrowser, visit } from '../browser/page';
import { Shop, until } from '../browser/shop';
import { childWith, sumOf, usesOf } from './processes';

const kMachines = Number(process.env.MACHINES ?? 1000);
const kChanges = Number(process.env.CHANGES ?? 5);
const kSeconds = Number(process.env.SECONDS ?? 30);

const figure = (name: string, value: number, unit: string) => console.log(JSON.stringify({ figure: name, value: Math.round(value * 1000) / 1000, unit }));
const pause = (ms: number) => new Promise((done) => setTimeout(done, ms));

/// DDS of a large shop (deploy/docs/operations.md): cells, and ms between two announcements.
const [kCells, kDiscovery] = kMachines > 300 ? ['32', '1000'] : ['8', '250'];

/// As many machines as one process of the fleet has.
const kPerProcess = 100;

class Fleet {
  private readonly members: Array<{ child: ChildProcess; text: string }> = [];

  constructor(shop: Shop) {
    const [domain, tag] = [shop.network[1]!, shop.network[3]!];
    for (let first = 1; first <= kMachines; first += kPerProcess) {
      const count = Math.min(kPerProcess, kMachines + 1 - first);
      const child = spawn(path.join(process.env.DRIPLINE_BIN!, 'bench_page_fleet'), [domain, tag, kCells!, kDiscovery!, String(first), String(count), String(kChanges)], { stdio: ['pipe', 'pipe', 'inherit'] });
      const member = { child, text: '' };
      child.stdout!.on('data', (bytes: Buffer) => { member.text += bytes.toString(); });
      this.members.push(member);
    }
  }
  connected(): Promise<void> {
    return until('the fleet is connected', () => this.members.every(({ text }) => text.includes('connected')), 600_000);
  }
  /// How many changes a second it has written.
  async end(): Promise<number> {
    await Promise.all(this.members.map(({ child }) => new Promise<void>((done) => {
      child.on('exit', () => done());
      child.stdin!.end();
    })));
    return this.members.reduce((sum, { text }) => sum + ((JSON.parse(text.split('\n')[1] || '{}') as { changes_per_second?: number }).changes_per_second ?? 0), 0);
  }
}

/// Of the first card, again and again: how long ago the gateway wrote the status that it shows. Both clocks are this computer's.
async function ageOnScreen(page: Page): Promise<number[]> {
  return page.evaluate(async () => {
    const ages: number[] = [];
    for (let i = 0; i < 40; ++i) {
      const card = document.querySelector<HTMLElement>('[data-machine="mill-1"]');
      const shown = card?.dataset.time;
      if (shown) ages.push(Date.now() - Date.parse(shown));
      await new Promise((done) => setTimeout(done, 97));
    }
    return ages;
  });
}

async function measureFloor(page: Page, shop: Shop, browser: number): Promise<void> {
  await page.goto(`${shop.url}/#/floor`);
  await page.waitForFunction((count) => document.querySelectorAll('.card').length >= count, kMachines);
  await pause(5000); // the first drawing is not what a screen on the wall does all day
  const before = { page: usesOf(browser), server: usesOf(shop.serverPid!) };
  const begin = performance.now();
  await pause(kSeconds * 1000);
  const seconds = (performance.now() - begin) / 1000;
  const after = { page: usesOf(browser), server: usesOf(shop.serverPid!) };
  for (const [kind, use] of after.page) figure(`page: ${kind}`, (use.seconds - (before.page.get(kind)?.seconds ?? 0)) / seconds, 'cores');
  figure('page', (sumOf(after.page).seconds - sumOf(before.page).seconds) / seconds, 'cores');
  figure('dncd', (sumOf(after.server).seconds - sumOf(before.server).seconds) / seconds, 'cores');
  figure('memory of the page', (after.page.get('renderer')?.bytes ?? 0) / 2 ** 20, 'MiB');
  figure('memory of dncd', sumOf(after.server).bytes / 2 ** 20, 'MiB');
  const ages = (await ageOnScreen(page)).sort((a, b) => a - b);
  if (ages.length > 0) {
    figure('age of a status on screen, median', ages[Math.floor(ages.length / 2)]!, 'ms');
    figure('age of a status on screen, 95 %', ages[Math.floor(ages.length * 0.95)]!, 'ms');
  }
}

async function measureFirstView(page: Page, shop: Shop): Promise<void> {
  const session = await page.context().newCDPSession(page);
  await session.send('Network.enable');
  await session.send('Network.setCacheDisabled', { cacheDisabled: true });
  const sizes = new Map<string, number>();
  const urls = new Map<string, string>();
  session.on('Network.requestWillBeSent', (event) => urls.set(event.requestId, event.request.url));
  session.on('Network.loadingFinished', (event) => sizes.set(urls.get(event.requestId) ?? '', event.encodedDataLength));
  const times: number[] = [];
  for (let i = 0; i < 5; ++i) {
    sizes.clear();
    await page.goto('about:blank');
    const begin = performance.now();
    await page.goto(`${shop.url}/#/floor`);
    await page.locator('.card').first().waitFor();
    times.push(performance.now() - begin);
  }
  const isPage = (url: string) => url === `${shop.url}/` || url.includes('/assets/');
  figure('first view', [...sizes].filter(([url]) => isPage(url)).reduce((sum, [, bytes]) => sum + bytes, 0) / 1024, 'KiB');
  figure('first view, median of 5', times.sort((a, b) => a - b)[2]!, 'ms');
}

async function main(): Promise<void> {
  const shop = new Shop();
  shop.serverArgs = ['--dds-cells', kCells!, '--discovery-interval-ms', kDiscovery!];
  await shop.startServer();
  const browser = await openBrowser();
  const first = await visit(browser, shop);
  const pid = childWith('chromium');
  await shop.startMachine('mill-0', { control: 'fanuc' });
  await measureFirstView(first.page, shop);
  await shop.stopMachine('mill-0');
  const fleet = new Fleet(shop);
  try {
    await fleet.connected();
    const { page } = await visit(browser, shop);
    await first.page.context().close();
    await page.setViewportSize({ width: 1920, height: 1080 });
    await measureFloor(page, shop, pid);
    figure('changes', await fleet.end(), '1/s');
  } finally {
    await browser.close();
    await shop.stop();
  }
}

void main();
