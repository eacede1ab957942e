// The page of `spoolflow live` in a real browser, with real running sources: a valve of the rig, replays, datagrams.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { chromium } from 'playwright-core';

const command = process.env.SPOOLFLOW_COMMAND, examples = process.env.SPOOLFLOW_EXAMPLES;
const pictures = process.env.SPOOLFLOW_PICTURES;
const folder = mkdtempSync(join(tmpdir(), 'spoolflow-live-page-'));
const children = [];
let browser, served;

/** A recording of a valve that is moved to and fro; behind `healthy_s` its position is missing. */
function recording(seconds, healthy_s) {
  const lines = ['time_s,current_A,voltage_V,position_mm,oil_temperature_C'];
  for (let k = 0; k < 1000 * seconds; ++k) {
    const swing = 0.5 - 0.5 * Math.cos(2 * Math.PI * k / 4000);
    const position = k < 1000 * healthy_s ? (0.4 + 1.2 * swing).toFixed(4) : 'NaN';
    lines.push(`${(k / 1000).toFixed(3)},${(0.9 + 0.9 * swing).toFixed(4)},${(3 + 3 * swing).toFixed(3)},${position},45`);
  }
  return lines.join('\n') + '\n';
}

/** A port that the kernel gives to nobody while the program is away, as it would one of those above 32768. */
async function ownPort() {
  for (;;) {
    const port = 10000 + Math.floor(22000 * Math.random());
    const server = createServer();
    const free = await new Promise((resolve) => server.once('error', () => resolve(false)).listen(port, '127.0.0.1', () => resolve(true)));
    if (free) await new Promise((resolve) => server.close(resolve));
    if (free) return port;
  }
}

/** Starts the program and waits until it says where its page is. */
function start(site, ...more) {
  const child = spawn(command, ['live', site, ...more], { cwd: folder, stdio: ['ignore', 'ignore', 'pipe'] });
  children.push(child);
  return new Promise((resolve, reject) => {
    let said = '';
    child.on('exit', (status) => reject(new Error(`ended with ${status}: ${said}`)));
    child.stderr.on('data', (text) => {
      said += text;
      const page = /page at (https?:\/\/\S+?:(\d+))\//.exec(said);
      const udp = /over UDP at \S+?:(\d+)/.exec(said);
      if (page) resolve({ child, url: page[1], port: Number(page[2]), udp: udp === null ? 0 : Number(udp[1]) });
    });
  });
}

/** Resolves when it has ended, by itself or by a signal, before this call or after. */
function exited(child) {
  return new Promise((resolve) => {
    if (child.exitCode !== null || child.signalCode !== null) resolve();
    else child.on('exit', resolve);
  });
}

function ended(child) {
  child.kill('SIGTERM');
  return exited(child);
}

/** Datagrams of the recording, as often as they are asked for; ends by itself. */
function send(valve, file, port) {
  const child = spawn('/usr/bin/python3', [join(examples, 'live', 'send_samples.py'), join(folder, file), valve, `127.0.0.1:${port}`],
                      { stdio: 'ignore' });
  children.push(child);
  return child;
}

const site = (listen) => `
[page]
listen = "${listen}"
[store]
file = "site.sqlite"
raw_before_s = 10
raw_after_s = 1
[sources]
udp = "127.0.0.1:0"
[alarms]
raised_after_s = 1
[[valve]]
id = "press_1"
model = "model.json"
source = { kind = "rig", seed = 7 }
[[valve]]
id = "press_2"
model = "model.json"
source = { kind = "replay", recording = "sound.csv", repeats = true }
[[valve]]
id = "clamp_torn_cable"
model = "model.json"
source = { kind = "replay", recording = "torn.csv" }
[[valve]]
id = "feed_udp"
model = "model.json"
source = { kind = "udp" }
`;

