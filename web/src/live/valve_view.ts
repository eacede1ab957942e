/** One valve: its plot as it comes, what its monitor says, days of it, and how its source fares. */
import { AlarmList } from './alarm_list';
import {
  causesText, clock, duration, figure, grouped, inUnit, readRecordings, rivalText, scaled, short, signs, trendText, words, type Alarm, type Indicator, type LiveData,
  type Valve,
} from './api';
import { element, row, setText } from './element';
import { EventList } from './event_list';
import { HistoryView } from './history_view';
import { ModelView } from './model_view';
import { Plot } from './plot';
import { Stream } from './stream';

const staleAfter_ms = 1500;

/** Each cell has its column's name, which narrow screens show in front of it. */
function indicatorRow(one: Indicator): HTMLElement {
  const { factor, unit } = inUnit(one), value = (each: number | null | undefined): string => short(scaled(each ?? null, factor));
  const ends = [one.alarm_below, one.alarm_above].flatMap((end, k) => end == null ? [] : [`${k === 0 ? '<' : '>'} ${value(end)}`]);
  const line = row('td', words(one.name), value(one.value), value(one.uncertainty_95), value(one.baseline), ends.join(', '), unit,
                   one.state, trendText(one));
  ['', '', '±', 'usual', 'alarm', '', '', ''].forEach((name, k) => {
    if (name !== '') (line.children[k] as HTMLElement).dataset['name'] = name;
  });
  line.dataset['state'] = one.state;
  return line;
}

export class ValveView {
  readonly place = element('div', '');
  private readonly plot = new Plot();
  private readonly stream: Stream;
  private readonly sign = element('span', 'sign');
  private readonly figures = element('p', 'figures');
  private readonly status = element('p', 'status');
  private readonly causes = element('p', 'causes');
  private readonly findings = element('ul', 'findings stale');
  private readonly stale = element('p', 'stale', 'No new samples: what is shown is old.');
  private readonly age = element('p', 'soft');
  private readonly alarms: AlarmList;
  private readonly indicators = element('tbody', '');
  private readonly more = element('tbody', '');
  private readonly counters = element('dl', 'counters');
  private readonly days: HistoryView;
  private readonly source = element('p', 'source');
  private readonly events = new EventList(50);
  private readonly recordings = element('ul', 'events');
  private frame = 0;
  private asked = -Infinity;
  /** When the program had the last sample [ms of performance.now()]. */
  private lastSample: number | null = null;
  private readonly watch: number;

  constructor(private readonly id: string) {
    this.alarms = new AlarmList((alarm) => alarm.valve === id && alarm.state !== 'cleared');
    this.days = new HistoryView(id);
    const table = (body: HTMLElement): HTMLElement => element('div', 'wide', element('table', 'indicators stacked', element(
      'thead', '', row('th', 'indicator', 'value', '± (95 %)', 'baseline', 'alarm beyond', 'unit', 'state', 'trend')), body));
    this.place.append(element('h2', '', id, ' ', this.sign), this.figures, this.status, this.causes, this.findings, this.alarms.place, this.stale, this.age,
                      this.plot.canvas, element('h3', '', 'Indicators'),
                      table(this.indicators),
                      element('details', '', element('summary', 'soft', 'more indicators'), table(this.more)),
                      element('h3', '', 'Counters'), this.counters, this.days.place,
                      new ModelView(id).place, element('h3', '', 'Source'), this.source, element('h3', '', 'Raw samples around alarms'), this.recordings,
                      element('h3', '', 'Events'), this.events.place);
    this.stale.hidden = true;
    this.stale.setAttribute('role', 'status');
    this.age.hidden = true;
    this.stream = new Stream(id, () => this.redraw());
    this.watch = window.setInterval(() => {
      this.stale.hidden = performance.now() - this.stream.arrived < staleAfter_ms;
      for (const each of [this.plot.canvas, this.figures, this.status, this.sign]) each.classList.toggle('old', !this.stale.hidden);
      this.age.hidden = this.stale.hidden || this.lastSample === null;
      const age = this.age.hidden ? '' : duration((performance.now() - this.lastSample!) / 1000);
      setText(this.age, `The last sample came ${age} ago.`);
      if (age === this.plot.age) return;
      this.plot.age = age;
      this.redraw();
    }, 250);
  }

