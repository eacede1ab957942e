/** A figure over hours or days: its line, the band about it, what it is compared with, and when it was raised. */
import uPlot from 'uplot';
import { colour, paleColour } from '../colours';
import { tickTexts } from '../plot_options';
import { clock } from './api';
import { element } from './element';

type Column = (number | null)[];

export interface Curve {
  title: string;
  /** Seconds since 1970. */
  times: number[];
  middle: Column;
  lower: Column;
  upper: Column;
  /** What is usual; null where there is no such thing. */
  usual: Column | null;
  raised: boolean[];
  /** What lies beyond counts towards an alarm; null: nothing on that side. */
  alarmBelow: number | null;
  alarmAbove: number | null;
}

/** Another valve's over the same time. */
export interface Beside {
  name: string;
  curve: Curve;
}

const tall = 150;
const font = '12px system-ui, sans-serif';

/** Rows are missing where the program did not run: the line breaks there. */
export function withGaps(curve: Curve, longest_s: number): Curve {
  const out: Curve = { ...curve, times: [], middle: [], lower: [], upper: [], usual: curve.usual === null ? null : [], raised: [] };
  const put = (time: number, k: number | null): void => {
    out.times.push(time);
    out.middle.push(k === null ? null : curve.middle[k]!);
    out.lower.push(k === null ? null : curve.lower[k]!);
    out.upper.push(k === null ? null : curve.upper[k]!);
    out.usual?.push(k === null ? null : curve.usual![k]!);
    out.raised.push(k === null ? false : curve.raised[k]!);
  };
  curve.times.forEach((time, k) => {
    if (k > 0 && time - curve.times[k - 1]! > longest_s) put((time + curve.times[k - 1]!) / 2, null);
    put(time, k);
  });
  return out;
}

/** Marks of the time axis, by their distance: day, hour and minute as most of the world writes them. */
const day = '{YYYY}-{MM}-{DD}';
const clockTexts = [
  [86400, '{MM}-{DD}', '\n{YYYY}', null, null, null, null, null, 1],
  [60, '{HH}:{mm}', `\n${day}`, null, `\n${day}`, null, null, null, 1],
  [1, '{HH}:{mm}:{ss}', `\n${day}`, null, `\n${day}`, null, null, null, 1],
] as unknown as uPlot.Axis.Values;

export class HistoryPlot {
  readonly place: HTMLElement;
  private readonly title = element('figcaption', '');
  private readonly room = element('div', 'room');
  private plot: uPlot | null = null;
  private curve: Curve | null = null;
  private beside: Beside | null = null;
  private range: [number, number] | null = null;

  constructor(private readonly group: string) {
    this.place = element('figure', 'history', this.title, this.room);
    this.place.tabIndex = 0;
    this.place.setAttribute('role', 'group');
    this.place.addEventListener('keydown', (event) => this.zoomByKey(event));
  }

  /** The range is kept where the reader has zoomed into the same span. */
  show(curve: Curve, from: number, to: number, beside: Beside | null = null): void {
    const zoom = this.zoomed(from, to);
    this.curve = curve;
    this.beside = beside;
    this.title.textContent = curve.title;
    const known = [...curve.middle].reverse().find((value) => value !== null) ?? null;
    this.place.setAttribute('aria-label', `${curve.title} over time, last ${known ?? 'not known'}${beside === null ? '' : `, with ${beside.name}`}`);
    const other = beside?.curve ?? { times: [], upper: [], lower: [], middle: [] };
    const data = uPlot.join([[curve.times, curve.upper, curve.lower, curve.middle, curve.usual ?? curve.times.map(() => null)],
                             [other.times, other.upper, other.lower, other.middle]] as uPlot.AlignedData[]);
    if (this.plot === null) this.plot = this.made(data);
    else this.plot.setData(data, false);
    this.plot.setScale('x', zoom ?? { min: from, max: to });
    this.range = zoom === null ? [from, to] : this.range;
    this.resize();
  }

  private zoomed(begin: number, end: number): { min: number; max: number } | null {
    const min = this.plot?.scales['x']?.min, max = this.plot?.scales['x']?.max, times = this.curve?.times ?? [];
    if (this.range === null || min == null || max == null) return null;
    const [from, to] = this.range, span = end - begin;
    if (Math.abs((to - from) - span) > 0.1 * span || Math.abs(to - end) > 0.1 * span) return null;  // another time was asked for
    const whole = (min === from && max === to) || (min === times[0] && max === times[times.length - 1]);
    return whole ? null : { min, max };
  }

