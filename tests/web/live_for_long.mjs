// The page of a running `spoolflow live` in a real browser for as long as wanted: what would grow, stall or go stale shows.
//   SPOOLFLOW_BROWSER=chromium node live_for_long.mjs http://127.0.0.1:PORT SECONDS VALVE
// One tab shows all valves, another the plot of VALVE. A line a minute; the exit status shows whether all was well.
import assert from 'node:assert/strict';
import { chromium } from 'playwright-core';

const [url, seconds, valve] = [process.argv[2], Number(process.argv[3]), process.argv[4]];
const settles_s = Math.min(300, seconds / 4);  // plots and sparklines fill up until then
const browser = await chromium.launch({
  executablePath: process.env.SPOOLFLOW_BROWSER,
  args: ['--no-sandbox', '--disable-background-networking', '--disable-gpu', '--disable-dev-shm-usage'],
});
const complaints = [];

/** A tab, and what the browser says it costs. */
async function tab(name, place) {
  const page = await (await browser.newContext()).newPage();
  page.on('console', (message) => complaints.push(`${name}: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`${name}: ${error.message}`));
  await page.goto(url + place);
  const tools = await page.context().newCDPSession(page);
  await tools.send('Performance.enable');
  let before = { TaskDuration: 0, Timestamp: 0 };
  return {
    name, page,
    async cost() {
      await tools.send('HeapProfiler.collectGarbage');
      const { metrics } = await tools.send('Performance.getMetrics');
      const now = Object.fromEntries(metrics.map((one) => [one.name, one.value]));
      const busy = (now.TaskDuration - before.TaskDuration) / (now.Timestamp - before.Timestamp);
      before = now;
      return { heap_MB: now.JSHeapUsedSize / 1e6, nodes: now.Nodes, busy };
    },
  };
}

const tabs = [await tab('all valves', '/'), await tab(valve, `/#/valve/${valve}`)];
await tabs[0].page.waitForSelector('.card');
await tabs[1].page.waitForSelector('canvas');
const settled = new Map();
const began = Date.now();
for (let lines = 0; Date.now() - began < 1000 * seconds;) {
  await new Promise((resolve) => setTimeout(resolve, Math.min(60_000, 1000 * seconds / 8)));
  const passed_s = (Date.now() - began) / 1000;
  let line = `${passed_s.toFixed(0).padStart(7)} s:`;
  for (const one of tabs) {
    const cost = await one.cost();
    line += ` ${one.name}: ${cost.heap_MB.toFixed(1)} MB, ${cost.nodes} nodes, ${cost.busy.toFixed(2)} of a core;`;
    const stale = await one.page.$$eval('.stale', (all) => all.filter((each) => each.checkVisibility()).map((each) => each.textContent).filter(Boolean));
    if (stale.length > 0) complaints.push(`${one.name} after ${passed_s.toFixed(0)} s: ${stale.join(' ')}`);
    if (passed_s >= settles_s && !settled.has(one)) settled.set(one, cost);
    one.last = cost;
  }
  const shown = await tabs[0].page.$$eval('.card', (all) => all.length);
  console.log(`${line} ${shown} cards`);
  lines += 1;
}
await browser.close();
assert.deepEqual(complaints, []);
for (const one of tabs) {
  const first = settled.get(one);
  assert.ok(one.last.heap_MB < 1.2 * first.heap_MB + 2, `${one.name}: ${first.heap_MB} MB became ${one.last.heap_MB} MB`);
  assert.ok(one.last.nodes < 1.2 * first.nodes + 100, `${one.name}: ${first.nodes} nodes became ${one.last.nodes}`);
}