before(async () => {
  copyFileSync(join(examples, 'live', 'size_6.json'), join(folder, 'model.json'));
  writeFileSync(join(folder, 'sound.csv'), recording(60, 60));
  writeFileSync(join(folder, 'short.csv'), recording(6, 6));
  writeFileSync(join(folder, 'torn.csv'), recording(600, 3));  // longer than all tests: its end would be another valve without samples
  writeFileSync(join(folder, 'site.toml'), site(`127.0.0.1:${await ownPort()}`));
  served = await start('site.toml');
  browser = await chromium.launch({
    executablePath: process.env.SPOOLFLOW_BROWSER,
    args: ['--no-sandbox', '--disable-background-networking', '--disable-gpu', '--disable-dev-shm-usage'],
  });
  if (pictures) mkdirSync(pictures, { recursive: true });
});
after(async () => {
  await browser?.close();
  for (const child of children) await ended(child);
  rmSync(folder, { recursive: true });
});

// Pages that stay open go on drawing, and slow down the tests that follow.
afterEach(async () => {
  for (const context of browser?.contexts() ?? []) await context.close();
});

/** A page of its own; what its console says and whom it asks besides the program is collected. */
async function opened(hash = '#/', { width = 1280, height = 900, colorScheme = 'light', url = served.url, own = [] } = {}) {
  const context = await browser.newContext({ colorScheme, viewport: { width, height }, ignoreHTTPSErrors: true });
  context.setDefaultTimeout(60000);  // conditions are waited for; how long they take is the machine's matter
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (message) => own.some((one) => message.text().includes(one)) || complaints.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`error: ${error.message}`));
  page.on('request', (request) => {
    if (!request.url().startsWith(`${url}/`) && !request.url().startsWith('data:')) complaints.push(`asked for ${request.url()}`);
  });
  await page.goto(`${url}/${hash}`);
  return { page, complaints };
}

