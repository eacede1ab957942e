/** Flow, power and indicators of a valve over hours and days, from the store. */
import { grouped, inUnit, readFlow, readIndicators, Refusal, scaled, words, type FlowHistory, type Indicator, type IndicatorHistory } from './api';
import { element, setText } from './element';
import { HistoryPlot, withGaps, type Curve } from './history_plot';
import { RangeControl, type Asked } from './range_control';

const refresh_ms = 30000, again_ms = 3000;
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

/** Of a figure that the valve beside has alone. */
const nothing = (like: Curve): Curve =>
  ({ title: like.title, times: [], middle: [], lower: [], upper: [], usual: null, raised: [], alarmBelow: null, alarmAbove: null });

/** All that is kept of a valve in a time, by name, each with the seconds between its rows. */
function curvesOf(flow: FlowHistory, indicators: readonly IndicatorHistory[], now: readonly Indicator[]): Map<string, [Curve, number]> {
  const out = new Map<string, [Curve, number]>();
  if (flow.time_ms.length > 0) out.set('flow', [flowCurve(flow), 1]).set('power', [powerCurve(flow), 1]);
  for (const one of indicators) {
    if (!one.value.some((value) => value !== null)) continue;
    out.set(one.name, [curveOf(one, now.find((each) => each.name === one.name)), 60]);
  }
  return out;
}

interface Read {
  flow: FlowHistory;
  indicators: IndicatorHistory[];
}
async function readBoth(id: string, { from, to }: Asked): Promise<Read> {
  // One after the other: the program has few seats for those who read much.
  const flow = await readFlow(id, from, to);
  return { flow, indicators: await readIndicators(id, from, to) };
}

export class HistoryView {
  readonly place = element('section', 'days');
  private readonly plots = new Map<string, HistoryPlot>();
  private readonly grid = element('div', 'plots');
  private readonly said = element('p', 'soft');
  private readonly legend = element('p', 'legend');
  private readonly range: RangeControl;
  private last = -Infinity;
  private waiting = 0;  // for answers
  private answered = false;
  private closed = false;
  /** As they are now, with their limits. */
  private indicators: readonly Indicator[] = [];

  constructor(private readonly id: string) {
    this.range = new RangeControl(id, () => void this.ask());
    this.legend.hidden = true;
    this.place.append(element('h3', '', 'Hours and days'), this.range.place, this.said, this.legend, this.grid);
  }

  /** Asks again now and then. `others`: valves that may be shown beside. */
  follow(indicators: readonly Indicator[] = [], others: readonly string[] = []): void {
    this.indicators = indicators;
    this.range.offer(others);
    const stands = this.answered && this.range.asked()?.moves === false;
    if (!stands && this.waiting === 0 && performance.now() - this.last > (this.answered ? refresh_ms : again_ms)) void this.ask();
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
    const asked = this.range.asked();
    if (asked === null) return;
    this.last = performance.now();
    this.waiting += 1;
    this.answered = false;
    const mine = this.last;
    try {
      const read = await readBoth(this.id, asked);
      const beside = asked.beside === null ? null : await readBoth(asked.beside, asked);
      if (this.closed || mine !== this.last) return;
      const oldest = Math.min(...read.flow.time_ms, ...read.indicators.flatMap((one) => one.time_ms));
      if (!this.range.chosen && asked.to - asked.from > 3600 && Date.now() - oldest < 7.2e6) {  // a store that has just begun
        this.range.shorten();
        this.range.chosen = true;
        void this.ask();
        return;
      }
      this.range.chosen = true;
      this.answered = true;
      this.show(asked, read, beside);
    } catch (error) {
      setText(this.said, error instanceof Refusal ? error.message : 'The program does not answer.');
    } finally {
      this.waiting -= 1;
    }
  }

  private show(asked: Asked, read: Read, beside: Read | null): void {
    const all = [read, ...(beside === null ? [] : [beside])];
    const oldest = Math.min(...all.flatMap((one) => [...one.flow.time_ms, ...one.indicators.flatMap((each) => each.time_ms)])) / 1000;
    const from = asked.moves ? Math.max(asked.from, Math.min(asked.to - 120, oldest - 0.02 * (asked.to - oldest))) : asked.from;
    this.range.show(asked);
    const curves = curvesOf(read.flow, read.indicators, this.indicators);
    const others = beside === null ? null : curvesOf(beside.flow, beside.indicators, []);
    const { shown, more } = grouped(this.indicators), order = ['flow', 'power', ...[...shown, ...more].map((one) => one.name)];
    const names = [...new Set([...curves.keys(), ...(others?.keys() ?? [])])];
    const place = (name: string): number => (order.indexOf(name) + order.length + 1) % (order.length + 1);
    names.sort((a, b) => place(a) - place(b));
    setText(this.said, names.length > 0 ? 'Shaded: the 95 % band (of the flow its outermost ends); dashed: baseline; red dots: values beyond count towards an alarm; red bar: raised. Drag to zoom, double click to come back; by keyboard plus, minus, arrows and 0.'
      : 'Nothing is kept of this time. Indicators are kept once a minute where the program has a store.');
    this.legend.hidden = asked.beside === null;
    this.legend.replaceChildren(element('span', 'first', this.id), ' ', element('span', 'second', asked.beside ?? ''));
    for (const [name, plot] of this.plots) {
      if (names.includes(name)) continue;
      plot.destroy();
      plot.place.remove();
      this.plots.delete(name);
    }
    for (const name of names) {
      let plot = this.plots.get(name);
      if (plot === undefined) {
        plot = new HistoryPlot(`days-${this.id}`);
        this.plots.set(name, plot);
        this.grid.append(plot.place);
      }
      const [curve, step_s] = curves.get(name) ?? others!.get(name)!;
      const whole = (one: Curve): Curve => withGaps(one, 3 * Math.max(step_s, (asked.to - asked.from) / mostPoints));
      const second = others?.get(name)?.[0];
      plot.show(curves.has(name) ? whole(curve) : nothing(curve), from, asked.to, second === undefined ? null : { name: asked.beside!, curve: whole(second) });
    }
  }
}
