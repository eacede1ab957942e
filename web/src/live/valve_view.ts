/** One valve: its plot as it comes, what its monitor says, and how its source fares. */
import { figure, readRecordings, short, signs, type SiteEvent, type Valve } from './api';
import { element, row, setText } from './element';
import { showEvents } from './overview';
import { Plot } from './plot';
import { Stream } from './stream';

const staleAfter_ms = 1500;

export class ValveView {
  readonly place = element('div', '');
  private readonly plot = new Plot();
  private readonly stream: Stream;
  private readonly sign = element('span', 'sign');
  private readonly figures = element('p', 'figures');
  private readonly status = element('p', 'status');
  private readonly causes = element('p', 'causes');
  private readonly stale = element('p', 'stale', 'No new samples: what is shown is old.');
  private readonly indicators = element('tbody', '');
  private readonly source = element('p', 'source');
  private readonly events = element('ul', 'events');
  private readonly recordings = element('ul', 'events');
  private frame = 0;
  private asked = -Infinity;
  private readonly watch: number;

  constructor(private readonly id: string) {
    const head = element('thead', '', row('th', 'indicator', 'value', '± (95 %)', 'baseline', 'unit', 'state'));
    this.place.append(element('h2', '', id, ' ', this.sign), this.figures, this.status, this.causes, this.stale, this.plot.canvas,
                      element('h3', '', 'Indicators'), element('div', 'wide', element('table', '', head, this.indicators)),
                      element('h3', '', 'Source'), this.source, element('h3', '', 'Events'), this.events,
                      element('h3', '', 'Raw samples around alarms'), this.recordings);
    this.stale.hidden = true;
    this.stream = new Stream(id, () => this.redraw());
    this.watch = window.setInterval(() => {
      this.stale.hidden = performance.now() - this.stream.arrived < staleAfter_ms;
      this.plot.canvas.classList.toggle('old', !this.stale.hidden);
    }, 250);
  }

  close(): void {
    this.stream.close();
    clearInterval(this.watch);
    cancelAnimationFrame(this.frame);
  }

  redraw(): void {
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => this.plot.draw(this.stream.points));
  }

  show(valves: readonly Valve[], events: readonly SiteEvent[]): void {
    const valve = valves.find((one) => one.id === this.id);
    if (valve === undefined) {
      setText(this.figures, 'There is no valve of this name at this site.');
      return;
    }
    setText(this.sign, signs[valve.ne107]);
    this.sign.dataset['sign'] = valve.ne107;
    setText(this.figures, `${figure(valve.flow_L_min, 3)} L/min (95 %: ${figure(valve.flow_lower_L_min, 3)} to ` +
      `${figure(valve.flow_upper_L_min, 3)}), ${figure(valve.pressure_difference_bar, 1)} bar; ` +
      `${valve.samples.toLocaleString('en')} samples, ${figure((valve.energy_J ?? 0) / 3.6e6, 4)} kWh through the edge`);
    setText(this.status, valve.status.length > 0 ? `Status: ${valve.status.join(', ')}` : 'Status: all is well');
    setText(this.causes, valve.causes.length > 0
      ? `Likely: ${valve.causes.map((one) => `${one.cause.replace(/_/g, ' ')} (odds ${short(one.odds)})`).join(', ')}` : '');
    this.indicators.replaceChildren(...valve.indicators.map((one) => {
      const line = row('td', one.name.replace(/_/g, ' '), short(one.value), short(one.uncertainty_95), short(one.baseline),
                       one.unit, one.state);
      line.dataset['state'] = one.state;
      return line;
    }));
    const of = valve.source;
    setText(this.source, `${of.kind}${of.port === undefined ? '' : `, port ${of.port}`}: ${of.received} samples received, ` +
      `${of.dropped} dropped, ${of.lost} lost, ${of.repeated} repeated, ${of.unreadable} unreadable lines, ` +
      `${of.connections} connections${of.trouble === '' ? '' : `; ${of.trouble}`}`);
    showEvents(this.events, events.filter((event) => event.valve === this.id).slice(0, 50));
    if (performance.now() - this.asked > 5000) void this.showRecordings();
  }

  private async showRecordings(): Promise<void> {
    this.asked = performance.now();
    const own = (await readRecordings().catch(() => [])).filter((one) => one.valve === this.id).slice(0, 20);
    this.recordings.replaceChildren(...(own.length > 0 ? own.map((one) => {
      const link = element('a', '', `${one.time.replace('T', ' ').slice(0, 19)} UTC  ${one.why}`);
      link.href = `/api/v1/recordings/${one.id}.csv`;
      link.download = `${one.valve}_${one.id}.csv`;
      return element('li', '', link);
    }) : [element('li', '', 'none')]));
  }
}