async function picture(page, name) {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`), fullPage: true });
}

const drawing = (page) => page.locator('canvas.plot').evaluate((canvas) => canvas.toDataURL());
async function moves(page) {
  const was = await drawing(page);
  await page.waitForFunction((before) => document.querySelector('canvas.plot').toDataURL() !== before, was);
}

test('the overview shows every valve with flow, band, sign and what is worst', async () => {
  const sender = send('feed_udp', 'short.csv', served.udp);
  const { page, complaints } = await opened();
  await page.waitForFunction(() => document.querySelectorAll('.card').length === 4);
  await page.waitForFunction(() => [...document.querySelectorAll('.card[data-stalled=false] .flow')].filter((each) =>
    /^\d+\.\d\d L\/min$/.test(each.textContent)).length >= 3);
  assert.deepEqual((await page.locator('.card .name').allTextContents()).sort(), ['clamp_torn_cable', 'feed_udp', 'press_1', 'press_2']);
  // Problems come first by themselves: behind the last card that is not good are good ones alone.
  await page.waitForFunction(() => {
    const signs = [...document.querySelectorAll('.card .sign')].map((each) => each.dataset.sign !== 'good');
    return signs.includes(true) && !signs.slice(signs.indexOf(false)).includes(true);
  });
  await page.locator('label:has-text("problems first") input').uncheck();
  assert.deepEqual(await page.locator('.card .name').allTextContents(), ['press_1', 'press_2', 'clamp_torn_cable', 'feed_udp']);
  assert.deepEqual(await page.locator('.card').first().locator('.axis span').allTextContents(), ['\u22122 min', '\u22121 min', 'now']);
  for (const text of await page.locator('.card .band').allTextContents()) assert.match(text, /^(−?\d+\.\d\d|–) to (\d+\.\d\d|–)$/);
  assert.match(await page.locator('#totals').textContent(), /^4 valves, (\d not|all) good(, \d without samples)?; .* L\/min, .* kW hydraulic$/);
  const line = () => page.locator('.card .spark .line').first().getAttribute('d');
  const before = await line();
  await page.waitForFunction((was) => document.querySelector('.card .spark .line').getAttribute('d') !== was, before);
  assert.match(await page.locator('.card .spark .area').first().getAttribute('d'), /^M.*Z$/);  // the band
  // A page that is opened later begins with what was before it: it has more points than there were seconds since it was opened.
  const points = ([least, since]) => {
    const card = [...document.querySelectorAll('.card')].find((each) => each.querySelector('.name').textContent === 'press_1');
    return (card?.querySelector('.line').getAttribute('d') ?? '').split(/[ML]/).length - 1 >= least + (since ? performance.now() / 1000 : 0);
  };
  await page.waitForFunction(points, [10, false]);
  const second = await opened();
  await second.page.waitForFunction(points, [5, true]);
  await page.fill('input[type=search]', 'press');
  assert.equal(await page.locator('.card').count(), 2);
  assert.deepEqual(complaints, []);
  await exited(sender);
});

test('alarms are raised, acknowledged by a button, and stay acknowledged over a new start', async () => {
  const { page, complaints } = await opened('#/', { own: ['net::ERR'] });
  // The sender of datagrams has ended, and the torn cable's position is missing.
  await page.waitForSelector('.alarm:has-text("feed_udp"):has-text("no samples")');
  const torn = page.locator('.alarm:has-text("clamp_torn_cable"):has-text("function check")').first();
  await torn.waitFor();
  // What stands on the card of the valve without samples is marked as old, in its figures as in words.
  const quiet = page.locator('.card:has-text("feed_udp")');
  assert.match(await quiet.locator('.flow').textContent(), /^last /);
  assert.match(await quiet.locator('.worst').textContent(), /^no samples for \d+ s/);
  // Flow and band lie beside or above each other.
  for (const width of [1400, 400]) {
    await page.setViewportSize({ width, height: 900 });
    const [flow, band] = await quiet.evaluate((card) => ['.flow', '.band'].map((name) => {
      const text = document.createRange();
      text.selectNodeContents(card.querySelector(name));
      return text.getBoundingClientRect().toJSON();
    }));
    assert.ok(flow.right <= band.left || flow.bottom <= band.top, `${width}: ${JSON.stringify([flow, band])}`);
  }
  await page.setViewportSize({ width: 1280, height: 900 });
  assert.match(await page.locator('#totals').textContent(), /, 1 without samples;/);
  assert.equal(await page.locator('#news[role=status]').count(), 1);
  const said = page.locator('.alarm:has-text("feed_udp")').first();
  assert.equal(await said.locator('.meaning').textContent(), 'No samples arrive: the figures shown are the last ones.');
  assert.match(await said.locator('.remedy').textContent(), /^Check the valve/);
  assert.match(await said.locator('.growth').textContent(), /^For \d+ s/);
  await picture(page, 'overview_with_alarms');
  const count = Number(await page.locator('#alarm-count').textContent());
  assert.ok(count >= 2);
  await torn.getByRole('button', { name: /^Acknowledge alarm \d+: function check of clamp_torn_cable$/ }).press('Enter');
  await page.waitForFunction((was) => Number(document.querySelector('#alarm-count').textContent) === was - 1, count);
  // Who acknowledges by keyboard stays among the alarms.
  await page.waitForFunction(() => document.activeElement.closest('.alarms') !== null);
  await page.goto(`${served.url}/#/alarms`);
  await page.waitForSelector('.alarm[data-state=raised_acknowledged]:has-text("acknowledged by local")');
  await page.waitForSelector('.alarm:has-text("raw samples around it")');
  await picture(page, 'alarms');
  // The raw samples are there, and are a recording.
  const [download] = await Promise.all([page.waitForEvent('download'),
                                        page.locator('.alarm a:has-text("raw samples around it")').first().click()]);
  const csv = join(folder, 'alarm.csv');
  await download.saveAs(csv);
  assert.match(readFileSync(csv, 'utf8'), /^time_s,current_A,voltage_V,position_mm,oil_temperature_C\n/);
  assert.equal(spawnSync(command, ['estimate', '-q', 'model.json', csv, '-o', '-'], { cwd: folder, encoding: 'utf8' }).status, 0);

  // Another one is commented, and shelved for a week: it counts nowhere, and is listed apart.
  const quietAlarm = page.locator('.alarm:has-text("no samples"):has-text("feed_udp")').first();
  const open = Number(await page.locator('#alarm-count').textContent());
  await quietAlarm.locator('.desk summary').click();
  await quietAlarm.getByRole('textbox', { name: 'Comment' }).fill('the sender is on its way');
  await quietAlarm.getByRole('button', { name: 'Comment', exact: true }).click();
  await page.waitForSelector('.alarm:has-text("feed_udp") .comments li:has-text("local the sender is on its way")');
  await quietAlarm.getByRole('combobox').selectOption('168');
  await quietAlarm.getByRole('button', { name: 'Shelve' }).click();
  await page.waitForSelector('h3:has-text("Shelved") + .alarms .alarm[data-state=shelved]:has-text("shelved by local until")');
  await page.waitForFunction((was) => Number(document.querySelector('#alarm-count').textContent || '0') === was - 1, open);
  await picture(page, 'alarms_shelved');

  await ended(served.child);
  served = await start('site.toml', '--listen', `127.0.0.1:${served.port}`);
  await page.waitForSelector('.alarm[data-state=raised_acknowledged]:has-text("function check")');
  const kept = page.locator('.alarm[data-state=shelved]:has-text("the sender is on its way")');
  await kept.waitFor();
  if (!(await kept.locator('.desk').getAttribute('open') !== null)) await kept.locator('.desk summary').click();
  await kept.getByRole('button', { name: 'Take off the shelf' }).click();
  await page.waitForSelector('h2:has-text("Alarms") + .alarms .alarm[data-state=raised_unacknowledged]:has-text("the sender is on its way")');
  assert.deepEqual(complaints, []);
});

