// The page of `spoolflow fleet` in Chromium, over ten thousand valves whose rows were made in a PostgreSQL server of its own.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { chromium } from 'playwright-core';

const pictures = process.env.SPOOLFLOW_PICTURES;
const valves = 10000;
let browser, fleet, address;

before(async () => {
  fleet = spawn('/usr/bin/python3', [process.env.SPOOLFLOW_FLEET, process.env.SPOOLFLOW_COMMAND, String(valves)],
                { stdio: ['pipe', 'pipe', 'inherit'] });
  address = await new Promise((resolve, reject) => {
    fleet.on('exit', (status) => reject(new Error(`ended with ${status}`)));
    fleet.stdout.on('data', (text) => resolve(String(text).trim()));
  });
  browser = await chromium.launch({
    executablePath: process.env.SPOOLFLOW_BROWSER,
    args: ['--no-sandbox', '--disable-background-networking', '--disable-gpu', '--disable-dev-shm-usage'],
  });
  if (pictures) mkdirSync(pictures, { recursive: true });
});
after(async () => {
  await browser?.close();
  const ended = new Promise((resolve) => fleet.on('exit', resolve));
  fleet.stdin.end();
  await ended;
});

async function opened(hash = '#/', { width = 1280, height = 900, colorScheme = 'light' } = {}) {
  const page = await (await browser.newContext({ colorScheme, viewport: { width, height } })).newPage();
  const complaints = [];
  page.on('console', (message) => complaints.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`error: ${error.message}`));
  page.on('request', (request) => {
    if (!request.url().startsWith(`${address}/`) && !request.url().startsWith('data:')) complaints.push(`asked for ${request.url()}`);
  });
  await page.goto(`${address}/${hash}`);
  return { page, complaints };
}
async function picture(page, name) {
  if (pictures) await page.screenshot({ path: join(pictures, `fleet_${name}.png`) });
}

test('ten thousand valves scroll as quickly as ten, as only those are there that can be seen', async () => {
  const { page, complaints } = await opened();
  await page.waitForFunction((count) => document.querySelector('.count')?.textContent === `${count} of ${count} valves`, valves,
                             { timeout: 60000 });
  assert.match(await page.locator('#totals').textContent(), /^10000 valves of 20 sites, 20 not good, 40 silent$/);
  assert.ok(await page.locator('a.line').count() < 80);
  await picture(page, 'overview');
  const frames = await page.evaluate(async () => {
    const list = document.querySelector('.list'), times = [];
    let last = performance.now();
    for (let k = 0; k < 120; ++k) {
      list.scrollTop += (list.scrollHeight - list.clientHeight) / 119;
      await new Promise(requestAnimationFrame);
      const now = performance.now();
      times.push(now - last);
      last = now;
    }
    return times.sort((a, b) => a - b);
  });
  console.log(`frames while scrolling through all: median ${frames[60].toFixed(1)} ms, 95 % ${frames[114].toFixed(1)} ms, ` +
    `longest ${frames[119].toFixed(1)} ms`);
  await page.waitForFunction(() => [...document.querySelectorAll('a.line')].some((one) => !one.hidden && one.textContent.includes('hall_19/valve_09999')));
  assert.deepEqual(complaints, []);
});

test('search, site and sign narrow the list', async () => {
  const { page, complaints } = await opened();
  await page.waitForSelector('a.line');
  await page.fill('input[type=search]', 'VALVE_0100');
  await page.waitForFunction(() => document.querySelector('.count').textContent.startsWith('10 of'));
  await page.fill('input[type=search]', '');
  await page.getByRole('button', { name: 'hall_00', exact: true }).click();
  await page.waitForFunction(() => document.querySelector('.count').textContent.startsWith('500 of'));
  await page.locator('select').filter({ hasText: 'not good' }).selectOption('bad');
  await page.waitForFunction(() => document.querySelector('.count').textContent.startsWith('20 of'));
  assert.deepEqual(complaints, []);
});

test('the valves that differ from their sisters are named, and lead to their days', async () => {
  const { page, complaints } = await opened('#/series');
  await page.waitForSelector('.named a', { timeout: 30000 });
  assert.match(await page.locator('h3').first().textContent(), /^friction ratio: 10 of 5000 valves differ from their sisters$/);
  assert.equal(await page.locator('.named a').count(), 10);
  await page.waitForTimeout(300);
  await picture(page, 'series');
  await page.locator('.named a').first().click();
  await page.waitForSelector('h2:has-text("hall_00/valve_")');
  await page.goto(`${address}/#/valve/hall_01%2Fvalve_00001`);
  await page.waitForFunction(() => document.querySelectorAll('figure.history').length === 12, undefined, { timeout: 30000 });
  await page.waitForSelector('.events li:has-text("made for this test")');
  await picture(page, 'valve');
  assert.deepEqual(complaints, []);
});

test('an alarm is acknowledged by a button', async () => {
  const { page, complaints } = await opened('#/alarms');
  await page.waitForSelector('.alarm');
  assert.equal(await page.locator('.alarm').count(), 20);
  const count = Number(await page.locator('#alarm-count').textContent());
  await page.getByRole('button', { name: /^Acknowledge alarm 1: friction of hall_00\/valve_01000$/ }).click();
  await page.waitForSelector('.alarm[data-state=raised_acknowledged]:has-text("acknowledged by local")');
  await page.waitForFunction((was) => Number(document.querySelector('#alarm-count').textContent) === was - 1, count);
  const alarm = page.locator('.alarm:has-text("hall_00/valve_01000")');
  await alarm.locator('.desk summary').click();
  await alarm.getByRole('textbox').fill('a valve is on its way');
  await alarm.getByRole('button', { name: 'Comment', exact: true }).click();
  await alarm.locator('.comments li:has-text("local a valve is on its way")').waitFor();
  await alarm.getByRole('button', { name: 'Shelve' }).click();
  await page.waitForSelector('.alarm[data-state=shelved]:has-text("shelved by local until")');
  await picture(page, 'alarms');
  await alarm.getByRole('button', { name: 'Take off the shelf' }).click();
  await page.waitForSelector('.alarm[data-state=raised_acknowledged]:has-text("hall_00/valve_01000")');
  assert.deepEqual(complaints, []);
});

test('narrow and dark, nothing goes beyond the page', async () => {
  for (const hash of ['#/', '#/alarms', '#/series', '#/workers', '#/valve/hall_01%2Fvalve_00001']) {
    for (const [width, colorScheme] of [[390, 'dark'], [1280, 'dark']]) {
      const { page, complaints } = await opened(hash, { width, height: 844, colorScheme });
      await page.waitForSelector({ '#/': 'a.line', '#/alarms': '.alarm', '#/series': '.named a', '#/workers': '.partitions td' }[hash] ??
                                 'figure.history', { timeout: 30000 });
      const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      assert.ok(content <= window, `${hash}: ${content} px of content at ${width} px`);
      assert.deepEqual(complaints, []);
      await picture(page, `${hash.slice(2).replace(/[^a-z]/g, '_')}_${width}`);
      await page.context().close();
    }
  }
});
