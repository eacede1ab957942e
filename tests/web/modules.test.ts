import assert from 'node:assert/strict';
import { test } from 'node:test';
import { numberText } from './src/number_text';
import { mapOf, rowsOf } from './src/playground/channel_map';
import { channelOf, missing, type PackedNumbers } from './src/packed_numbers';
import { tickTexts } from './src/plot_options';
import { causesText, goodText, grouped, measured, trendText, type Alarm, type Indicator, type Valve } from './src/live/api';
import { sparkOf } from './src/live/overview';
import { markStep, timeMark } from './src/live/plot';
import { choices, ReadersUnits } from './src/readers_units';
import { SampleTimes } from './src/sample_times';
import { drawnEdge, drawnLine, drawnRange, drawnTimes } from './src/thinning';
import { units as table } from './src/units';
import { differenceText } from './src/readout';
import { runOf, type Series } from './src/run_data';
import { View } from './src/view';
import { visibleCsv } from './src/visible_data';

function packed(codes: number[], scale = 1): PackedNumbers {
  return { offset: 0, scale, values: Buffer.from(new Int16Array(codes).buffer).toString('base64') };
}

function spike(length: number, at: number, code: number): number[] {
  const codes = new Array<number>(length).fill(0);
  codes[at] = code;
  return codes;
}

test('marks of an axis carry the decimals of their step', () => {
  assert.deepEqual(tickTexts([-2.5, 0, 2.5], 2.5), ['\u22122.5', '0.0', '2.5']);
  assert.deepEqual(tickTexts([0, 25, 50], 25), ['0', '25', '50']);
  assert.deepEqual(tickTexts([0, 0.05], 0.05), ['0.00', '0.05']);
});

test('a peak of one sample in a million is drawn, at its time', () => {
  const times = new SampleTimes({ start: 0, count: 1_000_000, step: 0.001 });
  const channel = channelOf({ low: packed(spike(1_000_000, 654_321, 9999)) });
  const range = drawnRange(times, 0, 1000, 1000, true);
  const x = drawnTimes(times, range);
  const y = drawnLine(channel, range, 1);
  assert.equal(y.length, 2000);
  assert.equal(x.length, 2000);
  assert.equal(y.filter((value) => value === 9999).length, 1);
  assert.ok(Math.abs(x[y.indexOf(9999)] - 654.321) < 1);
  assert.ok(x.every((time, k) => k === 0 || time >= x[k - 1]));
});

test('zoomed in, every sample is drawn by itself', () => {
  const times = new SampleTimes({ start: 0, count: 1000, step: 1 });
  const channel = channelOf({ low: packed(Array.from({ length: 1000 }, (_value, k) => k), 0.5) });
  const range = drawnRange(times, 100, 200, 500, true);
  const x = drawnTimes(times, range);
  assert.ok(x.length >= 101 && x.length <= 105);
  assert.deepEqual(drawnLine(channel, range, 2), x);
});

test('what is not known breaks the line and does not hide a neighbour', () => {
  const times = new SampleTimes({ start: 0, count: 8, step: 1 });
  const channel = channelOf({ low: packed([missing, missing, missing, missing, missing, 5, 7, missing]) });
  const range = { from: 0, to: 8, buckets: 2, everySample: false };
  assert.deepEqual(drawnLine(channel, range, 1), [null, null, 5, 7]);
  assert.deepEqual(drawnEdge(channel.lowest, range, 1, true), [null, null, 7, 7]);
  assert.equal(drawnTimes(times, range).length, 4);
});

test('smallest and largest of a stretch come from their own columns', () => {
  const channel = channelOf({ low: packed([-3, -2]), high: packed([4, 9]) });
  assert.deepEqual(drawnLine(channel, { from: 0, to: 2, buckets: 1, everySample: false }, 1), [-3, 9]);
});