test('a valve’s plot moves 20 to 50 times a second, goes stale with the program, and comes back by itself', async () => {
  const { page } = await opened('#/valve/press_1');
  let frames = 0;
  page.on('websocket', (socket) => socket.on('framereceived', () => ++frames)); // a busy machine may close one and open another
  await page.reload();
  await page.waitForSelector('canvas.plot');
  await moves(page);
  // Each frame is the stretch of time behind the one before: 40 of them a second of the samples, at whatever pace they come here.
  const at = performance.now();
  const before = frames;
  while (frames < before + 100 && performance.now() < at + 120_000) await page.waitForTimeout(20);
  assert.ok(frames >= before + 100, `${frames - before} frames in two minutes`);
  const rate = (1000 * (frames - before)) / (performance.now() - at);
  console.log(`${rate.toFixed(1)} frames a second`);
  assert.ok(rate < 100, `${rate} frames a second`);
  await page.waitForFunction(() => document.querySelectorAll('figure.history').length >= 2);
  // Counters stand apart; what is judged has its alarm limit.
  assert.ok(await page.locator('.counters dt:has-text("strokes")').count() === 1);
  assert.ok((await page.locator('.indicators').first().locator('tbody tr').count()) <= 12);
  assert.match(await page.locator('.indicators tr:has-text("friction ratio")').first().textContent(), /> 1\.12/);
  assert.match(await page.locator('canvas.plot').getAttribute('aria-label'), /^flow rate, position and current of the last 30 seconds; status: /);
  const first = page.locator('figure.history').first();
  await first.press('+');
  const shown = Number(await first.getAttribute('data-shown'));
  await first.press('+');
  assert.ok(Math.abs(Number(await first.getAttribute('data-shown')) - shown / 2) < 0.2);
  await first.press('0');
  assert.ok(Math.abs(Number(await first.getAttribute('data-shown')) - 2 * shown) < 0.2);
  await page.waitForTimeout(1000);
  await picture(page, 'valve');

  await ended(served.child);
  await page.waitForSelector('#stale:not([hidden])');
  assert.match(await page.locator('#stale').textContent(), /has not answered for \d+ s: what is shown is old/);
  await page.waitForSelector('canvas.plot.old');
  await page.waitForFunction(() => /^The last sample came ([2-9]|\d\d+) s ago\.$/m.test(document.querySelector('main').innerText));
  assert.match(await page.locator('canvas.plot').getAttribute('aria-label'), /^flow rate, position and current of the last 30 seconds before the last sample, \d+ s ago; /);
  await picture(page, 'valve_stale');
  served = await start('site.toml', '--listen', `127.0.0.1:${served.port}`);
  await page.waitForSelector('#stale', { state: 'hidden', timeout: 20000 });
  await page.waitForSelector('canvas.plot:not(.old)');
  await moves(page);
});

