/** Flow, power and indicators of a valve over hours and days, from the store. */
import { grouped, inUnit, readFlow, readIndicators, Refusal, scaled, words, type FlowHistory, type Indicator, type IndicatorHistory } from './api';
import { element, setText } from './element';
import { HistoryPlot, withGaps, type Curve } from './history_plot';

const spans: [string, number][] = [['1 hour', 3600], ['1 day', 86400], ['1 week', 7 * 86400], ['30 days', 30 * 86400]];
const refresh_ms = 30000;
/** As the program thins them (addons/live/history/long_history.hpp). */
const mostPoints = 600;

function curveOf(one: IndicatorHistory, now: Indicator | undefined): Curve {
  const { factor, unit } = inUnit(one);
  const about = (sign: number): (number | null)[] => one.value.map((value, k) =>
    value === null ? null : factor * (value + sign * (one.uncertainty_95[k] ?? 0)));
  return {
    title: `${words(one.name)}${unit === '' ? '' : ` [${unit}]`}`,
    times: one.time_ms.map((time) => time / 1000),
    middle: one.value.map((value) => scaled(value, factor)),
    lower: about(-1),
    upper: about(1),
    usual: one.baseline.map((value) => scaled(value, factor)),
    raised: one.raised,
    alarmBelow: scaled(now?.alarm_below ?? null, factor),
    alarmAbove: scaled(now?.alarm_above ?? null, factor),
  };
}

function flowCurve(flow: FlowHistory): Curve {
  return {
    title: 'mean flow [L/min]',
    times: flow.time_ms.map((time) => time / 1000),
    middle: flow.flow_mean_L_min, lower: flow.flow_lower_L_min, upper: flow.flow_upper_L_min,
    usual: null, raised: flow.time_ms.map(() => false), alarmBelow: null, alarmAbove: null,
  };
}

function powerCurve(flow: FlowHistory): Curve {
  return {
    title: 'hydraulic power through the edge [W]',
    times: flow.time_ms.map((time) => time / 1000),
    middle: flow.power_W, lower: flow.power_W, upper: flow.power_W,
    usual: null, raised: flow.time_ms.map(() => false), alarmBelow: null, alarmAbove: null,
  };
}

export class HistoryView {
  readonly place = element('section', 'days');
  private readonly plots = new Map<string, HistoryPlot>();
  private readonly grid = element('div', 'plots');
  private readonly said = element('p', 'soft');
  private readonly choice = element('select', '');
  private asked = -Infinity;
  private waiting = 0;  // for answers
  private closed = false;
  /** As they are now, with their limits. */
  private indicators: readonly Indicator[] = [];
  /** Whether the span is the reader's, or was found to fit. */
  private chosen = false;

  constructor(private readonly id: string) {
    for (const [text, seconds] of spans) this.choice.add(new Option(text, String(seconds)));
    this.choice.value = '86400';
    this.choice.addEventListener('change', () => {
      this.chosen = true;
      void this.ask();
    });
    this.place.append(element('h3', '', 'Hours and days'), element('label', '', 'Span ', this.choice), this.said, this.grid);
  }

  /** Asks again now and then. */
  follow(indicators: readonly Indicator[] = []): void {
    this.indicators = indicators;
    if (this.waiting === 0 && performance.now() - this.asked > refresh_ms) void this.ask();
  }
  resize(): void {
    for (const plot of this.plots.values()) plot.resize();
  }
  redraw(): void {
    for (const plot of this.plots.values()) plot.redraw();
  }
  close(): void {
    this.closed = true;
    for (const plot of this.plots.values()) plot.destroy();
  }

  private async ask(): Promise<void> {
    this.asked = performance.now();
    this.waiting += 1;
    const seconds = Number(this.choice.value);
    try {
      const [flow, indicators] = await Promise.all([readFlow(this.id, seconds), readIndicators(this.id, seconds)]);
      if (this.closed || seconds !== Number(this.choice.value)) return;
      const oldest = Math.min(...flow.time_ms, ...indicators.flatMap((one) => one.time_ms));
      if (!this.chosen && seconds > 3600 && Date.now() - oldest < 7.2e6) {  // a store that has just begun
        this.choice.value = '3600';
        this.chosen = true;
        void this.ask();
        return;
      }
      this.chosen = true;
      this.show(seconds, flow, indicators);
    } catch (error) {
      setText(this.said, error instanceof Refusal ? error.message : 'The program does not answer.');
    } finally {
      this.waiting -= 1;
    }
  }

  private show(seconds: number, flow: FlowHistory, indicators: IndicatorHistory[]): void {
    const now = Date.now() / 1000;
    const oldest = Math.min(...flow.time_ms, ...indicators.flatMap((one) => one.time_ms)) / 1000;
    const from = Math.max(now - seconds, Math.min(now - 120, oldest - 0.02 * (now - oldest)));
    const curves: [string, Curve, number][] = [];
    if (flow.time_ms.length > 0) curves.push(['flow', flowCurve(flow), 1], ['power', powerCurve(flow), 1]);
    const { shown, more } = grouped(this.indicators), order = [...shown, ...more].map((one) => one.name);
    const place = (name: string): number => (order.indexOf(name) + order.length + 1) % (order.length + 1);
    for (const one of [...indicators].sort((a, b) => place(a.name) - place(b.name))) {
      const now = this.indicators.find((each) => each.name === one.name);
      if (one.value.some((value) => value !== null)) curves.push([one.name, curveOf(one, now), 60]);
    }
    setText(this.said, curves.length > 0 ? 'Shaded: the 95 % band (of the flow its outermost ends); dashed: baseline; red dots: values beyond count towards an alarm; red bar: raised. Drag to zoom, double click to come back; by keyboard plus, minus, arrows and 0.'
      : 'Nothing is kept of this time. Indicators are kept once a minute where the program has a store.');
    for (const [name, plot] of this.plots) {
      if (curves.some(([own]) => own === name)) continue;
      plot.destroy();
      plot.place.remove();
      this.plots.delete(name);
    }
    for (const [name, curve, step_s] of curves) {
      let plot = this.plots.get(name);
      if (plot === undefined) {
        plot = new HistoryPlot(`days-${this.id}`);
        this.plots.set(name, plot);
        this.grid.append(plot.place);
      }
      plot.show(withGaps(curve, 3 * Math.max(step_s, seconds / mostPoints)), from, now);
    }
  }
}
