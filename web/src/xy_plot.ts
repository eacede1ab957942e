/** Any channel of a run over any other, for the time that the plots above show. */
import uPlot from 'uplot';
import { colour } from './colours';
import { element } from './element';
import { rightMargin, valueAxis, yAxis } from './plot_options';
import { inUnit } from './readers_units';
import { middleOf } from './readout';
import type { Panel, Run, Series } from './run_data';
import type { Unit } from './units';
import type { View } from './view';

interface Channel {
  panel: Panel;
  series: Series;
}

const height = 420;

export class XyPlot {
  readonly root = element('details', 'xy');
  private readonly place = element('div', 'chart');
  private readonly dot = element('i', 'xy-dot');
  private readonly said = element('p', 'xy-said');
  private readonly channels: Channel[];
  private readonly across: HTMLSelectElement;
  private readonly up: HTMLSelectElement;
  private plot: uPlot | null = null;

  constructor(private readonly run: Run, private readonly view: View, private readonly unitOf: (panel: Panel) => Unit) {
    this.channels = run.panels.flatMap((panel) =>
      panel.series.filter((series) => series.shape !== 'band').map((series) => ({ panel, series })));
    const summary = document.createElement('summary');
    summary.textContent = 'One channel over another (x-y plot)';
    const place = (quantity: string): number => Math.max(0, this.channels.findIndex(({ panel }) => panel.quantity === quantity));
    this.across = this.chooser('x', place('position'));
    this.up = this.chooser('y', this.leadingFlow());
    const choice = element('div', 'tools');
    choice.append(this.labelled('Across', this.across), this.labelled('Up', this.up));
    this.place.setAttribute('role', 'img');
    this.root.append(summary, choice, this.place, this.said);
    this.root.addEventListener('toggle', () => this.refresh());
    this.view.onRange(() => this.refresh());
    this.view.onCursor(() => this.showCursor());
  }

  get canvas(): HTMLCanvasElement | null {
    return this.root.open && this.plot !== null ? this.plot.ctx.canvas : null;
  }

  get title(): string {
    return `${this.nameOf(this.chosen(this.up))} over ${this.nameOf(this.chosen(this.across))}`;
  }

  refresh(): void {
    if (!this.root.open || this.place.clientWidth === 0) return;
    const width = Math.min(this.place.clientWidth, 1.6 * height);
    this.plot ??= this.made(width);
    if (width !== this.plot.width) this.plot.setSize({ width, height });
    const [x, y] = [this.rangeOf(this.chosen(this.across)), this.rangeOf(this.chosen(this.up))];
    this.plot.batch((plot: uPlot) => {
      plot.setScale('x', { min: x[0], max: x[1] });
      plot.setScale('y', { min: y[0], max: y[1] });
    });
    this.plot.redraw(false, true);
    this.place.setAttribute('aria-label', this.title);
    const exact = this.run.samplesPerStretch === 1 ? '' : ' Of each stretch of samples the middle is drawn.';
    this.said.textContent = `Up: ${this.nameOf(this.chosen(this.up))}. The time that the plots above show.${exact}`;
    this.showCursor();
  }

  private leadingFlow(): number {
    const flows = this.channels.map(({ panel }, k) => ({ panel, k })).filter(({ panel }) => panel.quantity === 'flow');
    return flows.length === 0 ? 0 : flows[flows.length - 1].k;
  }

  private chooser(name: string, chosen: number): HTMLSelectElement {
    const out = document.createElement('select');
    out.name = name;
    for (const { panel, series } of this.channels) out.add(new Option(`${panel.title}: ${series.name}`));
    out.selectedIndex = chosen;
    out.addEventListener('change', () => this.refresh());
    return out;
  }

  private labelled(text: string, select: HTMLSelectElement): HTMLElement {
    const out = document.createElement('label');
    out.append(`${text} `, select);
    return out;
  }

  private chosen(select: HTMLSelectElement): Channel {
    return this.channels[select.selectedIndex];
  }

  private nameOf({ panel, series }: Channel): string {
    return `${panel.title}: ${series.name} [${this.unitOf(panel).name}]`;
  }

  private valueOf({ panel, series }: Channel, index: number): number {
    return inUnit(middleOf(series, index), this.unitOf(panel));
  }

  /** Stretches [from, to) that the plots above show. */
  private stretches(): [number, number] {
    const { times } = this.run;
    return [Math.max(0, times.countUntil(this.view.from) - 1), times.countUntil(this.view.to)];
  }

  private rangeOf(channel: Channel): [number, number] {
    let [lowest, highest] = [Infinity, -Infinity];
    const [from, to] = this.stretches();
    for (let k = from; k < to; ++k) {
      const value = this.valueOf(channel, k);
      if (value < lowest) lowest = value;
      if (value > highest) highest = value;
    }
    if (!(highest >= lowest)) return [0, 1];
    const margin = highest > lowest ? 0.05 * (highest - lowest) : 0.5;
    return [lowest - margin, highest + margin];
  }

  private made(width: number): uPlot {
    const plot = new uPlot({
      width,
      height,
      padding: [8, rightMargin, 0, 0],
      legend: { show: false },
      scales: { x: { time: false, auto: false }, y: { auto: false } },
      axes: [valueAxis(() => this.nameOf(this.chosen(this.across))), yAxis(height)],
      series: [{}, {}],
      cursor: { show: false },
      hooks: { draw: [(drawn) => this.drawLine(drawn)] },
    }, [[0, 1], [null, null]], this.place);
    plot.over.append(this.dot);
    return plot;
  }

  private drawLine(plot: uPlot): void {
    const { ctx, bbox } = plot;
    const [across, up] = [this.chosen(this.across), this.chosen(this.up)];
    const [from, to] = this.stretches();
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.strokeStyle = colour(up.series.tone);
    ctx.lineWidth = 1.2 * devicePixelRatio;
    ctx.lineJoin = 'round';
    ctx.beginPath();
    let broken = true;
    for (let k = from; k < to; ++k) {
      const [x, y] = [this.valueOf(across, k), this.valueOf(up, k)];
      if (Number.isNaN(x) || Number.isNaN(y)) {
        broken = true;
        continue;
      }
      const [left, top] = [plot.valToPos(x, 'x', true), plot.valToPos(y, 'y', true)];
      if (broken) ctx.moveTo(left, top);
      else ctx.lineTo(left, top);
      broken = false;
    }
    ctx.stroke();
    ctx.restore();
  }

  private showCursor(): void {
    if (!this.root.open || this.plot === null) return;
    const time = this.view.cursor ?? this.view.marks.b ?? this.view.marks.a;
    const index = time === null ? null : this.run.indexAt(time);
    const [x, y] = index === null ? [NaN, NaN] : [this.valueOf(this.chosen(this.across), index), this.valueOf(this.chosen(this.up), index)];
    this.dot.hidden = Number.isNaN(x) || Number.isNaN(y);
    if (this.dot.hidden) return;
    this.dot.style.left = `${this.plot.valToPos(x, 'x')}px`;
    this.dot.style.top = `${this.plot.valToPos(y, 'y')}px`;
  }
}