test('plots show the time that is asked for, with another valve over it, and the address keeps both', async () => {
  const { page, complaints } = await opened('#/valve/press_1');
  await page.waitForFunction(() => document.querySelectorAll('figure.history').length >= 2);
  const asked = [];
  page.on('request', (request) => {
    const found = /valves\/(\w+)\/history\?from=(\d+)&to=(\d+)/.exec(request.url());
    if (found) asked.push([found[1], Number(found[2]), Number(found[3])]);
  });
  const local = (time) => new Date(time - new Date().getTimezoneOffset() * 60000).toISOString().slice(0, 19);
  // Within what is kept, so behind the start; and not at second 0, which a field for times writes without its seconds.
  const second = 1000 * Math.floor(Date.now() / 1000), to = second - (second % 60_000 === 0 ? 1000 : 0), from = to - 3000_000;
  await page.getByLabel('From', { exact: true }).fill(local(from));
  await page.getByLabel('to', { exact: true }).fill(local(to));
  await page.getByLabel('Beside it').selectOption('press_2');
  await page.waitForSelector('figure.history[aria-label^="mean flow"][aria-label$=", with press_2"]');
  for (const id of ['press_1', 'press_2']) {
    assert.ok(asked.some((one) => one[0] === id && one[1] === from / 1000 && one[2] === to / 1000), JSON.stringify(asked));
  }
  assert.match(await page.evaluate(() => location.hash), /^#\/valve\/press_1\?from=[^&]+&to=[^&]+&with=press_2$/);
  assert.deepEqual(await page.locator('.legend span').allTextContents(), ['press_1', 'press_2']);
  // The second curve is drawn in its own colour.
  await page.waitForFunction(() => {
    const canvas = document.querySelector('figure.history canvas');
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let k = 0; k < data.length; k += 4) count += data[k] > 180 && data[k + 1] < 120 && data[k + 2] < 60 && data[k + 3] > 200 ? 1 : 0;
    return count > 5;
  });
  await picture(page, 'valve_beside');
  asked.length = 0;
  await page.reload();
  await page.waitForSelector('figure.history[aria-label^="mean flow"][aria-label$=", with press_2"]');
  assert.ok(asked.some((one) => one[0] === 'press_2' && one[1] === from / 1000 && one[2] === to / 1000), JSON.stringify(asked));
  assert.equal(await page.getByLabel('From', { exact: true }).inputValue().then((text) => text.slice(0, 16)), local(from).slice(0, 16));
  // An end before the begin is refused where it is written.
  await page.getByLabel('to', { exact: true }).fill(local(from - 2000));
  await page.waitForSelector('.tools .stale:has-text("must lie before")');
  await page.getByLabel('Beside it').selectOption('none');
  await page.getByLabel('Span').selectOption('604800');
  await page.waitForFunction(() => location.hash === '#/valve/press_1?span=604800');
  assert.deepEqual(complaints, []);
});

test('a sender in wrong units, and one that no valve expects, are seen on the page', async () => {
  const lines = recording(6, 6).split('\n').map((line, k) => {
    const cells = line.split(',');
    if (k > 0 && cells.length > 3) cells[3] = String(1000 * Number(cells[3]));
    return cells.join(',');
  });
  writeFileSync(join(folder, 'micrometres.csv'), lines.join('\n'));
  writeFileSync(join(folder, 'commissioning.toml'), '[page]\nlisten = "127.0.0.1:0"\n[sources]\nudp = "127.0.0.1:0"\n' +
    ['press_1', 'press_2'].map((id) => `[[valve]]\nid = "${id}"\nmodel = "model.json"\nsource = { kind = "udp" }\n`).join(''));
  const own = await start('commissioning.toml');
  const senders = [['press_1', 'micrometres.csv'], ['press_2', 'short.csv'], ['press_3', 'short.csv']].map(([id, file]) => send(id, file, own.udp));
  const { page, complaints } = await opened('#/', { url: own.url, width: 390, height: 844 });
  const card = page.locator('.card:has-text("press_1"):has-text("its samples:")');
  await card.waitFor();
  assert.match(await card.locator('.worst').textContent(), /channel position is .* is its unit mm/);
  assert.equal(await page.locator('.card:has-text("press_2"):has-text("its samples:")').count(), 0);
  await picture(page, 'commissioning_390');
  await page.goto(`${own.url}/#/valve/press_1`);
  await page.waitForSelector('.findings li:has-text("is its unit mm")');
  await page.goto(`${own.url}/#/site`);
  await page.waitForSelector('.unknown tr:has-text("press_3"):has-text("127.0.0.1")');
  await picture(page, 'site_unknown_390');
  const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(content <= window, `${content} px of content`);
  assert.deepEqual(complaints, []);
  for (const sender of senders) await exited(sender);
  await ended(own.child);
});

