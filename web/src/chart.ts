/** One pair of axes over time: lines, bands and stacked layers. */
import uPlot from 'uplot';
import { colour, paleColour } from './colours';
import { bindClicks, cursorOf, drawMarks, hooksOf, rightMargin, showCursor, xAxis, xAxisHeightOf, yAxis } from './plot_options';
import type { Panel, Run, Series } from './run_data';
import { drawnEdge, drawnLine, drawnRange, drawnTimes } from './thinning';
import { inUnit } from './readers_units';
import type { Unit } from './units';
import type { View } from './view';

/** Drawn numbers a view at most: two a bucket. */
const mostBuckets = 2000;

export class Chart {
  readonly plot: uPlot;
  private readonly hidden = new Set<Series>();
  /** The values between which the reader looks, in the data's unit; null: all. */
  private height: [number, number] | null = null;
  /** For each series where its columns stand in the plot's data. */
  private readonly columns = new Map<Series, number>();

  constructor(private readonly run: Run, readonly panel: Panel, private readonly view: View, private unit: Unit,
              place: HTMLElement, width: number, private readonly last: boolean) {
    const columns: uPlot.Series[] = [{}];
    for (const series of panel.series) {
      this.columns.set(series, columns.length);
      const line: uPlot.Series = { points: { show: false }, spanGaps: false };
      if (series.shape === 'line') {
        columns.push({ ...line, stroke: () => colour(series.tone), width: series.width });
      } else if (series.shape === 'layer') {
        columns.push({ ...line, stroke: () => colour(series.tone), width: 1 });
      } else {
        columns.push({ ...line, width: 0 }, { ...line, width: 0 });
      }
    }
    this.plot = new uPlot({
      width,
      height: panel.height + xAxisHeightOf(last),
      padding: [6, rightMargin, 0, 0],
      legend: { show: false },
      scales: {
        x: { time: false, auto: false, range: () => [view.from, view.to] },
        y: { range: (_plot, lowest, highest) => this.heightOf(lowest, highest) },
      },
      axes: [xAxis(last), yAxis(panel.height)],
      series: columns,
      cursor: cursorOf(view, true),
      hooks: {
        ...hooksOf(view, (low, high) => this.zoomHeight(low, high)),
        drawAxes: [() => this.fillAreas()],
        draw: [(plot) => drawMarks(plot, view)],
      },
    }, this.data(width), place);
    bindClicks(this.plot, view, (time) => run.nearest(time));
    view.onReset(() => { this.height = null; });
  }

  /** New range, unit or width. */
  refresh(unit: Unit, width: number): void {
    this.unit = unit;
    if (width !== this.plot.width) this.plot.setSize({ width, height: this.panel.height + xAxisHeightOf(this.last) });
    this.plot.batch(() => {
      this.plot.setData(this.data(width), false);
      this.plot.setScale('x', { min: this.view.from, max: this.view.to });
    });
  }

  showCursor(): void {
    showCursor(this.plot, this.view);
  }

  isShown(series: Series): boolean {
    return !this.hidden.has(series);
  }

  get empty(): boolean {
    return this.hidden.size === this.panel.series.length;
  }

  /** Smallest and largest value of the picture, in the reader's unit. */
  get values(): [number, number] {
    return [this.plot.scales.y.min ?? 0, this.plot.scales.y.max ?? 1];
  }

  /** In the reader's unit. */
  zoomHeight(lowest: number, highest: number): void {
    const fromUnit = (value: number): number => (value - this.unit.offset) / this.unit.factor;
    this.height = [fromUnit(lowest), fromUnit(highest)];
    this.plot.setData(this.plot.data, false);
    this.plot.setScale('x', { min: this.view.from, max: this.view.to });
  }

  /** `factor` below 1 zooms in. The value of the first trace at the cursor stays where it is, else the middle. */
  zoomHeightBy(factor: number): void {
    const [lowest, highest] = this.values;
    const leading = this.panel.series.find((series) => series.shape === 'line' && this.isShown(series));
    const time = this.view.cursor ?? this.view.marks.a;
    const value = leading && time !== null ? inUnit(leading.lowest.at(this.run.indexAt(time)), this.unit) : NaN;
    const about = value > lowest && value < highest ? value : 0.5 * (lowest + highest);
    this.zoomHeight(about - (about - lowest) * factor, about + (highest - about) * factor);
  }

  toggle(series: Series, shown: boolean): void {
    if (shown) this.hidden.delete(series);
    else this.hidden.add(series);
    const first = this.columns.get(series) as number;
    this.plot.setSeries(first, { show: shown }, false);
    if (series.shape === 'band') this.plot.setSeries(first + 1, { show: shown }, false);
  }

  private data(width: number): uPlot.AlignedData {
    const buckets = Math.max(50, Math.min(mostBuckets, Math.round(width)));
    const range = drawnRange(this.run.times, this.view.from, this.view.to, buckets, this.run.samplesPerStretch === 1);
    const out: (number | null)[][] = [drawnTimes(this.run.times, range)];
    for (const series of this.panel.series) {
      if (series.shape === 'band') {
        out.push(drawnEdge(series.lowest, range, this.unit.factor, false, this.unit.offset),
                 drawnEdge(series.highest, range, this.unit.factor, true, this.unit.offset));
      } else {
        out.push(drawnLine(series.drawn, range, this.unit.factor, this.unit.offset));
      }
    }
    return out as uPlot.AlignedData;
  }

  private heightOf(lowest: number | null, highest: number | null): [number, number] {
    if (this.height !== null) return [inUnit(this.height[0], this.unit), inUnit(this.height[1], this.unit)];
    if (lowest === null || highest === null) return [0, 1];
    if (this.panel.fromZero) lowest = Math.min(0, lowest);
    if (lowest === highest) return [lowest - 0.5, highest + 0.5];
    const margin = 0.06 * (highest - lowest);
    return [lowest === 0 ? 0 : lowest - margin, highest + margin];
  }

  private fillAreas(): void {
    let below: (number | null)[] | null = null;
    for (const series of this.panel.series) {
      if (series.shape === 'line') continue;
      const first = this.columns.get(series) as number;
      const data = this.plot.data as (number | null)[][];
      const shown = !this.hidden.has(series);
      if (series.shape === 'band') {
        if (shown) this.fillBetween(data[first], data[first + 1], paleColour(series.tone, 0.22));
        continue;
      }
      if (shown) this.fillBetween(below, data[first], paleColour(series.tone, 0.32));
      below = data[first];
    }
  }

  /** `lower` null: from zero. */
  private fillBetween(lower: (number | null)[] | null, upper: (number | null)[], fill: string): void {
    const { ctx, bbox } = this.plot;
    const times = this.plot.data[0];
    const x = (k: number): number => this.plot.valToPos(times[k], 'x', true);
    const y = (value: number): number => this.plot.valToPos(value, 'y', true);
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.fillStyle = fill;
    ctx.beginPath();
    for (let begin = 0; begin < times.length;) {
      let end = begin;
      while (end < times.length && upper[end] !== null && (lower === null || lower[end] !== null)) ++end;
      for (let k = begin; k < end; ++k) {
        if (k === begin) ctx.moveTo(x(k), y(upper[k] as number));
        else ctx.lineTo(x(k), y(upper[k] as number));
      }
      for (let k = end; k-- > begin;) ctx.lineTo(x(k), y(lower === null ? 0 : (lower[k] as number)));
      if (end > begin) ctx.closePath();
      begin = end + 1;
    }
    ctx.fill();
    ctx.restore();
  }
}
