/** The site as a whole: totals, what they were over the last minutes, how each source fares, all alarms. */
import { AlarmList } from './alarm_list';
import { clock, figure, isOpen, rivalText, severity, type LiveData, type Output, type Valve } from './api';
import { element, row, setText } from './element';

const sourceColumns = ['valve', 'source', 'samples/s', 'age [s]', 'dropped', 'lost', 'repeated', 'unreadable', 'connections', 'trouble'];
const outputColumns = ['output', 'sent', 'received', 'waiting', 'dropped', 'connections', 'trouble'];
const strangerColumns = ['id', 'sender', 'first', 'last', 'times'];

/** Each cell but the first has its column's name, which narrow screens show in front of it. */
function named(line: HTMLTableRowElement, columns: readonly string[]): HTMLTableRowElement {
  for (let k = 1; k < columns.length; ++k) (line.children[k] as HTMLElement).dataset['name'] = columns[k]!;
  return line;
}

class Tile {
  readonly place = element('div', 'tile');
  private readonly value = element('b', '');

  constructor(name: string) {
    this.place.append(this.value, element('span', '', name));
  }
  show(text: string): void {
    setText(this.value, text);
  }
}

/** Samples a second of each source, from what it had received before. */
class Rates {
  private before = new Map<string, { received: number; at: number; rate: number }>();

  of(valve: Valve): number | null {
    const now = performance.now(), received = valve.source.received;
    const last = this.before.get(valve.id);
    if (last === undefined || received < last.received) {
      this.before.set(valve.id, { received, at: now, rate: NaN });
      return null;
    }
    if (now - last.at > 900) {
      this.before.set(valve.id, { received, at: now, rate: (received - last.received) / (now - last.at) * 1000 });
    }
    const { rate } = this.before.get(valve.id)!;
    return Number.isFinite(rate) ? rate : null;
  }
}

export class SiteView {
  readonly place = element('div', '');
  private readonly tiles = {
    flow: new Tile('L/min through all valves'), power: new Tile('kW hydraulic through their edges'),
    energy: new Tile('kWh counted'), good: new Tile('valves good'), alarms: new Tile('alarms not acknowledged'),
    stalled: new Tile('sources without samples'),
  };
  private readonly sources = element('tbody', '');
  private readonly kept = element('p', 'kept');
  private readonly mended = element('p', 'stale');
  private readonly datagrams = element('p', 'kept');
  private readonly messages = element('p', 'kept');
  private readonly outputRows = element('tbody', '');
  private readonly outputs = element('section', '');
  private readonly unknown = element('tbody', '');
  private readonly strangers = element('section', '');
  private readonly rates = new Rates();
  private readonly rows = new Map<string, HTMLTableCellElement[]>();

  constructor() {
    const head = element('thead', '', row('th', ...sourceColumns));
    this.place.append(element('h2', '', 'Site'), element('div', 'tiles', ...Object.values(this.tiles).map((tile) => tile.place)),
                      this.kept, this.mended, this.datagrams, this.messages, element('h3', '', 'Sources'),
                      element('div', 'wide', element('table', 'sources stacked', head, this.sources)), this.outputs, this.strangers);
    this.outputs.append(element('h3', '', 'Outputs'), element('div', 'wide', element('table', 'outputs stacked', element(
      'thead', '', row('th', ...outputColumns)), this.outputRows)));
    this.strangers.append(element('h3', '', 'Samples of valves that the site does not know'), element('div', 'wide', element('table', 'unknown stacked', element(
      'thead', '', row('th', ...strangerColumns)), this.unknown)));
  }

