/** Alarms with what was seen when they were raised, raw samples, and what those who may do with them. */
import {
  act, clock, duration, inUnit, isOpen, keyOf, measured, scaled, severity, short, signs, trendText, words, type Alarm, type Valve,
} from './api';
import { AlarmDesk } from './alarm_desk';
import { element, row, setText } from './element';
import { visitor } from './visitor';

const states: Record<Alarm['state'], string> = {
  raised_unacknowledged: 'raised',
  raised_acknowledged: 'raised, acknowledged',
  gone_unacknowledged: 'gone, not acknowledged',
  cleared: 'gone, acknowledged',
  shelved: 'shelved',
};

/** What is there and not seen comes first. */
const urgency: Record<Alarm['state'], number> =
  { raised_unacknowledged: 0, gone_unacknowledged: 1, raised_acknowledged: 2, shelved: 3, cleared: 4 };

class Entry {
  readonly place = element('li', 'alarm');
  private readonly sign = element('span', 'sign');
  private readonly state = element('span', 'state');
  private readonly meaning = element('p', 'meaning');
  private readonly remedy = element('p', 'remedy');
  private readonly growth = element('p', 'growth');
  private readonly when = element('p', 'when');
  private readonly links = element('p', 'links');
  private readonly button = element('button', 'acknowledge', 'Acknowledge');
  private readonly comments = element('ul', 'comments');
  private readonly desk: AlarmDesk;
  private readonly trouble = element('p', 'stale');
  private shown = '';

  constructor(alarm: Alarm) {
    const valve = element('a', '', alarm.valve);
    valve.href = `#/valve/${encodeURIComponent(alarm.valve)}`;
    this.button.type = 'button';
    this.button.setAttribute('aria-label', `Acknowledge alarm ${alarm.id}: ${words(alarm.cause)} of ${alarm.valve}`);
    this.button.addEventListener('click', () => void this.order(keyOf(alarm), 'acknowledge'));
    this.desk = new AlarmDesk(alarm, (what, body) => this.order(keyOf(alarm), what, body));
    const head = element('p', 'what', this.sign, ' ', valve, ' ', element('b', '', words(alarm.cause)), ' ', this.state);
    this.place.append(head, this.button, this.meaning, this.growth, this.remedy, this.when);
    if (alarm.indicators.length > 0) this.place.append(this.indicators(alarm));
    this.place.append(this.links, this.comments, this.desk.place, this.trouble);
    this.trouble.hidden = true;
  }

  /** Figures that go on: how long it stands, and what its indicator shows beside then. */
  follow(alarm: Alarm, valve: Valve | undefined): void {
    const ended = alarm.gone === null ? Date.now() : Date.parse(alarm.gone);
    const since = `${alarm.gone === null ? 'For' : 'Stood for'} ${duration(Math.max(0, ended - Date.parse(alarm.raised)) / 1000)}`;
    const named = (one: { name: string }): boolean => one.name === alarm.indicator || one.name === `${alarm.indicator ?? ''}_a`;
    const lines = (valve?.indicators ?? []).filter((one) => named(one) && one.value !== null).map((one) => {
      const { factor } = inUnit(one), then = alarm.indicators.find((each) => each.name === one.name);
      const value = (each: number | null | undefined): string => short(scaled(each ?? null, factor));
      return `${words(one.name)} ${measured(one)}` +
        `${then === undefined ? '' : ` (${value(then.value)} when it was raised)`}, usual ${value(one.baseline)}` +
        `${one.trend == null ? '' : `; ${trendText(one)}`}`;
    });
    setText(this.growth, [since, ...lines].join('; '));
  }

  show(alarm: Alarm): void {
    this.place.dataset['state'] = alarm.state;
    this.button.hidden = !isOpen(alarm) || visitor.session.role !== 'acknowledge';
    this.desk.show(alarm);
    const all = JSON.stringify([alarm.ne107, alarm.state, alarm.times, alarm.gone, alarm.acknowledged, alarm.recording, alarm.shelved_until, alarm.comments]);
    if (this.shown === all) return;
    this.shown = all;
    setText(this.sign, signs[alarm.ne107]);
    this.sign.dataset['sign'] = alarm.ne107;
    setText(this.state, alarm.shelved_until == null ? states[alarm.state]
      : `shelved by ${alarm.shelved_by} until ${clock(alarm.shelved_until)}`);
    this.comments.replaceChildren(...(alarm.comments ?? []).map((one) =>
      element('li', '', element('time', '', clock(one.time)), ' ', element('b', '', one.by), ` ${one.text}`)));
    this.comments.hidden = (alarm.comments ?? []).length === 0;
    setText(this.meaning, alarm.meaning ?? '');
    setText(this.remedy, alarm.remedy ?? '');
    this.meaning.hidden = alarm.meaning == null;
    this.remedy.hidden = alarm.remedy == null;
    setText(this.when, `${alarm.text}; since ${clock(alarm.raised)}${alarm.times > 1 ? `, ${alarm.times} times` : ''}` +
      `${alarm.gone === null ? '' : `, gone ${clock(alarm.gone)}`}` +
      `${alarm.acknowledged === null ? '' : `, acknowledged by ${alarm.acknowledged_by} ${clock(alarm.acknowledged)}`}`);
    this.links.replaceChildren();
    this.links.hidden = alarm.recording === null;
    if (alarm.recording === null) return;
    const link = element('a', '', 'raw samples around it (CSV)');
    link.href = `/api/v1/recordings/${alarm.recording}.csv`;
    link.download = `${alarm.valve}_alarm_${alarm.id}.csv`;
    this.links.append(link);
  }

