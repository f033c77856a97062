// A real Chromium that looks at a shop, and what every test wants to know of it: nothing was complained about, and nothing ran.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { after, afterEach, before } from 'node:test';
import { chromium, type Browser, type Locator, type Page, type Request } from 'playwright-core';
import { Shop } from './shop';

export const kWidths = [1280, 800] as const;
export const kThemes = ['light', 'dark'] as const;

/// WebGL as on a computer with a graphics processor, which the path needs; without one, drawing everything by it takes a multiple of Chromium's own drawing.
const kWebGl = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

export async function openBrowser(drawing = kWebGl): Promise<Browser> {
  return chromium.launch({
    executablePath: process.env.CHROMIUM!,
    args: ['--no-sandbox', ...drawing, '--disable-background-networking', '--force-device-scale-factor=1'],
  });
}

export interface Visit {
  page: Page;
  /// Errors and warnings of the console: also what the Content-Security-Policy has stopped.
  complaints: string[];
  requests: Requests;
}

/// What the page has asked the server for.
export interface Requests {
  /// Since the visit began.
  readonly asked: number;
  /// Not answered yet; a stream is answered when it begins.
  readonly waiting: number;
}

function watchRequests(page: Page): Requests {
  const waiting = new Set<Request>();
  let asked = 0;
  page.on('request', (request) => {
    if (request.isNavigationRequest()) waiting.clear(); // what the document before has asked for
    waiting.add(request);
    asked++;
  });
  page.on('response', (response) => waiting.delete(response.request()));
  page.on('requestfailed', (request) => waiting.delete(request));
  return { get asked() { return asked; }, get waiting() { return waiting.size; } };
}

/// Long enough for a computer that does much else; a condition that holds ends the wait at once.
const kPatienceMs = 60_000;

export interface VisitOptions {
  language?: string;
  /// Signed in as this user; null: as none.
  user?: string | null;
}

export async function visit(browser: Browser, shop: Shop, place = '', options: VisitOptions = {}): Promise<Visit> {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, locale: options.language ?? 'en-US', acceptDownloads: true });
  context.setDefaultTimeout(kPatienceMs);
  const page = await context.newPage();
  const complaints: string[] = [];
  const requests = watchRequests(page);
  page.on('console', (message) => {
    const isLostServer = message.text().includes('ERR_CONNECTION_REFUSED') || message.text().includes('net::ERR_');
    if (['error', 'warning'].includes(message.type()) && !isLostServer) complaints.push(message.text());
  });
  page.on('pageerror', (failure) => complaints.push(String(failure)));
  page.on('dialog', (dialog) => {
    complaints.push(`dialog: ${dialog.message()}`);
    void dialog.dismiss();
  });
  const user = options.user === undefined ? 'admin' : options.user;
  if (user !== null) await context.addCookies([{ ...(await shop.sessionOf(user)), url: shop.url }]);
  await page.goto(`${shop.url}/${place}`);
  return { page, complaints, requests };
}

/// A shop and a browser for the tests of a file; what a test has opened is closed after it.
export function shopForTests(prepare: (shop: Shop) => Promise<void>, argsOf: (shop: Shop) => string[] = () => []) {
  const shop = new Shop();
  shop.serverArgs = argsOf(shop);
  let browser: Browser | undefined;
  before(async () => {
    await shop.startServer();
    await prepare(shop);
    browser = await openBrowser();
  });
  afterEach(async () => {
    for (const context of browser?.contexts() ?? []) await context.close();
  });
  after(async () => {
    await browser?.close();
    await shop.stop();
  });
  return { shop, visit: (place = '', options: VisitOptions = {}) => visit(browser!, shop, place, options) };
}

/// Status codes that the console reports although the page expects them.
export function assertNoComplaints(complaints: string[], expected: number[] = []): void {
  const isExpected = (text: string) => expected.some((status) => text.includes(`status of ${status}`));
  assert.deepEqual(complaints.filter((text) => !isExpected(text)), []);
}

/// Presses a button that asks for a second press; on a busy computer the question may be gone before, and the first press is repeated.
export async function pressTwice(button: Locator, question: Locator): Promise<void> {
  for (const end = Date.now() + kPatienceMs; ;) {
    await button.click();
    try {
      await question.click({ timeout: 4000 });
      return;
    } catch (failure) {
      if (Date.now() > end) throw failure;
    }
  }
}

interface AxeWindow extends Window {
  axe?: { run(options: unknown): Promise<{ violations: Array<{ id: string; nodes: Array<{ html: string; failureSummary: string }> }> }> };
}

/// Boxes that lie on each other, or leave the screen: what no font and no pixel can cause. Runs in the page.
function findCollisions(): string[] {
  const kSlack = 2; // px
  const found: string[] = [];
  if (document.documentElement.scrollWidth > innerWidth) found.push('wider than the screen');
  const boxes = [...document.querySelectorAll('main :is(.panel, .card, .notice, button, input, select, h1, h2)')]
    .filter((element) => element.checkVisibility() && !element.closest('.visually-hidden, .scroll, .code, .records, .diff')) // cut, or scrolled
    .map((element) => ({ element, box: element.getBoundingClientRect() }))
    .filter(({ box }) => box.width > kSlack && box.height > kSlack);
  for (const [i, a] of boxes.entries()) {
    for (const b of boxes.slice(i + 1)) {
      if (a.element.contains(b.element) || b.element.contains(a.element)) continue;
      const width = Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left);
      const height = Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top);
      if (width > kSlack && height > kSlack) found.push(`${a.element.outerHTML.slice(0, 80)} lies on ${b.element.outerHTML.slice(0, 80)}`);
    }
  }
  return found;
}

/// What axe-core finds; empty: nothing. Each theme once and each width once: colors do not depend on the width.
export async function findBarriers(page: Page): Promise<string[]> {
  const axe = readFileSync(path.join(process.env.WEB!, 'node_modules/axe-core/axe.min.js'), 'utf8');
  // Evaluated over the debugger, which the page's own policy does not concern.
  if (!(await page.evaluate(() => 'axe' in window))) await page.evaluate(axe);
  const found: string[] = [];
  for (const [i, theme] of kThemes.entries()) {
    const width = kWidths[i]!;
    await page.emulateMedia({ colorScheme: theme });
    await page.setViewportSize({ width, height: 800 });
    const violations = await page.evaluate(async () => {
      const { violations } = await (window as AxeWindow).axe!.run({ runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] });
      return violations.flatMap((v) => v.nodes.map((n) => `${v.id}: ${n.html.slice(0, 200)} ${n.failureSummary}`));
    });
    found.push(...violations.map((violation) => `${theme} ${width}: ${violation}`));
    found.push(...(await page.evaluate(findCollisions)).map((collision) => `${theme} ${width}: ${collision}`));
  }
  return found;
}
