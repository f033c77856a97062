// The floor with many machines: what page and server take of a core, how old a status on screen is, and how large and how quick the first view is.
// MACHINES (1000) gateways of bench_page_fleet write CHANGES (5) statuses a second each, for SECONDS (30). Prints one JSON object a figure.
import { spawn, type ChildProcess } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import path from 'node:path';
import type { Page } from 'playwright-core';
import { EventParser } from '../../src/live/event_parser';
import { openBrowser, visit } from '../browser/page';
import { Shop, until } from '../browser/shop';
import { childWith, sumOf, usesOf } from './processes';

const kMachines = Number(process.env.MACHINES ?? 1000);
const kChanges = Number(process.env.CHANGES ?? 5);
const kSeconds = Number(process.env.SECONDS ?? 30);
const kAgesMs = 10_000;

const figure = (name: string, value: number, unit: string) => console.log(JSON.stringify({ figure: name, value: Math.round(value * 1000) / 1000, unit }));
const pause = (ms: number) => new Promise((done) => setTimeout(done, ms));

/// DDS of a large shop (deploy/docs/operations.md): cells, ms between two announcements, and of silence after which an end is lost.
const [kCells, kDiscovery, kLease] = kMachines > 300 ? ['32', process.env.DISCOVERY ?? '4000', process.env.LEASE ?? '10000'] : ['8', '250', '2000'];

/// As many machines as one process of the fleet has.
const kPerProcess = 100;

class Fleet {
  private readonly members: Array<{ child: ChildProcess; text: string }> = [];

  constructor(shop: Shop) {
    const [domain, tag] = [shop.network[1]!, shop.network[3]!];
    for (let first = 1; first <= kMachines; first += kPerProcess) {
      const count = Math.min(kPerProcess, kMachines + 1 - first);
      const child = spawn(path.join(process.env.DRIPLINE_BIN!, 'bench_page_fleet'), [domain, tag, kCells!, kDiscovery!, kLease!, String(first), String(count), String(kChanges)], { stdio: ['pipe', 'pipe', 'inherit'] });
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

/// Of the cards in sight, again and again: how long ago the gateways wrote the statuses that they show. All clocks are this computer's.
async function agesOnScreen(page: Page): Promise<number[]> {
  return page.evaluate(async (end) => {
    const cards = [...document.querySelectorAll<HTMLElement>('.card:not(.offline)')].filter((card) => card.getBoundingClientRect().top < innerHeight);
    const ages: number[] = [];
    for (const begin = Date.now(); Date.now() < begin + end;) {
      for (const card of cards) ages.push(Date.now() - Date.parse(card.dataset.time!));
      await new Promise((done) => setTimeout(done, 50 + 100 * Math.random()));
    }
    return ages;
  }, kAgesMs);
}

/// As a reader of the event stream knows them: how old the latest status of each machine is, again and again.
async function agesInStream(page: Page, shop: Shop): Promise<number[]> {
  const times = new Map<string, number>();
  const ending = new AbortController();
  const cookie = (await page.context().cookies()).map(({ name, value }) => `${name}=${value}`).join('; ');
  const response = await fetch(`${shop.url}/api/v1/events?changes=yes`, { headers: { Cookie: cookie }, signal: ending.signal });
  const reading = (async () => {
    const parser = new EventParser();
    const decoder = new TextDecoder();
    const reader = response.body!.getReader();
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      for (const { name, data } of parser.take(decoder.decode(part.value, { stream: true }))) {
        if (name !== 'machine' && name !== 'change') continue;
        const machine = JSON.parse(data) as { name: string; status?: { time?: string } | null };
        if (machine.status?.time) times.set(machine.name, Date.parse(machine.status.time));
      }
    }
  })().catch(() => {}); // it is ended
  await pause(2000);
  const ages: number[] = [];
  for (const begin = Date.now(); Date.now() < begin + kAgesMs;) {
    for (const time of times.values()) ages.push(Date.now() - time);
    await pause(50 + 100 * Math.random());
  }
  ending.abort();
  await reading;
  return ages;
}

function figureAges(where: string, ages: number[]): void {
  ages.sort((a, b) => a - b);
  for (const [name, part] of [['median', 0.5], ['95 %', 0.95], ['99 %', 0.99]] as const)
    figure(`age of a status ${where}, ${name}`, ages[Math.floor(ages.length * part)] ?? NaN, 'ms');
}

/// What the page's script does in ten seconds, for the profiler of a browser's developer tools.
async function profile(page: Page, file: string): Promise<void> {
  const session = await page.context().newCDPSession(page);
  await session.send('Profiler.enable');
  await session.send('Profiler.setSamplingInterval', { interval: 500 });
  await session.send('Profiler.start');
  await pause(10_000);
  const { profile } = await session.send('Profiler.stop');
  writeFileSync(file, JSON.stringify(profile));
  await session.detach();
}

async function measureFloor(page: Page, shop: Shop, browser: number): Promise<void> {
  await page.goto(`${shop.url}/#/floor`);
  await page.waitForFunction((count) => document.querySelectorAll('.card').length >= count, kMachines);
  await pause(5000); // the first drawing is not what a screen on the wall does all day
  if (process.env.PROFILE) await profile(page, process.env.PROFILE);
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
  figureAges('on screen', await agesOnScreen(page));
  figureAges('in the event stream', await agesInStream(page, shop));
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
  shop.serverArgs = ['--dds-cells', kCells!, '--discovery-interval-ms', kDiscovery!, '--lease-ms', kLease!];
  await shop.startServer();
  const browser = await openBrowser(['--disable-gpu']);
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