  /** Plus and minus zoom, the arrows move the picture, 0 shows the whole span. */
  private zoomByKey(event: KeyboardEvent): void {
    const min = this.plot?.scales['x']?.min, max = this.plot?.scales['x']?.max;
    if (this.plot === null || this.range === null || min == null || max == null) return;
    const [from, to] = this.range, width = max - min, middle = 0.5 * (min + max);
    const shifted = (by: number): [number, number] => {
      const begin = Math.min(Math.max(min + by * width, from), to - width);
      return [begin, begin + width];
    };
    const zoomed = (factor: number): [number, number] =>
      [Math.max(from, middle - 0.5 * factor * width), Math.min(to, middle + 0.5 * factor * width)];
    const acts: Record<string, () => [number, number]> = {
      '+': () => zoomed(0.5), '=': () => zoomed(0.5), '-': () => zoomed(2), '0': () => [from, to],
      ArrowLeft: () => shifted(-0.25), ArrowRight: () => shifted(0.25),
    };
    const act = acts[event.key];
    if (act === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const [begin, end] = act();
    this.plot.setScale('x', { min: begin, max: end });
    this.place.dataset['shown'] = (end - begin).toFixed(1);
  }

  resize(): void {
    const width = this.room.clientWidth;
    if (this.plot !== null && width > 0 && width !== this.plot.width) this.plot.setSize({ width, height: tall });
  }

  redraw(): void {
    this.plot?.redraw(false);
  }

  destroy(): void {
    this.plot?.destroy();
  }

  private made(data: uPlot.AlignedData): uPlot {
    const line = { stroke: () => colour('rule'), width: 1 };
    const axis: uPlot.Axis = { stroke: () => colour('soft'), font, grid: line, ticks: { show: false } };
    const none = { points: { show: false }, spanGaps: false };
    return new uPlot({
      width: Math.max(200, this.room.clientWidth || 400),
      height: tall,
      padding: [8, 12, 0, 0],
      legend: { show: false },
      scales: { x: { time: true }, y: { range: (_plot, lowest, highest) => this.heightOf(lowest, highest) } },
      axes: [{ ...axis, space: 70, values: clockTexts }, { ...axis, size: 58, space: 18, values: (_plot, splits, _axis, _space, step) => tickTexts(splits, step) }],
      cursor: { y: false, drag: { x: true, y: false }, sync: { key: this.group } },
      series: [
        {},
        { ...none, width: 0 },
        { ...none, width: 0 },
        { ...none, stroke: () => colour('observer'), width: 1.6, points: { show: data[0].length < 40, size: 4 } },
        { ...none, stroke: () => colour('soft'), width: 1, dash: [5, 4] },
        { ...none, width: 0 },
        { ...none, width: 0 },
        { ...none, stroke: () => colour('condensed'), width: 1.6 },
      ],
      bands: [{ series: [1, 2], fill: () => paleColour('observer', 0.2) }, { series: [5, 6], fill: () => paleColour('condensed', 0.2) }],
      hooks: { draw: [(plot) => this.markRaised(plot), (plot) => this.markLimits(plot)], setCursor: [(plot) => this.read(plot)] },
    }, data, this.room);
  }

  /** With room for the limits of alarms. */
  private heightOf(lowest: number | null, highest: number | null): [number, number] {
    if (lowest === null || highest === null) return [0, 1];
    lowest = Math.min(lowest, this.curve?.alarmBelow ?? lowest);
    highest = Math.max(highest, this.curve?.alarmAbove ?? highest);
    const margin = Math.max(0.08 * (highest - lowest), 1e-9 + 0.01 * Math.abs(highest));
    return [lowest - margin, highest + margin];
  }

  private markRaised(plot: uPlot): void {
    const raised = this.curve?.raised ?? [], times = this.curve?.times ?? [];
    plot.ctx.save();
    plot.ctx.fillStyle = colour('fault');
    const { left, top, width } = plot.bbox;
    for (let k = 0; k < raised.length; ++k) {
      if (!raised[k]) continue;
      const from = plot.valToPos(times[k]!, 'x', true);
      const to = k + 1 < times.length ? plot.valToPos(times[k + 1]!, 'x', true) : from + 3;
      const begin = Math.max(left, from), end = Math.min(left + width, Math.max(to, from + 2));
      if (end > begin) plot.ctx.fillRect(begin, top, end - begin, 4 * devicePixelRatio);
    }
    plot.ctx.restore();
  }

  private markLimits(plot: uPlot): void {
    const { left, width, top, height } = plot.bbox;
    plot.ctx.save();
    plot.ctx.strokeStyle = colour('fault');
    plot.ctx.fillStyle = paleColour('fault', 0.08);
    plot.ctx.lineWidth = devicePixelRatio;
    plot.ctx.setLineDash([2 * devicePixelRatio, 3 * devicePixelRatio]);
    for (const [limit, above] of [[this.curve?.alarmAbove, true], [this.curve?.alarmBelow, false]] as const) {
      if (limit == null) continue;
      const y = Math.min(Math.max(plot.valToPos(limit, 'y', true), top), top + height);
      plot.ctx.fillRect(left, above ? top : y, width, above ? y - top : top + height - y);
      plot.ctx.beginPath();
      plot.ctx.moveTo(left, y);
      plot.ctx.lineTo(left + width, y);
      plot.ctx.stroke();
    }
    plot.ctx.restore();
  }

  private read(plot: uPlot): void {
    const curve = this.curve, k = plot.cursor.idx;
    if (curve === null) return;
    const at = (series: number): number | null => (k === null || k === undefined ? null : plot.data[series]?.[k]) ?? null;
    if (at(3) === null && at(7) === null) {
      this.title.textContent = curve.title;
      return;
    }
    const digits = (each: number | null): string => each === null ? '–' : String(Number(each.toPrecision(4))).replace('-', '−');
    const one = (series: number): string => `${digits(at(series + 2))} (${digits(at(series + 1))} to ${digits(at(series))})`;
    this.title.textContent = `${curve.title}: ${one(1)}${this.beside === null ? '' : `, ${this.beside.name} ${one(5)}`}, ${clock(at(0)! * 1000)}`;
  }
}