test('a valve says how old its model is, what references moved it to, and how fast it drifts', async () => {
  const model = JSON.parse(readFileSync(join(folder, 'model.json'), 'utf8')), day_ms = 86400e3;
  const ago = (days) => new Date(Date.now() - days * day_ms).toISOString().replace(/\.\d+Z/, 'Z');
  model.provenance.created = ago(300);
  const look = (days, width, friction, zero_m) => ({
    tool: 'spoolflow 0.1.0', created: ago(days), adapted_from: '0'.repeat(64), files: [], corrections: [],
    reasons: [`edge width ${width}`], wear: { edge_width: width, friction_ratio: friction, position_zero_m: zero_m, flow_share: 0.01, friction_share: 0.05 },
  });
  const long = 'W'.repeat(32);  // the longest id, in one word
  model.provenance.adaptations = [look(200, 0.02, 1, 0), look(100, 0.04, 1.1, 5e-6), look(3, 0.06, 1.25, 9e-6)];
  writeFileSync(join(folder, 'moved.json'), JSON.stringify(model));
  writeFileSync(join(folder, 'moved.toml'), '[page]\nlisten = "127.0.0.1:0"\n[[valve]]\nid = "moved"\nmodel = "moved.json"\n' +
    `source = { kind = "rig" }\n[[valve]]\nid = "${long}"\nmodel = "model.json"\nsource = { kind = "rig" }\n`);
  const own = await start('moved.toml');
  const fits = async (page, what) => {
    const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(content <= window, `${what}: ${content} px of content in ${window} px`);
  };
  for (const width of [390, 1280]) {
    const { page, complaints } = await opened('#/valve/moved', { url: own.url, width, height: 844 });
    const section = page.locator('section:has(> h3:text-is("Model"))');
    await section.locator('p:has-text("references have looked at it 3 times, the last time 3 days ago")').waitFor({ timeout: 20000 });
    assert.match(await section.locator('p').textContent(), /^moved\.json, calibrated 300 days ago/);
    const rows = await section.locator('tbody tr').allTextContents();
    assert.equal(rows.length, 4);
    assert.match(rows[0], /drift in 30 days.*\+0\.\d ± \d/);
    assert.match(rows[1], /\+6\.0\+25\.0\+9\.0$/);
    await section.scrollIntoViewIfNeeded();
    await fits(page, 'the valve beside one of a long id');
    if (pictures) await section.screenshot({ path: join(pictures, `live_model_${width}.png`) });
    await page.goto(`${own.url}/#/valve/${long}`);
    await page.waitForSelector('p:has-text("references have not looked at it since")');
    await fits(page, 'the valve of a long id');
    await page.goto(`${own.url}/#/site`);
    await page.waitForSelector(`.sources td:has-text("${long}")`);
    await fits(page, 'the site');
    assert.deepEqual(complaints, []);
    await page.context().close();
  }
  await ended(own.child);
});

test('narrow and dark, nothing goes beyond the page', async () => {
  for (const [hash, name] of [['#/', 'overview'], ['#/alarms', 'alarms'], ['#/site', 'site'], ['#/valve/press_1', 'valve']]) {
    for (const [width, colorScheme] of [[390, 'dark'], [1280, 'light'], [1280, 'dark']]) {
      const { page, complaints } = await opened(hash, { width, height: 844, colorScheme });
      await page.waitForSelector({ '#/': '.card', '#/alarms': '.alarm', '#/site': '.sources td' }[hash] ?? 'figure.history',
                                 { timeout: 30000 });
      await page.waitForTimeout(1500);
      const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      assert.ok(content <= window, `${name}: ${content} px of content at ${width} px`);
      const paper = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
      assert.equal(paper === 'rgb(255, 255, 255)', colorScheme === 'light');
      assert.deepEqual(complaints, []);
      await picture(page, `${name}_${width}_${colorScheme}`);
      await page.context().close();
    }
  }
});

