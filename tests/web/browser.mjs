// Reports in a real browser.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { chromium } from 'playwright-core';
import { channels, gap, spikeAt } from './recordings.mjs';

const folder = process.env.SPOOLFLOW_REPORTS;
const pictures = process.env.SPOOLFLOW_PICTURES;
const all = ['usual', 'unmeasured', 'gaps', 'single', 'million'];
let browser;

before(async () => {
  browser = await chromium.launch({
    executablePath: process.env.SPOOLFLOW_BROWSER,
    args: ['--no-sandbox', '--disable-background-networking', '--disable-gpu', '--disable-dev-shm-usage'],
  });
  if (pictures) mkdirSync(pictures, { recursive: true });
});
after(() => browser?.close());

const pages = new Map();

/** A page for each way of looking, used again and again: a new one would cost half a second. */
async function pageFor(javaScriptEnabled, colorScheme) {
  const key = `${javaScriptEnabled} ${colorScheme}`;
  if (!pages.has(key)) pages.set(key, await (await browser.newContext({ javaScriptEnabled, colorScheme })).newPage());
  return pages.get(key);
}

/** Opens a report; whatever the page asks for besides itself, and whatever its console says, is collected. */
async function opened(name, { width = 1280, javaScriptEnabled = true, colorScheme = 'light' } = {}) {
  const page = await pageFor(javaScriptEnabled, colorScheme);
  const complaints = [];
  page.removeAllListeners();
  page.on('console', (message) => complaints.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`error: ${error.message}`));
  page.on('request', (request) => {
    if (!request.url().startsWith(`file://${folder}/`)) complaints.push(`asked for ${request.url()}`);
  });
  await page.setViewportSize({ width, height: 900 });
  await page.emulateMedia({ media: 'screen', colorScheme });
  await page.mouse.move(0, 0);  // where a plot that is scrolled to does not come to lie under it
  await page.goto(`file://${join(folder, name)}.html`);
  if (javaScriptEnabled) await page.evaluate(() => localStorage.clear());
  return { page, complaints };
}

/** What the page shows as text, scripts and style sheets left out. */
const textOf = (page) => page.evaluate(() => {
  const walk = document.createTreeWalker(document.querySelector('main'), NodeFilter.SHOW_TEXT);
  let text = '';
  while (walk.nextNode()) {
    if (!walk.currentNode.parentElement.closest('script, style, header')) text += walk.currentNode.textContent + '\n';
  }
  return text;
});

/** By how many pixels tables go beyond the page, where they do. */
const tablesBeyond = (page) => page.evaluate(() => [...document.querySelectorAll('.scroll')]
  .map((room) => room.querySelector('table').scrollWidth - room.clientWidth).filter((beyond) => beyond > 0));

/** The first run's plots, brought to life. */
async function plots(page) {
  const figure = page.locator('figure.run-plots').first();
  await figure.scrollIntoViewIfNeeded();
  await page.waitForSelector('figure.is-live');
  return figure;
}

const range = (figure) => figure.evaluate((each) => [Number(each.dataset.from), Number(each.dataset.to)]);

/** Puts the mouse on the plot of the flow at a time. */
async function pointAt(page, figure, time_s) {
  const [from, to] = await range(figure);
  const plot = figure.locator('.u-over').first();
  await plot.scrollIntoViewIfNeeded();
  const box = await plot.boundingBox();
  await page.mouse.move(box.x + ((time_s - from) / (to - from)) * box.width, box.y + 40);
}

async function readOut(figure) {
  return figure.evaluate((each) => ({
    time_s: Number(each.querySelector('.clock').textContent.replace(/[^0-9.]/g, '')),
    values: [...each.querySelectorAll('.readout')].map((row) => ({
      title: row.querySelector('b').textContent,
      series: Object.fromEntries([...row.querySelectorAll('output[data-series]')].map((out) => [out.dataset.series, out.textContent])),
    })),
  }));
}

