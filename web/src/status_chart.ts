/** What the sensor said of itself over time: one bar a status name; pale where only part of a stretch has it. */
import uPlot from 'uplot';
import { colour, paleColour } from './colours';
import { bindClicks, cursorOf, drawMarks, hooksOf, rightMargin, showCursor, xAxis, xAxisHeightOf, yAxisWidth } from './plot_options';
import type { Run, Status } from './run_data';
import { bucketBegin, drawnRange } from './thinning';
import type { View } from './view';

/** A name, and its bar below it. */
const rowHeight = 27;
const nameHeight = 15;
const barHeight = 9;

export class StatusChart {
  readonly plot: uPlot;

  constructor(private readonly run: Run, private readonly status: Status, private readonly view: View,
              place: HTMLElement, width: number) {
    this.plot = new uPlot({
      width,
      height: this.height(),
      padding: [2, rightMargin, 0, 0],
      legend: { show: false },
      scales: { x: { time: false, auto: false, range: () => [view.from, view.to] }, y: { range: () => [0, 1] } },
      axes: [xAxis(true), { size: yAxisWidth, grid: { show: false }, ticks: { show: false }, values: () => [] }],
      series: [{}, {}],
      cursor: cursorOf(view),
      hooks: { ...hooksOf(view), draw: [() => this.drawRows(), (plot) => drawMarks(plot, view, false)] },
    }, [[view.first, view.last], [null, null]], place);
    bindClicks(this.plot, view, (time) => run.nearest(time));
  }

  refresh(width: number): void {
    if (width !== this.plot.width) this.plot.setSize({ width, height: this.height() });
    this.plot.setScale('x', { min: this.view.from, max: this.view.to });
  }

  showCursor(): void {
    showCursor(this.plot, this.view);
  }

  private height(): number {
    return rowHeight * this.status.names.length + xAxisHeightOf(true) + 2;
  }

  private drawRows(): void {
    const { ctx, bbox } = this.plot;
    const row = bbox.height / this.status.names.length;
    const pixels = bbox.width / devicePixelRatio;
    const range = drawnRange(this.run.times, this.view.from, this.view.to, Math.max(1, Math.round(pixels)), true);
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    for (let b = 0; b < range.buckets; ++b) {
      const begin = bucketBegin(range, b);
      const end = bucketBegin(range, b + 1);
      let some = 0;
      let all = 0xffff;
      for (let k = begin; k < end; ++k) {
        some |= this.status.bits[k];
        all &= this.status.bits[k];
      }
      if (some === 0) continue;
      const left = this.plot.valToPos(this.run.times.at(begin), 'x', true);
      const right = this.plot.valToPos(this.run.times.at(Math.min(end, this.run.times.length - 1)), 'x', true);
      for (let n = 0; n < this.status.names.length; ++n) {
        const { tone, bit } = this.status.names[n];
        if ((some & (1 << bit)) === 0) continue;
        ctx.fillStyle = (all & (1 << bit)) !== 0 ? colour(tone) : paleColour(tone, 0.55);
        ctx.fillRect(left, bbox.top + n * row + nameHeight * devicePixelRatio, Math.max(1, right - left), barHeight * devicePixelRatio);
      }
    }
    ctx.font = `${11.5 * devicePixelRatio}px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif`;
    ctx.textAlign = 'left';
    ctx.textBaseline = 'middle';
    this.status.names.forEach((status, n) => {
      ctx.fillStyle = colour('ink');
      ctx.fillText(`${status.name} (${status.share})`, bbox.left + devicePixelRatio, bbox.top + n * row + 8 * devicePixelRatio);
    });
    ctx.restore();
  }
}