  private async order(key: string, what: string, body?: unknown): Promise<void> {
    const focused = document.activeElement === this.button;
    this.button.disabled = true;
    try {
      this.show(await act(key, what, body));
      this.trouble.hidden = true;
    } catch (error) {
      this.trouble.hidden = false;
      setText(this.trouble, error instanceof Error ? error.message : String(error));
    }
    this.button.disabled = false;
    if (focused) this.keepFocus();
  }

  /** The button is gone: the next alarm's takes the focus, else the list. */
  private keepFocus(): void {
    if (!this.button.hidden) return this.button.focus();
    const list = this.place.parentElement;
    const next = [...(list?.querySelectorAll<HTMLElement>('.acknowledge') ?? [])].find((each) => !each.hidden);
    (next ?? list)?.focus();
  }

  private indicators(alarm: Alarm): HTMLElement {
    const rows = alarm.indicators.map((one) => {
      const { factor, unit } = inUnit(one);
      const line = row('td', words(one.name), short(scaled(one.value, factor)), short(scaled(one.uncertainty_95, factor)),
                       short(scaled(one.baseline, factor)), unit, one.state);
      line.dataset['state'] = one.state;
      return line;
    });
    const head = element('thead', '', row('th', 'indicator', 'value', '± (95 %)', 'baseline', 'unit', 'state'));
    return element('details', '', element('summary', '', 'indicators when it was raised'),
                   element('div', 'wide', element('table', '', head, element('tbody', '', ...rows))));
  }
}

export class AlarmList {
  readonly place = element('ul', 'alarms');
  private readonly entries = new Map<string, Entry>();
  private readonly nothing = element('li', 'soft', 'none');
  private readonly more = element('li', 'soft');
  private valves: readonly Valve[] = [];

  /** `says`: that there are none, where there are none. */
  constructor(private readonly wanted: (alarm: Alarm) => boolean, private readonly most = 100, private readonly says = false) {
    this.place.setAttribute('aria-label', 'alarms');
    this.place.tabIndex = -1;
  }

  /** Whose figures the alarms shown from now on go on with. */
  follow(valves: readonly Valve[]): void {
    this.valves = valves;
  }

  show(alarms: readonly Alarm[]): void {
    const all = alarms.filter(this.wanted)
      .sort((a, b) => urgency[a.state] - urgency[b.state] || severity[b.ne107] - severity[a.ne107] ||
        b.raised.localeCompare(a.raised) || b.id - a.id);
    const shown = all.slice(0, this.most);
    const known = new Set(shown.map(keyOf));
    for (const id of [...this.entries.keys()]) if (!known.has(id)) this.entries.delete(id);
    const places: HTMLElement[] = shown.map((alarm) => {
      let entry = this.entries.get(keyOf(alarm));
      if (entry === undefined) {
        entry = new Entry(alarm);
        this.entries.set(keyOf(alarm), entry);
      }
      entry.show(alarm);
      entry.follow(alarm, this.valves.find((valve) => valve.id === alarm.valve));
      return entry.place;
    });
    if (all.length > shown.length) {
      const link = element('a', '', `and ${all.length - shown.length} more`);
      link.href = '#/alarms';
      this.more.replaceChildren(link);
      places.push(this.more);
    }
    if (places.length === 0 && this.says) places.push(this.nothing);
    this.place.hidden = places.length === 0;
    if (places.length === this.place.children.length && places.every((one, k) => this.place.children[k] === one)) return;
    const focused = document.activeElement;
    this.place.replaceChildren(...places);
    if (focused instanceof HTMLElement && this.place.contains(focused)) focused.focus();
  }
}