  show({ valves, alarms, site }: LiveData): void {
    this.tiles.flow.show(figure(site.flow_L_min, 1));
    this.tiles.power.show(figure(site.hydraulic_power_W === null ? null : site.hydraulic_power_W / 1e3, 2));
    this.tiles.energy.show(figure(valves.reduce((sum, valve) => sum + (valve.energy_J ?? 0), 0) / 3.6e6, 3));
    this.tiles.good.show(`${valves.filter((valve) => severity[valve.ne107] === 0).length} of ${valves.length}`);
    this.tiles.alarms.show(String(alarms.filter(isOpen).length));
    this.tiles.stalled.show(String(site.stalled));
    setText(this.kept, site.store === '' ? 'Nothing is kept: the program was started without a store.'
      : site.store_trouble === '' ? `Kept in ${site.store}` : `Nothing is kept at present: ${site.store_trouble}`);
    this.kept.classList.toggle('stale', site.store_trouble !== '');
    this.mended.hidden = site.store_mended === null;
    setText(this.mended, site.store_mended === null ? '' : `${clock(site.store_mended.time)}: ${site.store_mended.text}`);
    const { udp, mqtt_source: mqtt } = site;
    this.datagrams.hidden = udp.port === 0;
    setText(this.datagrams, `UDP port ${udp.port}: ${udp.datagrams} datagrams, ${udp.unreadable} unreadable, ` +
      `${udp.unknown_valve} of unknown valves, ${udp.not_allowed} not allowed, ${udp.refused} of a second sender`);
    this.messages.hidden = mqtt === null;
    setText(this.messages, mqtt === null ? '' : `MQTT ${mqtt.broker}: ${mqtt.connected ? 'connected' : 'not connected'}, ` +
      `${mqtt.messages} messages, ${mqtt.unknown_valve} of unknown valves`);
    this.showOutputs(site.outputs);
    const unknown = [...udp.unknown.map((one) => ({ ...one, pieces: one.datagrams })),
      ...(mqtt?.unknown ?? []).map((one) => ({ ...one, pieces: one.messages }))];
    this.strangers.hidden = unknown.length === 0;
    this.unknown.replaceChildren(...unknown.map((one) =>
      named(row('td', one.valve, one.sender, clock(one.first), clock(one.last), String(one.pieces)), strangerColumns)));
    for (const valve of valves) this.showSource(valve);
  }

  private showOutputs(outputs: Record<string, Output>): void {
    this.outputs.hidden = Object.keys(outputs).length === 0;
    this.outputRows.replaceChildren(...Object.entries(outputs).map(([name, of]) => {
      const line = named(row('td', name, ...[of.sent, of.received, of.waiting, of.dropped, of.connected].map(String), of.trouble),
                         outputColumns);
      line.dataset['bad'] = String(of.trouble !== '');
      return line;
    }));
  }

  private showSource(valve: Valve): void {
    let cells = this.rows.get(valve.id);
    if (cells === undefined) {
      const link = element('a', '', valve.id);
      link.href = `#/valve/${encodeURIComponent(valve.id)}`;
      cells = Array.from({ length: 9 }, () => element('td', ''));
      this.rows.set(valve.id, cells);
      this.sources.append(named(element('tr', '', element('td', '', link), ...cells), sourceColumns));
    }
    const of = valve.source;
    const texts = [of.port === undefined ? of.kind : `${of.kind} :${of.port}`, figure(this.rates.of(valve), 0),
                   figure(of.age_s, 1), of.dropped, of.lost, of.repeated, of.unreadable, of.connections,
                   of.stalled && of.trouble === '' ? 'no samples' : of.trouble].map(String);
    cells.forEach((cell, k) => setText(cell, texts[k]!));
    const bad = of.stalled || of.dropped > 0 || of.lost > 0 || of.unreadable > 0 || rivalText(valve) !== '';
    cells[0]!.parentElement!.dataset['bad'] = String(bad);
  }
}

/** All alarms, those that are over, too. */
export class AlarmsView {
  readonly place = element('div', '');
  private readonly open = new AlarmList((alarm) => alarm.state !== 'cleared' && alarm.state !== 'shelved', 200, true);
  private readonly shelved = new AlarmList((alarm) => alarm.state === 'shelved', 200, true);
  private readonly cleared = new AlarmList((alarm) => alarm.state === 'cleared', 200, true);

  constructor() {
    this.place.append(element('h2', '', 'Alarms'), this.open.place, element('h3', '', 'Shelved'), this.shelved.place,
                      element('h3', '', 'Gone and acknowledged'), this.cleared.place);
  }
  show({ alarms, valves }: LiveData): void {
    this.open.follow(valves);
    this.open.show(alarms);
    this.shelved.follow(valves);
    this.shelved.show(alarms);
    this.cleared.show(alarms);
  }
}