// At a program of its own: that of the others may have been restarted since the end, and then knows no figures.
test('a recording that has ended leaves old figures, and its card says so', async () => {
  writeFileSync(join(folder, 'ended.toml'), '[page]\nlisten = "127.0.0.1:0"\n[[valve]]\nid = "clamp"\nmodel = "model.json"\n' +
    'source = { kind = "replay", recording = "short.csv" }\n');
  const own = await start('ended.toml');
  const { page } = await opened('#/', { url: own.url });
  const card = page.locator('.card:has-text("clamp"):has-text("no samples for")');
  await card.waitFor();
  assert.match(await card.locator('.flow').textContent(), /^last /);
  await ended(own.child);
});

test('the keyboard goes from card to card, into a valve and back', async () => {
  const { page } = await opened();
  await page.waitForFunction(() => document.querySelectorAll('.card').length === 4);
  await page.locator('label:has-text("problems first") input').uncheck();  // places stay
  await page.locator('.card').first().focus();
  const focused = () => page.evaluate(() => document.activeElement.querySelector('.name')?.textContent);
  const names = await page.locator('.card .name').allTextContents();
  await page.keyboard.press('ArrowRight');
  assert.equal(await focused(), names[1]);
  await page.keyboard.press('End');
  assert.equal(await focused(), names[3]);
  await page.keyboard.press('Home');
  await page.waitForTimeout(1200);  // a second's figures do not take the focus away
  assert.equal(await focused(), names[0]);
  await page.keyboard.press('Enter');
  await page.waitForSelector('canvas.plot');
  assert.equal(await page.title(), `${names[0]} – spoolflow live`);
  await page.keyboard.press('Escape');
  await page.waitForSelector('.card');
  for (const [role, name] of [['link', /^Alarms/], ['link', 'Site'], ['region', 'valves']]) {
    assert.equal(await page.getByRole(role, { name }).count(), 1, `${role} ${name}`);
  }
});

test('with accounts strangers see a form, and a password opens the page', async () => {
  const made = spawnSync('openssl', ['req', '-x509', '-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes',
                                     '-keyout', 'key.pem', '-out', 'certificate.pem', '-days', '2', '-subj', '/CN=localhost'],
                         { cwd: folder });
  assert.equal(made.status, 0);
  const account = spawnSync(command, ['account', 'anna', '--role', 'acknowledge'],
                            { input: 'correct horse battery\n', encoding: 'utf8' });
  writeFileSync(join(folder, 'closed.toml'), `[page]\nlisten = "127.0.0.1:0"\ncertificate = "certificate.pem"\nkey = "key.pem"\n` +
    `${account.stdout}[[valve]]\nid = "press_1"\nmodel = "model.json"\nsource = { kind = "rig", seed = 7 }\n`);
  const closed = await start('closed.toml');
  assert.ok(closed.url.startsWith('https://'));
  const { page, complaints } = await opened('#/valve/press_1', { url: closed.url, own: ['401'] });
  await page.waitForSelector('form.login');
  assert.equal(await page.locator('.card, canvas').count(), 0);
  await picture(page, 'login');
  await page.fill('input[name=name]', 'anna');
  await page.fill('input[name=password]', 'a wrong password');
  await page.keyboard.press('Enter');
  await page.waitForSelector('form.login .stale:has-text("name or password is wrong")');
  await page.fill('input[name=password]', 'correct horse battery');
  await page.getByRole('button', { name: 'Log in' }).click();
  await page.waitForSelector('canvas.plot');
  await moves(page);
  assert.match(await page.locator('.account').textContent(), /^anna \(acknowledges\)/);
  await page.getByRole('button', { name: 'Log out' }).click();
  await page.waitForSelector('form.login');
  await page.reload();
  await page.waitForSelector('form.login');
  assert.deepEqual(complaints, []);
  await ended(closed.child);
});
