// A real Chromium that looks at a shop, and what every test wants to know of it: nothing was complained about, and nothing ran.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { chromium, type Browser, type Page } from 'playwright-core';
import type { Shop } from './shop';

export const kWidths = [1280, 800] as const;
export const kThemes = ['light', 'dark'] as const;

export async function openBrowser(): Promise<Browser> {
  return chromium.launch({
    executablePath: process.env.CHROMIUM!,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-background-networking', '--force-device-scale-factor=1'],
  });
}

export interface Visit {
  page: Page;
  /// Errors and warnings of the console: also what the Content-Security-Policy has stopped.
  complaints: string[];
}

/// Signed in unless `isSignedIn` says otherwise.
export async function visit(browser: Browser, shop: Shop, place = '', options: { language?: string; isSignedIn?: boolean } = {}): Promise<Visit> {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, locale: options.language ?? 'en-US', acceptDownloads: true });
  const page = await context.newPage();
  const complaints: string[] = [];
  page.on('console', (message) => {
    const isLostServer = message.text().includes('ERR_CONNECTION_REFUSED') || message.text().includes('net::ERR_');
    if (['error', 'warning'].includes(message.type()) && !isLostServer) complaints.push(message.text());
  });
  page.on('pageerror', (failure) => complaints.push(String(failure)));
  page.on('dialog', (dialog) => {
    complaints.push(`dialog: ${dialog.message()}`);
    void dialog.dismiss();
  });
  if (options.isSignedIn ?? true) {
    await page.addInitScript((token) => sessionStorage.setItem('dripline.token', token), shop.token);
  }
  await page.goto(`${shop.url}/${place}`);
  return { page, complaints };
}

/// What axe-core finds in both themes and at both widths; empty: nothing.
export async function findBarriers(page: Page): Promise<string[]> {
  const axe = readFileSync(path.join(process.env.WEB!, 'node_modules/axe-core/axe.min.js'), 'utf8');
  const found = new Set<string>();
  for (const theme of kThemes) {
    for (const width of kWidths) {
      await page.emulateMedia({ colorScheme: theme });
      await page.setViewportSize({ width, height: 800 });
      // Evaluated over the debugger, which the page's own policy does not concern.
      await page.evaluate(axe);
      const violations = await page.evaluate(async () => {
        const axe = (window as unknown as { axe: { run(options: unknown): Promise<{ violations: Array<{ id: string; nodes: Array<{ html: string; failureSummary: string }> }> }> } }).axe;
        const { violations } = await axe.run({ runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] });
        return violations.flatMap((v) => v.nodes.map((n) => `${v.id}: ${n.html.slice(0, 200)} ${n.failureSummary}`));
      });
      for (const violation of violations) found.add(`${theme} ${width}: ${violation}`);
      if (await page.evaluate(() => document.documentElement.scrollWidth > innerWidth)) found.add(`${theme} ${width}: wider than the screen`);
    }
  }
  return [...found];
}
