// docs/playground.md, step by step, with the page as it is checked in. Its answers are held against the command's by playground.mjs alone: between a
// change of the sensor and the page's renewal they may differ.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { idle, opened, started, wide } from './playground_page.mjs';

test('the walk of the playground', async () => {
  const browser = await started();
  try {
    const { page, complaints } = await opened(browser);
    const worked = () => page.evaluate(() => Number(document.querySelector('.valve').dataset.worked));
    await page.waitForFunction(() => Number(document.querySelector('.valve').dataset.worked) > 1);
    await page.locator('input[name=command_percent]').fill('80');
    const from = await worked();
    await page.waitForFunction((until) => Number(document.querySelector('.valve').dataset.worked) > until, from + 1.5);
    const { flow, truth } = await page.evaluate(() => document.querySelector('.valve').dataset);
    assert.ok(truth > 30 && Math.abs(flow - truth) < 10, `${flow} and ${truth} L/min`);

    await page.goto(page.url().replace(/#.*|$/, '#files'));
    await page.getByText('Make an example').click();
    await page.waitForSelector('.file[aria-current]', { timeout: 60000 });
    await idle(page);
    assert.match(await page.textContent('.said'), /current +A/);
    await page.getByRole('button', { name: 'Estimate' }).click();
    await page.waitForSelector('.sentence', { timeout: 60000 });
    await idle(page);
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: /Save .*estimate/ }).click()]);
    const rows = readFileSync(await download.path(), 'utf8').trim().split('\n');
    assert.ok(rows[0].startsWith('time_s,flow_L_min,'), rows[0]);
    assert.ok(rows.length > 5000, `${rows.length} rows of 20 s`);
    await page.getByRole('button', { name: 'Compare with the reference flow' }).click();
    await page.waitForSelector('text=Save the report (HTML)', { timeout: 60000 });
    await idle(page);
    await page.frameLocator('iframe.report').locator('h1').waitFor({ timeout: 30000 });
    assert.ok(await wide(page) <= 0);
    assert.deepEqual(complaints.filter((each) => !/sandbox/.test(each)), []);
  } finally {
    await browser.close();
  }
});