  close(): void {
    this.stream.close();
    this.days.close();
    clearInterval(this.watch);
    cancelAnimationFrame(this.frame);
  }

  redraw(): void {
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => this.plot.draw(this.stream.points));
  }
  resize(): void {
    this.redraw();
    this.days.resize();
  }
  recolour(): void {
    this.redraw();
    this.days.redraw();
  }

  show({ valves, events, alarms, site }: LiveData): void {
    const valve = valves.find((one) => one.id === this.id);
    if (valve === undefined) {
      setText(this.figures, 'There is no valve of this name at this site.');
      return;
    }
    this.showAnswer(valve, alarms);
    this.plot.bits = Object.entries(site.status_bits).map(([name, mask]) => ({ name, mask }));
    const { shown, more, counters } = grouped(valve.indicators);
    this.indicators.replaceChildren(...shown.map(indicatorRow));
    this.more.replaceChildren(...more.map(indicatorRow));
    this.counters.replaceChildren(...counters.map((one) => {
      const { factor, unit } = inUnit(one);
      return element('div', '', element('dt', '', words(one.name)), element('dd', '', `${short(scaled(one.value, factor))} ${unit}`));
    }));
    const of = valve.source;
    this.lastSample = of.age_s === null ? null : performance.now() - 1000 * of.age_s;
    setText(this.source, `${of.kind}${of.port === undefined ? '' : `, port ${of.port}`}: ${of.received} samples received, ` +
      `${of.dropped} dropped, ${of.lost} lost, ${of.repeated} repeated, ${of.unreadable} unreadable lines, ` +
      `${of.connections} connections${of.trouble === '' ? '' : `; ${of.trouble}`}`);
    this.alarms.follow(valves);
    this.alarms.show(alarms);
    this.events.show(events.filter((event) => event.valve === this.id));
    this.days.follow(valve.indicators, valves.map((one) => one.id));
    if (performance.now() - this.asked > 5000) void this.showRecordings();
  }

  private showAnswer(valve: Valve, alarms: readonly Alarm[]): void {
    setText(this.sign, signs[valve.ne107]);
    this.sign.dataset['sign'] = valve.ne107;
    const power = valve.flow_L_min === null || valve.pressure_difference_bar === null ? null
      : Math.abs(valve.flow_L_min) * valve.pressure_difference_bar / 600;  // L/min times bar in kW
    setText(this.figures, `${figure(valve.flow_L_min, 2)} L/min (95 %: ${figure(valve.flow_lower_L_min, 2)} to ` +
      `${figure(valve.flow_upper_L_min, 2)}), ${figure(valve.pressure_difference_bar, 1)} bar, ${figure(power, 3)} kW; ` +
      `${valve.samples.toLocaleString('en')} samples, ${figure((valve.energy_J ?? 0) / 3.6e6, 4)} kWh through the edge`);
    setText(this.status, valve.status.length > 0 ? `Status: ${valve.status.map(words).join(', ')}` : 'Status: all is well');
    setText(this.causes, causesText(valve, alarms));
    this.causes.hidden = this.causes.textContent === '';
    const rival = rivalText(valve);
    const found = [...valve.findings.map((one) => `Its samples: ${one}`), ...(rival === '' ? [] : [`Its source: ${rival}`])];
    this.findings.replaceChildren(...found.map((one) => element('li', '', one)));
    this.findings.hidden = found.length === 0;
  }

  private async showRecordings(): Promise<void> {
    this.asked = performance.now();
    const own = (await readRecordings().catch(() => [])).filter((one) => one.valve === this.id).slice(0, 20);
    this.recordings.replaceChildren(...(own.length > 0 ? own.map((one) => {
      const link = element('a', '', `${clock(one.time)}  ${one.why}`);
      link.href = `/api/v1/recordings/${one.id}.csv`;
      link.download = `${one.valve}_${one.id}.csv`;
      return element('li', '', link);
    }) : [element('li', 'soft', 'none')]));
  }
}
