/** One valve of the fleet: how it stands, its alarms and events, and hours and days of its record. */
import { AlarmList } from '../live/alarm_list';
import { clock, figure, signs, words, type Alarm } from '../live/api';
import { element, setText } from '../live/element';
import { EventList } from '../live/event_list';
import { HistoryView } from '../live/history_view';
import { readAlarms, readEvents, type FleetData } from './api';

export class ValveView {
  readonly place: HTMLElement;
  private readonly sign = element('span', 'sign');
  private readonly figures = element('p', 'figures');
  private readonly alarms = new AlarmList(() => true, 20, true);
  private readonly events = new EventList(50);
  private readonly history: HistoryView;
  private closed = false;

  constructor(private readonly id: string) {
    this.history = new HistoryView(id);
    this.place = element('div', '', element('h2', '', id, this.sign), this.figures, this.history.place,
                         element('h3', '', 'Alarms'), this.alarms.place, element('h3', '', 'Events'), this.events.place);
  }

  show(data: FleetData): void {
    const valve = data.valves.find((one) => one.id === this.id);
    if (valve === undefined) {
      setText(this.figures, 'The fleet knows no valve of this name.');
      return;
    }
    setText(this.sign, signs[valve.ne107]);
    this.sign.dataset['sign'] = valve.ne107;
    setText(this.figures, `${valve.series}; mean flow ${figure(valve.flow_L_min, 3)} L/min ` +
      `(${figure(valve.flow_lower_L_min, 3)} to ${figure(valve.flow_upper_L_min, 3)}) at ${clock(valve.time)}` +
      `${valve.silent ? ', silent since' : ''}; ${valve.status.length === 0 ? 'no status bits' : valve.status.map(words).join(', ')}; ` +
      `${valve.samples} samples`);
    this.history.follow();
    void Promise.all([readAlarms(this.id), readEvents(this.id)]).then(([alarms, events]: [Alarm[], Parameters<EventList['show']>[0]]) => {
      if (this.closed) return;
      this.alarms.show(alarms);
      this.events.show(events);
    }).catch(() => undefined);
  }
  resize(): void {
    this.history.resize();
  }
  recolour(): void {
    this.history.redraw();
  }
  close(): void {
    this.closed = true;
    this.history.close();
  }
}