/// Waits until the cursor reads that time [s], or one that `wanted` takes; a page draws with its next frame.
async function readsAt(figure, wanted) {
  const there = typeof wanted === 'function' ? wanted : (time_s) => Math.abs(time_s - wanted) < 1e-9;
  let now = await readOut(figure);
  for (let tries = 0; !there(now.time_s) && tries < 100; ++tries) {
    await figure.page().waitForTimeout(20);
    now = await readOut(figure);
  }
  assert.ok(there(now.time_s), `the cursor reads ${now.time_s} s, not ${wanted}`);
  return now.time_s;
}

function rowsOf(file) {
  const [head, ...lines] = readFileSync(join(folder, file), 'utf8').trim().split('\n');
  const names = head.split(',');
  return lines.map((line) => Object.fromEntries(line.split(',').map((value, k) => [names[k], value])));
}

async function picture(page, name) {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`), fullPage: true });
}

for (const name of all) {
  test(`${name}: opens without network, console or overflow, wide and narrow`, async () => {
    for (const width of [1280, 390]) {
      const { page, complaints } = await opened(name, { width, colorScheme: width === 390 ? 'dark' : 'light' });
      await plots(page);
      await page.waitForTimeout(50);
      assert.deepEqual(complaints, []);
      const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      assert.ok(content <= window, `${content} px of content at ${width} px`);
      await picture(page, `${name}_${width}`);
    }
  });
}

test('the page about an analysis: no network, console or overflow, wide and narrow, and every figure in print', async () => {
  for (const width of [1280, 390]) {
    const { page, complaints } = await opened('analysis', { width, colorScheme: width === 390 ? 'dark' : 'light' });
    assert.deepEqual(complaints, []);
    const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(content <= window, `${content} px of content at ${width} px`);
    await picture(page, `analysis_${width}`);
    const cut = await page.evaluate(() => [...document.querySelectorAll('figure svg text')].filter((text) => {
      const [inner, outer] = [text.getBoundingClientRect(), text.ownerSVGElement.getBoundingClientRect()];
      return inner.width > 0 && (inner.left < outer.left - 1 || inner.right > outer.right + 1);
    }).map((text) => text.textContent));
    assert.deepEqual(cut, [], `cut off at ${width} px`);
  }
  const { page } = await opened('analysis', { colorScheme: 'dark' });
  await page.emulateMedia({ media: 'print' });
  const drawings = await page.evaluate(() => [...document.querySelectorAll('figure')].map((figure) =>
    [...figure.querySelectorAll('svg[role=img]')].filter((svg) => svg.getBoundingClientRect().height > 40).length));
  assert.ok(drawings.length >= 12, `${drawings.length} figures`);
  assert.ok(drawings.every((count) => count === 1), `drawings a figure: ${drawings}`);
  assert.match(await page.textContent('main'), /stated/);
  const pdf = await page.pdf({ format: 'A4', ...(pictures ? { path: join(pictures, 'analysis.pdf') } : {}) });
  assert.ok(pdf.length > 50_000);
});

test('a page made in other units has no other anywhere, and its plots begin in them', async () => {
  for (const name of ['american', 'imperial']) {
    const { page, complaints } = await opened(name);
    const text = await textOf(page);
    assert.deepEqual(complaints, []);
    // "a pale status bar" is none
    assert.doesNotMatch(text, /\[(bar|L\/min|mm|°C|N)\b|[0-9] (bar|L\/min|mm|°C|N)(?![²/\w])/);
    assert.match(text, /psi/);
    assert.match(text, /gal\/min/);
    assert.deepEqual(await tablesBeyond(page), [], 'tables wider than the page');
    await page.setViewportSize({ width: 718, height: 900 });  // A4 less its margins
    await page.emulateMedia({ media: 'print' });
    assert.deepEqual(await tablesBeyond(page), [], 'tables wider than the paper');
    await page.emulateMedia({ media: 'screen' });
    await page.setViewportSize({ width: 1280, height: 900 });
    await picture(page, name);
  }
  const { page } = await opened('imperial');
  const shown = await readOut(await plots(page));
  assert.equal(shown.values[0].title, 'Flow rate [gal/min (US)]');
  assert.equal(await page.locator('select[name=pressure]').inputValue(), 'psi');
});

test('a run keeps its name in other units', async () => {
  const { page } = await opened('named');
  const text = await textOf(page);
  assert.match(text, /Run ramp at 60 bar\n/);
  assert.doesNotMatch(text.replaceAll('ramp at 60 bar', ''), /(\[|[0-9] )bar\b/);
  assert.doesNotMatch(text, /ramp at 870/);
});

test('dragging zooms all plots of the run, a double click shows the whole run again', async () => {
  const { page } = await opened('usual');
  const figure = await plots(page);
  const whole = await range(figure);
  const plot = figure.locator('.u-over').nth(1);
  await plot.scrollIntoViewIfNeeded();
  const box = await plot.boundingBox();
  await page.mouse.move(box.x + 0.25 * box.width, box.y + 20);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 30, { steps: 4 });
  await page.mouse.up();
  const [from, to] = await range(figure);
  assert.ok(Math.abs(from - 0.25 * whole[1]) < 0.1 && Math.abs(to - 0.5 * whole[1]) < 0.1, `${from} to ${to}`);
  await page.mouse.dblclick(box.x + 0.5 * box.width, box.y + 30);
  assert.deepEqual(await range(figure), whole);
});

test('the values at the cursor are those of the recording and of the estimate', async () => {
  const { page } = await opened('usual');
  const figure = await plots(page);
  const recorded = rowsOf('usual.csv');
  const estimated = rowsOf('usual_estimate.csv');
  for (const time_s of [1.5, 6.25, 12.75, 19]) {
    await pointAt(page, figure, time_s);
    const shown = await readOut(figure);
    assert.ok(Math.abs(shown.time_s - time_s) < 0.02);
    const k = Math.round(shown.time_s * 1000);
    const of = (panel, series) => Number(shown.values[panel].series[series].replace('−', '-'));
    const near = (value, expected, margin, what) =>
      assert.ok(Math.abs(value - Number(expected)) <= margin, `${what} at ${shown.time_s} s: ${value}, in the file ${expected}`);
    near(of(0, 'measured'), recorded[k].flow_reference_L_min, 0.007, 'measured flow');
    near(of(0, 'observer'), estimated[k].flow_L_min, 0.007, 'estimated flow');
    const [low, high] = shown.values[0].series['95 % band'].split(' to ').map((text) => Number(text.replace('−', '-')));
    near(low, estimated[k].flow_lower_L_min, 0.007, 'lower edge');
    near(high, estimated[k].flow_upper_L_min, 0.007, 'upper edge');
    near(of(1, 'observer'), (100 * (estimated[k].flow_L_min - recorded[k].flow_reference_L_min)) / 80, 0.01, 'error');
    near(of(2, 'measured'), recorded[k].pressure_difference_bar, 0.06, 'pressure difference');
    near(of(3, 'measured'), recorded[k].position_mm, 0.0006, 'position');
    near(of(4, 'magnetic'), estimated[k].magnetic_force_N, 0.01, 'magnetic force');
    near(of(4, 'friction'), estimated[k].friction_force_N, 0.01, 'friction');
    const said = await figure.locator('.status-now').textContent();
    assert.equal(said.split(', ').sort().join('|').replace('none', ''), estimated[k].status.split('|').sort().join('|'));
  }
});

test('the reader chooses the units', async () => {
  const { page } = await opened('usual');
  const figure = await plots(page);
  await pointAt(page, figure, 6.25);
  const before = await readOut(figure);
  await page.selectOption('select[name=flow]', 'm³/h');
  await page.selectOption('select[name=error]', 'as flow');
  await page.selectOption('select[name=pressure]', 'psi');
  await pointAt(page, figure, 6.2501);
  const now = await readOut(figure);
  assert.equal(now.values[0].title, 'Flow rate [m³/h]');
  assert.equal(now.values[1].title, 'Error, estimated less measured [m³/h]');
  assert.ok(Math.abs(now.values[0].series.measured - 0.06 * before.values[0].series.measured) < 0.002);
  assert.ok(Math.abs(now.values[2].series.measured - 14.5038 * before.values[2].series.measured) < 1.5);
});

test('the keyboard moves the cursor by samples, zooms, and a screen reader announces it', async () => {
  const { page } = await opened('usual');
  const figure = await plots(page);
  const whole = await range(figure);
  const area = figure.locator('.plots');
  assert.match(await area.getAttribute('aria-label'), /arrow/);
  await area.focus();
  for (let k = 0; k < 6; ++k) await page.keyboard.press('+');
  const [from, to] = await range(figure);
  assert.ok(Math.abs((to - from) - (whole[1] - whole[0]) / 64) < 1e-6);
  await page.keyboard.press('ArrowRight');
  const first = await readsAt(figure, (time_s) => time_s > 0);
  await page.keyboard.press('ArrowRight');
  await readsAt(figure, first + 0.001);
  await page.keyboard.press('Shift+ArrowLeft');
  await readsAt(figure, first - 0.009);
  await page.waitForFunction(() => document.querySelector('.unseen').textContent.includes('measured'));
  assert.match(await figure.locator('.unseen').textContent(), /L\/min.*bar.*mm.*status/);
  await page.keyboard.press('End');
  await readsAt(figure, (time_s) => time_s === 19.999);
  await page.keyboard.press('0');
  assert.deepEqual(await range(figure), whole);
});

test('print shows every figure, none of the plots that zoom, on white', async () => {
  const { page } = await opened('usual', { colorScheme: 'dark' });
  await plots(page);
  await page.selectOption('select.theme', 'dark');
  await page.emulateMedia({ media: 'print' });
  const seen = await page.evaluate(() => ({
    figures: [...document.querySelectorAll('figure')].map((figure) =>
      [...figure.querySelectorAll('svg[role=img]')].filter((svg) => svg.getBoundingClientRect().height > 40).length),
    live: [...document.querySelectorAll('.live, .controls')].filter((each) => each.getBoundingClientRect().height > 0).length,
    paper: getComputedStyle(document.body).backgroundColor,
  }));
  assert.ok(seen.figures.length >= 8);
  assert.ok(seen.figures.every((drawings) => drawings === 1), `drawings a figure: ${seen.figures}`);
  assert.equal(seen.live, 0);
  assert.equal(seen.paper, 'rgb(255, 255, 255)');
  const pdf = await page.pdf({ format: 'A4', ...(pictures ? { path: join(pictures, 'usual.pdf') } : {}) });
  assert.ok(pdf.length > 50_000);
});

test('light and dark follow the system until the reader chooses', async () => {
  const { page } = await opened('usual', { colorScheme: 'dark' });
  const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const dark = await paper();
  await page.selectOption('select.theme', 'light');
  assert.equal(await paper(), 'rgb(255, 255, 255)');
  await page.selectOption('select.theme', 'system');
  assert.equal(await paper(), dark);
  assert.notEqual(dark, 'rgb(255, 255, 255)');
});

test('without JavaScript every figure stands', async () => {
  const { page } = await opened('usual', { javaScriptEnabled: false });
  const drawings = page.locator('figure svg[role=img]:visible');
  assert.ok((await drawings.count()) >= 8);
  assert.equal(await drawings.count(), await page.locator('figure').count());
  for (const drawing of await drawings.all()) assert.ok((await drawing.boundingBox()).height > 40);
});

test('a name hides and shows its line', async () => {
  const { page } = await opened('usual');
  const figure = await plots(page);
  const chip = figure.getByRole('button', { name: /condensed/ }).first();
  const drawing = () => figure.locator('canvas').first().evaluate((canvas) => canvas.toDataURL());
  const shown = await drawing();
  await chip.click();
  await page.waitForTimeout(30);
  assert.equal(await chip.getAttribute('aria-pressed'), 'false');
  assert.notEqual(await drawing(), shown);
});

test('a run without reference says so and has no plot of errors', async () => {
  const { page } = await opened('unmeasured');
  const figure = await plots(page);
  const titles = await figure.locator('.readout b').allTextContents();
  assert.ok(!titles.some((title) => title.startsWith('Error')));
  assert.match(await page.textContent('main'), /no reference flow/);
});

test('limits are judged, and another validation stands beside this one', async () => {
  const { page } = await opened('gaps');
  const badges = await page.locator('td .badge').allTextContents();
  assert.deepEqual(badges, ['fail', 'pass']);
  assert.match(await page.textContent('main'), /Side by side[^]*usual\.json/);
});

test('in a gap the readout says that nothing is known', async () => {
  const { page } = await opened('gaps');
  const figure = await plots(page);
  await pointAt(page, figure, (gap.from + gap.to) / 2000);
  const shown = await readOut(figure);
  assert.equal(shown.values[0].series.measured, '–');
  await pointAt(page, figure, gap.to / 1000 + 0.5);
  assert.notEqual((await readOut(figure)).values[0].series.measured, '–');
});

test('one sample has its values', async () => {
  const { page } = await opened('single');
  const figure = await plots(page);
  await figure.locator('.plots').focus();
  await page.keyboard.press('Home');
  assert.equal((await readOut(figure)).values[3].series.measured, Number(channels(0).position_mm).toFixed(3));
});

test('a million samples weigh less than 15 MiB, and a peak of one sample is there', async () => {
  const bytes = statSync(join(folder, 'million.html')).size;
  assert.ok(bytes < 15 * 2 ** 20, `${bytes} bytes`);
  const { page } = await opened('million');
  const figure = await plots(page);
  const spent = await page.evaluate(() => performance.getEntriesByType('measure').reduce((sum, each) => sum + each.duration, 0));
  await figure.locator('.plots').focus();
  for (let k = 0; k < 11; ++k) {
    await pointAt(page, figure, spikeAt / 1000);
    await page.keyboard.press('+');
  }
  // The peak's stretch of samples lies at the cursor or, where the pixel lies before its begin, right of it.
  await pointAt(page, figure, spikeAt / 1000);
  const around = [await readOut(figure)];
  await page.keyboard.press('ArrowRight');
  around.push(await readOut(figure));
  assert.match(around.map((each) => each.values[0].series.measured).join(), /to 66\.50/);
  const zooming = await page.evaluate(async () => {
    const buttons = document.querySelectorAll('.tools .tool');
    const begin = performance.now();
    for (let k = 0; k < 10; ++k) buttons[k % 2].click();
    await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
    return (performance.now() - begin) / 10;
  });
  console.log(`million samples: ${(bytes / 2 ** 20).toFixed(1)} MiB, ${spent.toFixed(0)} ms of script to open, ${zooming.toFixed(0)} ms a zoom`);
});

/** Marks of axes whose number does not lie where their text says: neighbours must be evenly apart where their texts are. */
const unevenMarks = (page) => page.evaluate(() => {
  const uneven = [];
  const numberOf = (text) => Number(text.replace('\u2212', '-'));
  for (const drawing of document.querySelectorAll('figure svg[role=img]')) {
    for (const [anchor, place] of [['middle', 'x'], ['end', 'y']]) {
      const axes = new Map();  // by panel: marks between two titles, and on one line
      for (const mark of drawing.querySelectorAll(`text.tick[text-anchor=${anchor}]`)) {
        const key = place === 'x' ? mark.getAttribute('y') : [...drawing.querySelectorAll('text.title')]
          .filter((title) => Number(title.getAttribute('y')) < Number(mark.getAttribute('y'))).length;
        if (!axes.has(key)) axes.set(key, []);
        axes.get(key).push([numberOf(mark.textContent), Number(mark.getAttribute(place))]);
      }
      for (const marks of axes.values()) {
        const [first, last] = [marks[0], marks[marks.length - 1]];
        if (marks.length < 3 || drawing.getAttribute('aria-label').startsWith('Frequency response')) continue;
        for (const [value, at] of marks) {
          const expected = first[1] + (last[1] - first[1]) * (value - first[0]) / (last[0] - first[0]);
          if (Math.abs(expected - at) > 0.3) uneven.push(`${drawing.getAttribute('aria-label')}: ${value} at ${at}, not ${expected}`);
        }
      }
    }
  }
  return uneven;
});

test('every number beside an axis stands on its grid line', async () => {
  for (const name of ['usual', 'analysis', 'american', 'imperial', 'named']) {
    const { page } = await opened(name, { javaScriptEnabled: false });
    assert.ok((await page.locator('text.tick').count()) > 50);
    assert.deepEqual(await unevenMarks(page), [], name);
  }
});

test('dragging up or down zooms the values of one plot, its buttons do too, and a double click shows all', async () => {
  const { page } = await opened('usual');
  const figure = await plots(page);
  const whole = await range(figure);
  const plot = figure.locator('.u-over').first();
  const drawing = (k) => figure.locator('canvas').nth(k).evaluate((canvas) => canvas.toDataURL());
  await plot.scrollIntoViewIfNeeded();
  const [first, second] = [await drawing(0), await drawing(1)];
  const box = await plot.boundingBox();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 40);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.5 * box.width + 5, box.y + 160, { steps: 4 });
  await page.mouse.up();
  await page.mouse.move(0, 0);
  assert.deepEqual(await range(figure), whole);
  assert.notEqual(await drawing(0), first);
  assert.equal(await drawing(1), second);
  await page.mouse.dblclick(box.x + 0.5 * box.width, box.y + 100);
  await page.mouse.move(0, 0);
  await page.waitForTimeout(30);
  assert.equal(await drawing(0), first);
  await page.getByRole('button', { name: 'Zoom into the values of: Flow rate' }).first().press('Enter');
  await page.waitForTimeout(30);
  assert.notEqual(await drawing(0), first);
  await figure.locator('.plots').press('0');
  await page.waitForTimeout(30);
  assert.equal(await drawing(0), first);
});

test('two cursors show the time between them and the difference of every trace', async () => {
  const { page } = await opened('usual');
  const figure = await plots(page);
  const recorded = rowsOf('usual.csv');
  const plot = figure.locator('.u-over').first();
  await plot.scrollIntoViewIfNeeded();
  for (const time_s of [2, 7]) {
    await pointAt(page, figure, time_s);
    await page.mouse.down();
    await page.mouse.up();
    await page.waitForTimeout(20);
  }
  await page.mouse.move(0, 0);
  const said = await figure.locator('.clock').textContent();
  const [from, to] = said.match(/t = ([0-9.]+) s, Δt = ([0-9.]+) s/).slice(1).map(Number);
  assert.ok(Math.abs(from - 7) < 0.02 && Math.abs(to - 5) < 0.04, `${from}, ${to}`);
  const shown = await figure.locator('output[data-difference=measured]').first().textContent();
  const k = Math.round(from * 1000);
  const expected = recorded[k].flow_reference_L_min - recorded[k - Math.round(to * 1000)].flow_reference_L_min;
  assert.ok(Math.abs(Number(shown.replace('Δ ', '').replace('−', '-')) - expected) < 0.02, `${shown}, ${expected}`);
  await figure.locator('.plots').focus();
  await page.keyboard.press('c');
  assert.equal(await figure.locator('.clock').textContent(), '');
  for (const key of ['Home', 'a', 'End', 'b']) await page.keyboard.press(key);
  assert.match(await figure.locator('.clock').textContent(), /Δt = 19\.9990 s/);
  await page.waitForFunction(() => document.querySelector('.unseen').textContent.includes('difference'));
});

test('plots are saved as a picture, and the traces that are on as data of the time that is shown', async () => {
  const { page } = await opened('usual');
  const figure = await plots(page);
  await figure.locator('.plots').focus();
  for (const key of ['Home', '+', '+', '+', 'PageDown']) await page.keyboard.press(key);
  const [from, to] = await range(figure);
  await figure.getByRole('button', { name: /condensed/ }).first().click();
  const savedBy = async (name) => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name }).first().click()]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };
  const data = await savedBy('Save the visible data (CSV)');
  assert.equal(data.name, 'usual_data.csv');
  const [head, ...lines] = data.bytes.toString('utf8').trim().split('\n');
  assert.match(head, /^time \[s\],Flow rate: 95 % band lower \[L\/min\],/);
  assert.match(head, /Coil current: measured \[A\],Oil temperature: measured \[°C\],status$/);
  assert.doesNotMatch(head, /Flow rate: condensed/);
  assert.ok(Math.abs(Number(lines[0].split(',')[0]) - from) < 0.002 && Math.abs(Number(lines.at(-1).split(',')[0]) - to) < 0.002);
  assert.ok(Math.abs(lines.length - 1000 * (to - from)) <= 1, 'a line a sample');
  const picture = await savedBy('Save the plots as a picture (PNG)');
  assert.equal(picture.name, 'usual_plots.png');
  assert.deepEqual([...picture.bytes.subarray(1, 4)], [...'PNG'].map((letter) => letter.charCodeAt(0)));
  assert.ok(picture.bytes.length > 20_000);
  if (pictures) writeFileSync(join(pictures, picture.name), picture.bytes);
});

test('any channel stands over any other, and current, voltage and oil temperature are among them', async () => {
  const { page } = await opened('named');
  const figure = await plots(page);
  const titles = await figure.locator('.readout b').allTextContents();
  for (const title of ['Coil current [A]', 'Coil voltage [V]', 'Oil temperature [°C]']) assert.ok(titles.includes(title), titles.join());
  await figure.locator('.xy summary').press('Enter');
  const drawing = figure.locator('.xy canvas');
  await drawing.waitFor();
  const before = await drawing.evaluate((canvas) => canvas.toDataURL());
  await figure.locator('select[name=x]').selectOption('Coil current: measured');
  await figure.locator('select[name=y]').selectOption('Forces on the spool: magnetic');
  await page.waitForTimeout(50);
  assert.notEqual(await drawing.evaluate((canvas) => canvas.toDataURL()), before);
  assert.equal(await figure.locator('.xy [role=img]').getAttribute('aria-label'), 'Forces on the spool: magnetic [N] over Coil current: measured [A]');
  await page.selectOption('select[name=temperature]', '°F');
  await figure.locator('.plots').press('Home');
  const shown = (await readOut(figure)).values.find(({ title }) => title === 'Oil temperature [°F]');
  assert.equal(shown.series.measured, '122.0');
  await picture(page, 'xy');
});

test('the page says what its choosers of units do not change', async () => {
  const { page } = await opened('usual');
  assert.match(await page.locator('.unit-controls').textContent(), /^Plots over time: .*Other figures, tables and print keep the units/);
});

test('on paper the figures of a pair are of one size, and no text of an axis is smaller than 7 pt', async () => {
  for (const name of ['usual', 'analysis']) {
    const { page } = await opened(name);
    await page.setViewportSize({ width: 695, height: 900 });  // A4 less its margins: 184 mm
    await page.emulateMedia({ media: 'print' });
    const printed = await page.evaluate(() => {
      const visible = (each) => each.getBoundingClientRect().height > 0;
      const small = [...document.querySelectorAll('figure svg[role=img]')].filter(visible).flatMap((drawing) => {
        const scale = drawing.getBoundingClientRect().width / drawing.viewBox.baseVal.width;
        return [...drawing.querySelectorAll('.tick, .label')]
          .map((text) => 0.75 * scale * parseFloat(getComputedStyle(text).fontSize)).filter((size_pt) => size_pt < 6.99)
          .map((size_pt) => `${drawing.getAttribute('aria-label')}: ${size_pt.toFixed(1)} pt`);
      });
      const widths = [...document.querySelectorAll('.pair')].map((pair) => [...pair.querySelectorAll('figure')]
        .map((figure) => Math.round(figure.getBoundingClientRect().width)));
      return { small: [...new Set(small)], uneven: widths.filter((each) => new Set(each).size > 1), pairs: widths.length };
    });
    assert.ok(printed.pairs > 1);
    assert.deepEqual(printed.small, [], name);
    assert.deepEqual(printed.uneven, [], name);
    await page.emulateMedia({ media: 'screen' });
  }
});
