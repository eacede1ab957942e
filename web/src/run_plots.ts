/** The linked plots of one run, in place of its static figure. */
import { Chart } from './chart';
import { button, element } from './element';
import { bindKeys, keysText } from './keyboard';
import { Readout, statusText } from './readout';
import { runOf, type PackedRun, type Panel, type Run, type Series } from './run_data';
import { StatusChart } from './status_chart';
import { onThemeChange } from './theme';
import { numberText } from './number_text';
import type { ReadersUnits } from './readers_units';
import type { Unit } from './units';
import { fileName, save } from './saved_file';
import { pictureOf, type PicturePart } from './picture';
import { View } from './view';
import { visibleCsv, type ShownPanel } from './visible_data';
import { XyPlot } from './xy_plot';

export class RunPlots {
  readonly run: Run;
  readonly view: View;
  private readonly root = element('div', 'live');
  private readonly area = element('div', 'plots');
  private readonly clock = element('output', 'clock');
  private readonly spoken = element('p', 'unseen');
  private readonly charts: { chart: Chart; readout: Readout; place: HTMLElement }[] = [];
  private readonly statusNow = element('output', 'status-now');
  private statusChart: StatusChart | null = null;
  private readonly xy: XyPlot;
  private width: number;

  constructor(private readonly figure: HTMLElement, private readonly units: ReadersUnits) {
    const data = figure.querySelector('script[type="application/json"]') as HTMLScriptElement;
    this.run = runOf(JSON.parse(data.textContent as string) as PackedRun);
    data.remove();
    const { times } = this.run;
    const first = times.at(0);
    const last = times.at(times.length - 1);
    this.view = new View(first, last, (last - first) / Math.max(1, times.length - 1));
    this.xy = new XyPlot(this.run, this.view, (panel) => this.unitOf(panel));
    this.root.append(this.toolbar(), this.area, this.spoken, this.xy.root);
    figure.prepend(this.root);
    this.width = this.area.clientWidth;
    this.area.tabIndex = 0;
    this.area.setAttribute('role', 'application');
    this.area.setAttribute('aria-label', `Linked plots over time of run ${this.run.name}. ${keysText}`);
    this.spoken.setAttribute('aria-live', 'polite');
    this.clock.setAttribute('aria-live', 'off');
    this.addCharts();
    bindKeys(this.area, this.view, (by) => this.neighbour(by), () => this.speak());
    this.view.onRange(() => this.refresh());
    this.view.onCursor(() => this.showCursor());
    this.view.onMarks(() => {
      this.redraw();
      this.showCursor();
    });
    units.onChange(() => this.refresh());
    onThemeChange(() => this.redraw());
    new ResizeObserver(() => {
      if (this.area.clientWidth === this.width || this.area.clientWidth === 0) return;
      this.width = this.area.clientWidth;
      this.refresh();
    }).observe(this.area);
    this.area.addEventListener('mouseleave', () => this.view.putCursor(null));
    this.refresh();
    figure.classList.add('is-live');
  }

  private unitOf(panel: Panel): Unit {
    return this.units.unitOf(panel.quantity, this.run.fullScale);
  }

  /** The stretch at the cursor; without one that at cursor B or A. */
  private index(): number | null {
    const time = this.view.cursor ?? this.view.marks.b ?? this.view.marks.a;
    return time === null ? null : this.run.indexAt(time);
  }

  /** The stretch at cursor A, where what is shown stands elsewhere. */
  private differenceFrom(index: number | null): number | null {
    const { a } = this.view.marks;
    const from = a === null ? null : this.run.indexAt(a);
    return from === index ? null : from;
  }

  /** The time of the stretch `by` steps from the cursor; where many lie in a pixel, pixels are the steps. */
  private neighbour(by: number): number {
    const { times } = this.run;
    const now = this.view.cursor ?? 0.5 * (this.view.from + this.view.to);
    const index = this.run.indexAt(now);
    const next = times.at(Math.min(times.length - 1, Math.max(0, index + by)));
    const pixel = (this.view.to - this.view.from) / Math.max(1, this.width);
    return Math.abs(next - now) < pixel * Math.abs(by) ? now + by * pixel : next;
  }

  private toolbar(): HTMLElement {
    const out = element('div', 'tools');
    out.append(
      button('+', 'Zoom in', () => this.view.zoomBy(0.5)), button('−', 'Zoom out', () => this.view.zoomBy(2)),
      button('◀', 'Earlier', () => this.view.moveBy(-0.25)), button('▶', 'Later', () => this.view.moveBy(0.25)),
      button('Whole run', 'Show the whole run', () => this.view.reset()),
      button('PNG', 'Save the plots as a picture (PNG)', () => this.savePicture()),
      button('CSV', 'Save the visible data (CSV)', () => this.saveData()), this.clock);
    const hint = element('span', 'hint');
    hint.textContent = 'Drag across for time, up or down for values; double click: whole run. Click twice: cursors A and B, a third time begins again.';
    out.append(hint);
    return out;
  }