test('times of uneven steps are found', () => {
  const counts = new Uint32Array([0, 10, 11, 4_000_000_000]);
  const times = new SampleTimes({ start: 5, count: 4, tick: 0.5, values: Buffer.from(counts.buffer).toString('base64') });
  assert.equal(times.at(3), 5 + 2_000_000_000);
  assert.equal(times.countUntil(4.9), 0);
  assert.equal(times.countUntil(10), 2);
  assert.equal(times.indexAt(10.4, true), 2);
  assert.equal(times.indexAt(10.4, false), 1);
  assert.equal(times.indexAt(-100, true), 0);
});

test('the view stays inside the run, zooms about the cursor, and comes back', () => {
  const view = new View(0, 100, 1);
  view.putCursor(80);
  view.zoomBy(0.5);
  assert.deepEqual([view.from, view.to], [40, 90]);
  view.moveBy(1);
  assert.deepEqual([view.from, view.to], [50, 100]);
  view.zoomTo(30, 30.0001);
  assert.ok(view.to - view.from >= 8);
  view.putCursor(99, true);
  assert.ok(view.from <= 99 && 99 <= view.to);
  view.reset();
  assert.deepEqual([view.from, view.to, view.zoomed], [0, 100, false]);
});

test('a run of one sample has a picture', () => {
  const view = new View(3, 3, 0);
  assert.ok(view.from < 3 && 3 < view.to);
  view.zoomBy(0.1);
  assert.ok(view.from < view.to);
});

function runOfTwo(): ReturnType<typeof runOf> {
  const series = { name: 'measured', tone: 'ink', shape: 'line' as const, width: 1, low: packed([20, missing, 40, 50]) };
  return runOf({ run: 'two', samplesPerStretch: 1, fullScale: 80, time: { start: 0, count: 4, step: 0.5 },
                 panels: [{ title: 'Oil, of tank', quantity: 'temperature', height: 90, fromZero: false, series: [series] }] });
}

test('visible data are written in the range and the unit that are shown, unknown values empty', () => {
  const run = runOfTwo();
  const shown = run.panels.map((panel) => ({ panel, unit: table.temperature[1], series: panel.series }));
  assert.equal(visibleCsv(run, shown, 0.4, 1.2), 'time [s],"Oil, of tank: measured [°F]"\n0.5,\n1,104\n');
  assert.equal(visibleCsv(run, [], 1.5, 9), 'time [s]\n1.5\n');
});

test('differences of temperatures have no offset', () => {
  const [series] = runOfTwo().panels[0].series;
  assert.equal(differenceText(series, 0, 2, table.temperature[1]), '+36.0');
  assert.equal(differenceText(series, 2, 0, table.temperature[0]), '\u221220.0');
  assert.equal(differenceText({ ...series, shape: 'band' } as Series, 0, 2, table.temperature[0]), '');
});

test('the first click puts cursor A, the second B, the third begins again, half of a double click nothing', () => {
  const view = new View(0, 10, 1);
  view.clickAt(2);
  view.clickAt(5);
  assert.deepEqual(view.marks, { a: 2, b: 5 });
  view.clickAt(7);
  assert.deepEqual(view.marks, { a: 7, b: null });
  view.undoClick();
  assert.deepEqual(view.marks, { a: 2, b: 5 });
  view.clearMarks();
  assert.deepEqual(view.marks, { a: null, b: null });
});

test('numbers have a true minus sign, no negative zero, and a dash where nothing is known', () => {
  assert.equal(numberText(-1.26, 1), '−1.3');
  assert.equal(numberText(-0.001, 2), '0.00');
  assert.equal(numberText(NaN, 2), '–');
});

test('errors are stated in percent of full scale or in the unit of the flow', () => {
  const units = new ReadersUnits();
  assert.equal(units.unitOf('error', 80).factor * 8, 10);
  units.choose('error', 1);
  units.choose('flow', 1);
  assert.equal(units.unitOf('error', 80).name, 'm³/h');
  assert.equal(units.unitOf('flow', 80).factor * 1000, 60);
});

