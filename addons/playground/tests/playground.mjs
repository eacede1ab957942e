// The page that works in a browser alone, opened from a file, in a real browser.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { file, idle, opened as openedIn, started, wide } from './playground_page.mjs';

const command = process.env.SPOOLFLOW_COMMAND, examples = process.env.SPOOLFLOW_EXAMPLES;
const pictures = process.env.SPOOLFLOW_PICTURES, recordings = process.env.SPOOLFLOW_RECORDINGS;
const folder = mkdtempSync(join(tmpdir(), 'spoolflow-playground-'));
const model = join(examples, 'live', 'size_6.json');
let browser;

const opened = (look) => openedIn(browser, look);

before(async () => {
  browser = await started();
  if (pictures) mkdirSync(pictures, { recursive: true });
  writeFileSync(join(folder, 'run.toml'), 'protocol = "steps"\nvalve = "size_6"\n[run]\nhold_s = 0.4\n');
  const made = spawnSync(command, ['simulate', '-q', join(folder, 'run.toml'), '-o', join(folder, 'run.csv')]);
  assert.equal(made.status, 0, String(made.stderr));
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

const picture = async (page, name) => {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`), fullPage: true });
};
const give = async (page, ...files) => {
  await page.setInputFiles('input[name=files]', files);
  await page.waitForSelector(`.file[aria-current]`);
  await idle(page);
};

test('the page weighs less than 3 MB and forbids every connection', async () => {
  assert.ok(statSync(file).size < 3_000_000, `${statSync(file).size} bytes`);
  const { page } = await opened();
  const refused = await page.evaluate(async () => {
    try {
      await fetch('https://example.org/');
      return false;
    } catch {
      return true;
    }
  });
  assert.ok(refused);
  assert.match(await page.textContent('.private'), /Nothing leaves this machine/);
  console.log(`${statSync(file).size} bytes; ready after ${await page.evaluate(() => document.documentElement.dataset.ready)} ms`);
  await page.context().close();
});

test('the sensor follows the virtual valve, and a valve that is shut passes no oil', async () => {
  for (const [width, colorScheme] of [[1280, 'light'], [390, 'light'], [1280, 'dark']]) {
    const { page, complaints } = await opened({ width, colorScheme });
    await page.waitForFunction(() => Number(document.querySelector('.valve').dataset.worked) > 4);
    await picture(page, `valve_${width}_${colorScheme}`);
    assert.ok(await wide(page) <= 0);
    const set = (name, value) => page.locator(`input[name=${name}]`).fill(String(value));
    await set('command_percent', 80);
    assert.ok(!(await page.isChecked('input[name=moves]')), 'a hand at the slider takes over');
    const settled = async (after_s) => {
      const from = await page.evaluate(() => Number(document.querySelector('.valve').dataset.worked));
      await page.waitForFunction((until) => Number(document.querySelector('.valve').dataset.worked) > until, from + after_s);
      return page.evaluate(() => ({ flow: Number(document.querySelector('.valve').dataset.flow), truth: Number(document.querySelector('.valve').dataset.truth) }));
    };
    const open = await settled(1.5);
    assert.ok(open.truth > 30 && Math.abs(open.flow - open.truth) < 10, JSON.stringify(open));
    await set('command_percent', 0);
    const shut = await settled(1.5);
    assert.ok(shut.truth < 2 && shut.flow < 3, JSON.stringify(shut));
    assert.deepEqual(complaints, []);
    await page.context().close();
  }
});

test('a recording is inspected, estimated and judged as by the command', async () => {
  for (const [width, colorScheme] of [[1280, 'light'], [390, 'dark']]) {
    const { page, complaints } = await opened({ width, colorScheme, hash: '#files' });
    await give(page, join(folder, 'run.csv'));
    assert.match(await page.textContent('.said'), /run\.csv: CSV/);
    await picture(page, `inspect_${width}`);
    await page.getByRole('button', { name: 'Estimate' }).click();
    await page.waitForSelector('iframe.report', { timeout: 60000 });
    await idle(page);
    assert.match(await page.textContent('.sentence'), /samples/);
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: /Save run_estimate/ }).click()]);
    const native = join(folder, 'native.csv');
    assert.equal(spawnSync(command, ['estimate', '-q', model, join(folder, 'run.csv'), '-o', native]).status, 0);
    const numbers = (text) => text.trim().split('\n').slice(1).map((line) => line.split(','));
    const here = numbers(readFileSync(await download.path(), 'utf8')), there = numbers(readFileSync(native, 'utf8'));
    assert.equal(here.length, there.length);
    here.forEach((row, k) => {
      assert.ok(Math.abs(row[1] - there[k][1]) < 1e-4, `row ${k}: ${row[1]}, ${there[k][1]}`);
      assert.equal(row[8], there[k][8]);
    });
    await page.getByRole('button', { name: 'Compare with the reference flow' }).click();
    await page.waitForSelector('text=Save the report (HTML)', { timeout: 60000 });
    await idle(page);
    const frame = page.frameLocator('iframe.report');
    await frame.locator('h1').waitFor({ timeout: 30000 });
    await frame.locator('figure.run-plots').first().scrollIntoViewIfNeeded();
    await frame.locator('figure.run-plots.is-live').first().waitFor({ timeout: 30000 });
    await picture(page, `validate_${width}`);
    assert.ok(await wide(page) <= 0);
    assert.deepEqual(complaints.filter((each) => !/sandbox/.test(each)), []);
    await page.context().close();
  }
});

test('a foreign file is read by a map that is corrected by hand; what cannot be read is reported in the program’s words', async () => {
  const { page } = await opened({ hash: '#files' });
  const [header, ...rows] = readFileSync(join(folder, 'run.csv'), 'utf8').split('\n');
  writeFileSync(join(folder, 'foreign.csv'), [header.replace('current_A', 'Kanal 3'), ...rows].join('\n'));
  await give(page, join(folder, 'foreign.csv'));
  const text = page.locator('.map textarea');
  if (!(await page.locator('.map').evaluate((each) => each.open))) await page.click('.map > summary');
  await page.click('.as-text > summary');
  await text.fill('[channels]\ntime = { column = "time_s", unit = "s" }\ncurrent = { column = "Kanal 9", unit = "A" }\n');
  await page.getByRole('button', { name: 'Read the recording' }).click();
  await page.waitForFunction(() => document.querySelector('.files .fault').textContent !== '');
  assert.match(await page.textContent('.files .fault'), /Kanal 9/);
  await text.fill('[channels]\ntime = { column = "time_s", unit = "s" }\ncurrent = { column = "Kanal 3", unit = "A" }\n'
    + 'position = { column = "position_mm", unit = "mm" }\n');
  await page.getByRole('button', { name: 'Read the recording' }).click();
  await idle(page);
  assert.equal(await page.textContent('.files .fault'), '');
  assert.match(await page.textContent('.said'), /current +A/);
  writeFileSync(join(folder, 'broken.csv'), 'time_s,current_A,position_mm\n0,1,2\n0.001,one,2\n');
  await page.setInputFiles('input[name=files]', [join(folder, 'broken.csv')]);
  await page.waitForFunction(() => document.querySelector('.files .fault').textContent !== '' || /broken/.test(document.querySelector('.said')?.textContent ?? ''));
  await page.context().close();
});

test('a channel map is mended in a table, which writes the text', async () => {
  for (const width of [1280, 390]) {
    const { page, complaints } = await opened({ width, hash: '#files' });
    const [header, ...rows] = readFileSync(join(folder, 'run.csv'), 'utf8').split('\n');
    writeFileSync(join(folder, 'foreign.csv'), [header.replace('current_A', 'Kanal 3').replace('position_mm', 'Weg'), ...rows].join('\n'));
    await give(page, join(folder, 'foreign.csv'));
    if (!(await page.locator('.map').evaluate((each) => each.open))) await page.click('.map > summary');
    await page.getByLabel('column of current').selectOption('Kanal 3');
    await page.getByLabel('unit of current').fill('mA');
    await page.getByLabel('scale of current').fill('one thousand');
    assert.equal(await page.getByLabel('scale of current').getAttribute('aria-invalid'), 'true');
    await page.getByLabel('scale of current').fill('1000');
    await page.getByLabel('column of position', { exact: true }).selectOption('Weg');
    await page.getByLabel('unit of position', { exact: true }).fill('mm');
    const text = await page.inputValue('.map textarea');
    assert.match(text, /^current = \{ column = "Kanal 3", unit = "mA", scale = 1000 \}$/m);
    assert.match(text, /^position = \{ column = "Weg", unit = "mm" \}$/m);
    await picture(page, `map_${width}`);
    await page.getByRole('button', { name: 'Read the recording' }).click();
    await idle(page);
    assert.equal(await page.textContent('.files .fault'), '');
    assert.match(await page.textContent('.said'), /current +A/);
    assert.equal(await page.getByLabel('scale of current').inputValue(), '1000', 'the table is that of the map that was read');
    assert.ok(await wide(page) <= 0);
    assert.deepEqual(complaints, []);
    await page.context().close();
  }
});

/** Drops files and folders as a hand does: the browser itself opens them. */
async function drop(page, ...files) {
  const box = await page.locator('.drop').boundingBox();
  const mouse = await page.context().newCDPSession(page);
  const event = (type) => mouse.send('Input.dispatchDragEvent',
    { type, x: box.x + box.width / 2, y: box.y + 8, data: { items: [], files, dragOperationsMask: 1 } });
  await event('dragEnter');
  await event('dragOver');
  await page.waitForSelector('.drop.over');
  await event('drop');
  await page.waitForSelector('.drop:not(.over)');
  await mouse.detach();
}

test('files and folders that are dropped are taken, and other files are reported', async () => {
  const { page, complaints } = await opened({ hash: '#files' });
  writeFileSync(join(folder, 'holiday.png'), 'no recording');
  await drop(page, join(folder, 'holiday.png'));
  await page.waitForFunction(() => document.querySelector('.files .fault').textContent !== '');
  assert.match(await page.textContent('.files .fault'), /none of these is a recording/);
  mkdirSync(join(folder, 'monday', 'hall_3'), { recursive: true });
  for (const name of ['monday/run.csv', 'monday/hall_3/run.csv']) writeFileSync(join(folder, name), readFileSync(join(folder, 'run.csv')));
  await drop(page, join(folder, 'monday'), model);
  await page.waitForSelector('.said');
  await idle(page);
  assert.equal(await page.textContent('.files .fault'), '');
  assert.match(await page.textContent('.said'), /run\.csv: CSV/);
  assert.equal(await page.inputValue('select[name=model]'), 'size_6.json');
  assert.deepEqual(await page.locator('.file').allTextContents(), ['size_6.json', 'monday/hall_3/run.csv', 'monday/run.csv']);
  await page.getByRole('button', { name: 'monday/run.csv' }).click();
  await idle(page);
  await page.getByRole('button', { name: 'Estimate' }).click();
  await page.waitForSelector('.sentence', { timeout: 60000 });
  await idle(page);
  assert.deepEqual(complaints.filter((each) => !/sandbox/.test(each)), []);
  await page.context().close();
});

test('a campaign becomes a model while the page stays alive', { skip: recordings === undefined }, async () => {
  const { page, complaints } = await opened({ hash: '#files' });
  await page.setInputFiles('input[name=folder]', recordings);
  await page.getByRole('button', { name: 'Make the valve’s model' }).waitFor({ timeout: 120000 });
  await idle(page, 120000);
  const begun = Date.now();
  await page.getByRole('button', { name: 'Make the valve’s model' }).click();
  await page.waitForFunction(() => document.querySelector('progress').value > 0.05, undefined, { timeout: 120000 });
  await picture(page, 'calibrating');
  await page.waitForSelector('table.summary', { timeout: 600000 });
  await idle(page);
  console.log(`calibrated in ${((Date.now() - begun) / 1000).toFixed(1)} s`);
  await picture(page, 'calibrated');
  assert.equal(await page.textContent('.files .fault'), '');
  assert.deepEqual(complaints.filter((each) => !/sandbox/.test(each)), []);
  await page.context().close();
});
