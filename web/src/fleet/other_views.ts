/** Alarms of all sites, and which worker has which partition. */
import { AlarmList } from '../live/alarm_list';
import { element, row, setText } from '../live/element';
import { readPartitions, type FleetData } from './api';

export class AlarmsView {
  readonly place = element('div', '', element('h2', '', 'Alarms'));
  private readonly wanted = element('input', '');
  private list: AlarmList;
  private data: FleetData | null = null;

  constructor() {
    this.wanted.type = 'search';
    this.wanted.placeholder = 'valve or cause';
    this.list = new AlarmList((alarm) => {
      const asked = this.wanted.value.trim().toLowerCase();
      return asked === '' || `${alarm.valve} ${alarm.cause} ${alarm.text}`.replace(/_/g, ' ').toLowerCase().includes(asked);
    }, 200, true);
    this.wanted.addEventListener('input', () => this.data !== null && this.list.show(this.data.alarms));
    this.place.append(element('div', 'tools', element('label', '', 'Show ', this.wanted)), this.list.place);
  }

  show(data: FleetData): void {
    this.data = data;
    this.list.show(data.alarms);
  }
}

export class WorkersView {
  readonly place = element('div', '', element('h2', '', 'Workers'));
  private readonly body = element('tbody', '');
  private readonly said = element('p', 'soft');

  constructor() {
    const head = element('thead', '', row('th', 'partition', 'epoch', 'valves', 'blocks', 'behind [s]', 'owner'));
    this.place.append(this.said, element('div', 'wide', element('table', 'partitions', head, this.body)));
  }

  show(): void {
    void readPartitions().then((partitions) => {
      const owners = new Set(partitions.flatMap((one) => one.owner ?? []));
      setText(this.said, `${owners.size} workers hold ${partitions.filter((one) => one.owner !== null).length} of ${partitions.length} partitions.`);
      this.body.replaceChildren(...partitions.map((one) => {
        const made = row('td', String(one.partition), String(one.epoch), String(one.valves), String(one.blocks),
                         one.behind_s === null ? '–' : one.behind_s.toFixed(1), one.owner ?? 'nobody');
        made.dataset['bad'] = String(one.owner === null);
        return made;
      }));
    }).catch(() => setText(this.said, 'The program does not answer.'));
  }
}