test('every unit of the table can be chosen, and a page made in it begins in it', () => {
  for (const [quantity, units] of Object.entries(table)) {
    const names = choices.find((choice) => choice.quantity === quantity)?.names;
    assert.deepEqual(names, units.length > 1 ? units.map((unit) => unit.name) : undefined);
    units.forEach((unit, k) => {
      const made = new ReadersUnits({ [`${quantity}Unit`]: String(k) });
      assert.equal(made.unitOf(quantity as keyof typeof table, 80), unit);
    });
  }
  assert.equal(Math.round(new ReadersUnits({ pressureUnit: '2' }).unitOf('pressure', 80).factor * 60), 870);
});

test('a channel map is the same as rows and as text, and its comments stay', () => {
  const text = '# of the rig\n[channels]\ntime = { column = "t", unit = "ms" }\nposition = { column = "LVDT \\"2\\"", unit = "V", scale = 0.24, offset = -0.6, to = "mm" }\n';
  const rows = rowsOf(text);
  assert.deepEqual(rows.map((row) => row.channel), ['time', 'position']);
  assert.deepEqual(rows[1], { channel: 'position', column: 'LVDT "2"', unit: 'V', scale: '0.24', offset: '-0.6', to: 'mm' });
  assert.equal(mapOf(rows, text), text);
  rows[0].unit = 's';
  rows.push({ channel: 'current', column: 'I [mA]', unit: '', scale: '', offset: '', to: '' }, { channel: 'voltage', column: '', unit: 'V', scale: '', offset: '', to: '' });
  assert.equal(mapOf(rows, text), text.replace('"ms"', '"s"') + 'current = { column = "I [mA]" }\n');
  assert.deepEqual(rowsOf("current = { column = 'I', unit = \"?\" } # a guess\n")[0], { channel: 'current', column: 'I', unit: '?', scale: '', offset: '', to: '' });
  assert.equal(mapOf([]), '[channels]\n');
});

const seen = (name: string, state: string, more: object = {}): Indicator =>
  ({ name, value: 1, unit: '1', uncertainty_95: 0.1, baseline: 1, state, ...more });

test('of indicators raised ones come first, then the most informative ones, and counters stand apart', () => {
  const found = grouped([seen('strokes', 'counts'), seen('dither_frequency', 'good'), seen('position_zero', 'good'), seen('friction_ratio', 'good'),
                         seen('dither_frees', 'raised'), seen('friction_ratio_a', 'good')]);
  assert.deepEqual(found.shown.map((one) => one.name), ['dither_frees', 'friction_ratio', 'friction_ratio_a', 'position_zero']);
  assert.deepEqual(found.more.map((one) => one.name), ['dither_frequency']);
  assert.deepEqual(found.counters.map((one) => one.name), ['strokes']);
});

test('a trend shows how fast and when its limit is reached, in the indicator’s unit', () => {
  const trend = { per_hour: 0.5e-6, uncertainty_95: 1e-7, limit: 80e-6, hours_to_limit: 100, hours_to_limit_95: [80, 130] as [number, number] };
  assert.equal(trendText(seen('edge_rounding', 'good', { value: 20e-6, unit: 'm', trend })), '+12 µm a day; reaches its limit of 80 µm in about 4 days at work');
  assert.equal(trendText(seen('edge_rounding', 'good', { value: 20e-6, unit: 'm', trend: { ...trend, hours_to_limit: null } })), '+12 µm a day');
  assert.equal(trendText(seen('edge_rounding', 'good', { trend: null })), '');
});

