// The page that works in a browser alone, as its tests open it: from a file, in a real browser.
import { chromium } from 'playwright-core';

export const file = process.env.SPOOLFLOW_PAGE;

export const started = () => chromium.launch({
  executablePath: process.env.SPOOLFLOW_BROWSER,
  args: ['--no-sandbox', '--disable-background-networking', '--disable-gpu', '--disable-dev-shm-usage'],
});

/** The page, ready; whatever it asks of a network or complains of is collected. */
export async function opened(browser, { width = 1280, colorScheme = 'light', hash = '' } = {}) {
  const page = await (await browser.newContext({ viewport: { width, height: 900 }, colorScheme })).newPage();
  const complaints = [];
  page.on('console', (message) => complaints.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`error: ${error.message}`));
  page.on('request', (request) => {
    if (!/^(file|blob|data|about):/.test(request.url())) complaints.push(`asked for ${request.url()}`);
  });
  await page.goto(`file://${file}${hash}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready !== undefined, undefined, { timeout: 60000 });
  return { page, complaints };
}

export const idle = (page, timeout = 60000) => page.waitForFunction(() => document.querySelector('.files[aria-busy]') === null, undefined, { timeout });
/** By how many pixels the page is wider than its window. */
export const wide = (page) => page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