  private addCharts(): void {
    const { run, view } = this;
    run.panels.forEach((panel, p) => {
      const last = p + 1 === run.panels.length && !run.status;
      const readout = new Readout(panel, {
        toggle: (series, shown) => {
          chart.toggle(series, shown);
          place.hidden = chart.empty && !last;
        },
        zoomHeightBy: (factor) => chart.zoomHeightBy(factor),
      });
      const place = element('div', 'chart');
      this.area.append(readout.element, place);
      const chart = new Chart(run, panel, view, this.unitOf(panel), place, this.width, last);
      this.charts.push({ chart, readout, place });
    });
    if (!run.status) return;
    const title = element('div', 'readout');
    const name = document.createElement('b');
    name.textContent = run.status.title;
    this.statusNow.setAttribute('aria-live', 'off');
    title.append(name, this.statusNow);
    const place = element('div', 'chart');
    this.area.append(title, place);
    this.statusChart = new StatusChart(run, run.status, view, place, this.width);
  }

  private refresh(): void {
    for (const { chart, readout } of this.charts) {
      const unit = this.unitOf(chart.panel);
      chart.refresh(unit, this.width);
      readout.showUnit(unit);
    }
    this.statusChart?.refresh(this.width);
    this.figure.dataset.from = String(this.view.from);
    this.figure.dataset.to = String(this.view.to);
    this.xy.refresh();
    this.showCursor();
  }

  private shown(): { place: HTMLElement; chart: Chart; series: Series[] }[] {
    return this.charts.map(({ place, chart }) => ({ place, chart, series: chart.panel.series.filter((each) => chart.isShown(each)) }));
  }

  private saveData(): void {
    const shown: ShownPanel[] = this.shown().map(({ chart: { panel }, series }) => ({ panel, unit: this.unitOf(panel), series }));
    const text = visibleCsv(this.run, shown, this.view.from, this.view.to);
    save(new Blob([text], { type: 'text/csv;charset=utf-8' }), fileName(this.run.name, 'data.csv'));
  }

  private savePicture(): void {
    const parts: PicturePart[] = this.shown().filter(({ place }) => !place.hidden).map(({ chart, series }) => (
      { title: `${chart.panel.title} [${this.unitOf(chart.panel).name}]`, series, canvas: chart.plot.ctx.canvas }));
    if (this.run.status && this.statusChart) {
      parts.push({ title: this.run.status.title, series: [], canvas: this.statusChart.plot.ctx.canvas });
    }
    if (this.xy.canvas) parts.push({ title: this.xy.title, series: [], canvas: this.xy.canvas });
    const index = this.index();
    const cursors = index === null ? '' : `; ${this.timeText(index, this.differenceFrom(index))}`;
    pictureOf(`Run ${this.run.name}${cursors}`, parts).toBlob((picture) => {
      if (picture) save(picture, fileName(this.run.name, 'plots.png'));
    }, 'image/png');
  }

  private redraw(): void {
    for (const { chart } of this.charts) chart.plot.redraw();
    this.statusChart?.plot.redraw();
    this.xy.refresh();
  }

  private timeText(index: number, from: number | null): string {
    const { times } = this.run;
    const now = `t = ${numberText(times.at(index), 4)} s`;
    if (from === null) return now;
    const step = times.at(index) - times.at(from);
    return `${now}, Δt = ${numberText(step, 4)} s from A (${numberText(1 / Math.abs(step), 3)} Hz)`;
  }

  private showCursor(): void {
    const index = this.index();
    const from = index === null ? null : this.differenceFrom(index);
    for (const { chart, readout } of this.charts) {
      chart.showCursor();
      readout.show(index, from, this.unitOf(chart.panel));
    }
    this.statusChart?.showCursor();
    this.clock.textContent = index === null ? '' : this.timeText(index, from);
    this.statusNow.textContent = index === null ? '' : statusText(this.run, index);
  }

  private speak(): void {
    const index = this.index();
    if (index === null) return;
    const from = this.differenceFrom(index);
    const values = this.charts.map(({ chart, readout }) => readout.sentence(index, from, this.unitOf(chart.panel)));
    this.spoken.textContent = `${this.timeText(index, from)}; ${values.join('; ')}; status ${statusText(this.run, index)}`;
  }
}