test('an indicator is beyond its limit where its value is, not where its trend has run ahead', () => {
  const trend = { per_hour: 0.4, uncertainty_95: 0.1, limit: 1.8, hours_to_limit: 0, hours_to_limit_95: [0, 1] as [number, number] };
  assert.equal(trendText(seen('friction_ratio', 'raised', { value: 1.407, trend })), '+9.6 a day; by its trend it is about to reach its limit of 1.8');
  assert.equal(trendText(seen('friction_ratio', 'raised', { value: 1.93, trend })), '+9.6 a day; it is beyond its limit of 1.8');
  const falling = { ...trend, per_hour: -60e-6, limit: -50e-6 };
  assert.equal(trendText(seen('position_zero', 'good', { value: -1e-6, unit: 'm', trend: falling })),
               '−60 µm an hour; by its trend it is about to reach its limit of −50 µm');
  assert.equal(trendText(seen('position_zero', 'raised', { value: -52e-6, unit: 'm', trend: { ...falling, hours_to_limit: 0.1 } })),
               '−60 µm an hour; it is beyond its limit of −50 µm');
});

test('a value has the digits that its uncertainty leaves it', () => {
  assert.equal(measured(seen('friction_ratio', 'good', { value: 0.9407, uncertainty_95: 0.128 })), '0.94 ± 0.13');
  assert.equal(measured(seen('position_zero', 'good', { value: -1.04e-6, uncertainty_95: 0.996e-5, unit: 'm' })), '−1 ± 10 µm');
  assert.equal(measured(seen('breakaway_force', 'good', { value: 1249.6, uncertainty_95: 123, unit: 'N' })), '1250 ± 120 N');
  assert.equal(measured(seen('coil_resistance', 'good', { value: 3.14159, uncertainty_95: 0, unit: 'Ohm' })), '3.142 ± 0 Ω');
  assert.equal(measured(seen('position_zero', 'unknown', { value: null, uncertainty_95: null, unit: 'm' })), '– ± – µm');
});

test('a cause is likely where its alarm stands or an indicator is raised, and suspected else', () => {
  const valve = { id: 'v', causes: [{ cause: 'position_sensor', odds: 1e6 }, { cause: 'friction', odds: 2 }], indicators: [seen('friction_ratio', 'good')] } as Valve;
  const alarm = { valve: 'v', cause: 'position_sensor', gone: null } as Alarm;
  assert.equal(causesText(valve, [alarm]), 'Likely: position sensor (odds 1.00e+6). Suspected, not decided: friction (odds 2)');
  assert.equal(causesText(valve, [{ ...alarm, valve: 'w' }, { ...alarm, gone: '2026-11-29T09:00:00Z' }]),
               'Suspected, not decided: position sensor (odds 1.00e+6), friction (odds 2)');
  assert.equal(causesText({ ...valve, indicators: [seen('friction_ratio', 'raised')] }, []), 'Likely: position sensor (odds 1.00e+6), friction (odds 2)');
  assert.equal(causesText({ ...valve, causes: [] }, [alarm]), '');
});

test('valves that are all good are counted by that word', () => {
  assert.equal(goodText(0), 'all good');
  assert.equal(goodText(3), '3 not good');
});

test('marks of a low plot stand apart, and those of old samples do not end now', () => {
  for (const length of [30, 44, 120, 300]) {
    for (const range of [0.013, 0.5, 0.73, 2.9, 61]) {
      const step = markStep(range, length);
      assert.ok(length * step / range >= 16 - 1e-9, `${length} ${range}`);
      assert.ok(step <= range || length < 32, `${length} ${range}`);
    }
  }
  assert.deepEqual([30, 0].map((before) => timeMark(before, '')), ['−30 s', 'now']);
  assert.deepEqual([30, 0].map((before) => timeMark(before, '62 s')), ['30 s before', '62 s ago']);
});

test('a card’s line and band break where no samples came', () => {
  const one = (flow: number | null) => ({ flow, lower: flow === null ? null : flow - 1, upper: flow === null ? null : flow + 1 });
  const { line, band } = sparkOf([one(1), one(2), one(null), one(3)], 80);
  assert.equal(line.split('M').length - 1, 2);
  assert.equal(band.split('Z').length - 1, 2);
  assert.match(line, /^M116 \S+L117 \S+M119 \S+$/);  // the newest at the right of 120
});
