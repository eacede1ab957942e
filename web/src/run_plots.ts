/** The linked plots of one run, in place of its static figure. */
import { Chart } from './chart';
import { bindKeys, keysText } from './keyboard';
import { Readout, statusText } from './readout';
import { runOf, type PackedRun, type Run } from './run_data';
import { StatusChart } from './status_chart';
import { onThemeChange } from './theme';
import { numberText } from './number_text';
import type { ReadersUnits } from './readers_units';
import { View } from './view';

function element<Name extends keyof HTMLElementTagNameMap>(name: Name, className: string): HTMLElementTagNameMap[Name] {
  const out = document.createElement(name);
  out.className = className;
  return out;
}

function button(text: string, label: string, act: () => void): HTMLButtonElement {
  const out = element('button', 'tool');
  out.type = 'button';
  out.textContent = text;
  out.setAttribute('aria-label', label);
  out.title = label;
  out.addEventListener('click', act);
  return out;
}

export class RunPlots {
  readonly run: Run;
  readonly view: View;
  private readonly root = element('div', 'live');
  private readonly area = element('div', 'plots');
  private readonly clock = element('output', 'clock');
  private readonly spoken = element('p', 'unseen');
  private readonly charts: { chart: Chart; readout: Readout }[] = [];
  private readonly statusNow = element('output', 'status-now');
  private statusChart: StatusChart | null = null;
  private width: number;

  constructor(private readonly figure: HTMLElement, private readonly units: ReadersUnits) {
    const data = figure.querySelector('script[type="application/json"]') as HTMLScriptElement;
    this.run = runOf(JSON.parse(data.textContent as string) as PackedRun);
    data.remove();
    const { times } = this.run;
    const first = times.at(0);
    const last = times.at(times.length - 1);
    this.view = new View(first, last, (last - first) / Math.max(1, times.length - 1));
    this.root.append(this.toolbar(), this.area, this.spoken);
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

  /** The stretch at the cursor. */
  private index(): number | null {
    if (this.view.cursor === null) return null;
    return this.run.times.indexAt(this.view.cursor, this.run.samplesPerStretch === 1);
  }

  /** The time of the stretch `by` steps from the cursor; where many lie in a pixel, pixels are the steps. */
  private neighbour(by: number): number {
    const { times } = this.run;
    const now = this.view.cursor ?? 0.5 * (this.view.from + this.view.to);
    const index = times.indexAt(now, this.run.samplesPerStretch === 1);
    const next = times.at(Math.min(times.length - 1, Math.max(0, index + by)));
    const pixel = (this.view.to - this.view.from) / Math.max(1, this.width);
    return Math.abs(next - now) < pixel * Math.abs(by) ? now + by * pixel : next;
  }

  private toolbar(): HTMLElement {
    const out = element('div', 'tools');
    out.append(
      button('+', 'Zoom in', () => this.view.zoomBy(0.5)), button('−', 'Zoom out', () => this.view.zoomBy(2)),
      button('◀', 'Earlier', () => this.view.moveBy(-0.25)), button('▶', 'Later', () => this.view.moveBy(0.25)),
      button('Whole run', 'Show the whole run', () => this.view.reset()), this.clock);
    const hint = element('span', 'hint');
    hint.textContent = 'Drag to zoom, double click for the whole run.';
    out.append(hint);
    return out;
  }

  private addCharts(): void {
    const { run, view } = this;
    run.panels.forEach((panel, p) => {
      const last = p + 1 === run.panels.length && !run.status;
      const readout = new Readout(panel, (series, shown) => chart.toggle(series, shown));
      const place = element('div', 'chart');
      this.area.append(readout.element, place);
      const unit = this.units.unitOf(panel.quantity, run.fullScale);
      const chart = new Chart(run, panel, view, unit, place, this.width, last);
      this.charts.push({ chart, readout });
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
      const unit = this.units.unitOf(chart.panel.quantity, this.run.fullScale);
      chart.refresh(unit, this.width);
      readout.showUnit(unit);
    }
    this.statusChart?.refresh(this.width);
    this.figure.dataset.from = String(this.view.from);
    this.figure.dataset.to = String(this.view.to);
    this.showCursor();
  }

  private redraw(): void {
    for (const { chart } of this.charts) chart.plot.redraw();
    this.statusChart?.plot.redraw();
  }

  private timeText(index: number): string {
    return `t = ${numberText(this.run.times.at(index), 4)} s`;
  }

  private showCursor(): void {
    const index = this.index();
    for (const { chart, readout } of this.charts) {
      chart.showCursor();
      readout.show(index, this.units.unitOf(chart.panel.quantity, this.run.fullScale));
    }
    this.statusChart?.showCursor();
    this.clock.textContent = index === null ? '' : this.timeText(index);
    this.statusNow.textContent = index === null ? '' : statusText(this.run, index);
  }

  private speak(): void {
    const index = this.index();
    if (index === null) return;
    const values = this.charts.map(({ chart, readout }) =>
      readout.sentence(index, this.units.unitOf(chart.panel.quantity, this.run.fullScale)));
    this.spoken.textContent = `${this.timeText(index)}; ${values.join('; ')}; status ${statusText(this.run, index)}`;
  }
}
