/** Every valve of the site on one card: flow, band, sign, the worst indicator, and a line of the last two minutes. */
import { AlarmList } from './alarm_list';
import {
  duration, figure, isOld, isOpen, measured, readRecent, rivalText, severity, signs, words, type Indicator, type Recent, type LiveData, type Valve,
} from './api';
import { element, setText } from './element';
import { EventList } from './event_list';

const history = 120;

/** How far it lies from what is usual, in its own uncertainty. */
function distance(one: Indicator): number {
  if (one.value === null || one.baseline === null || !(one.uncertainty_95 !== null && one.uncertainty_95 > 0)) return -1;
  return Math.abs(one.value - one.baseline) / one.uncertainty_95;
}

/** Of those that are judged: raised ones before all others, then the one that is farthest from what is usual. */
export function worstOf(valve: Valve): Indicator | undefined {
  let worst: Indicator | undefined;
  for (const one of valve.indicators) {
    if (one.state !== 'raised' && one.state !== 'good') continue;
    if (one.state === 'good' && /^(winding|coil_resistance|closed_position)/.test(one.name)) continue;  // no chart judges them
    const rank = (each: Indicator): number => (each.state === 'raised' ? 1e6 : 0) + distance(each);
    if (distance(one) >= 0 && (worst === undefined || rank(one) > rank(worst))) worst = one;
  }
  return worst;
}

interface Second {
  flow: number | null;
  lower: number | null;
  upper: number | null;
}

function svg(name: string, attributes: Record<string, string>): SVGElement {
  const out = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) out.setAttribute(key, value);
  return out;
}

/** Flow with its band as SVG paths over the last two minutes, the newest second at the right; gaps where nothing is known. */
export function sparkOf(seconds: readonly Second[], rated: number): { line: string; band: string } {
  const known = seconds.flatMap((one) => one.flow === null ? [] : [one.flow, one.lower ?? one.flow, one.upper ?? one.flow]);
  const lowest = Math.min(0, ...known), highest = Math.max(0.02 * rated, ...known);
  const y = (value: number): string => (23 - 22 * (value - lowest) / (highest - lowest)).toFixed(1);
  const x = (k: number): number => k + history - seconds.length;
  let line = '', band = '';
  for (let from = 0; from < seconds.length;) {
    if (seconds[from]!.flow === null) {
      ++from;
      continue;
    }
    let to = from;
    while (to < seconds.length && seconds[to]!.flow !== null) ++to;
    const part = seconds.slice(from, to).map((one, k) => ({ x: x(from + k), flow: one.flow!, lower: one.lower ?? one.flow!, upper: one.upper ?? one.flow! }));
    line += part.map((one, k) => `${k === 0 ? 'M' : 'L'}${one.x} ${y(one.flow)}`).join('');
    band += `M${part.map((one) => `${one.x} ${y(one.upper)}`).join('L')}L${[...part].reverse().map((one) => `${one.x} ${y(one.lower)}`).join('L')}Z`;
    from = to;
  }
  return { line, band };
}

class Card {
  readonly link = element('a', 'card');
  private readonly sign = element('span', 'sign');
  private readonly flow = element('strong', 'flow');
  private readonly band = element('span', 'band');
  private readonly worst = element('span', 'worst');
  private readonly line = svg('path', { class: 'line' });
  private readonly area = svg('path', { class: 'area' });
  /** Once a second; null where no samples came. */
  private seconds: Second[] = [];

  constructor(id: string) {
    this.link.href = `#/valve/${encodeURIComponent(id)}`;
    const picture = svg('svg', { viewBox: `0 0 ${history} 24`, preserveAspectRatio: 'none', class: 'spark', 'aria-hidden': 'true' });
    picture.append(this.area, this.line);
    const axis = element('span', 'axis', element('span', '', '−2 min'), element('span', '', '−1 min'), element('span', '', 'now'));
    axis.setAttribute('aria-hidden', 'true');
    this.link.append(element('span', 'top', element('span', 'name', id), this.sign), element('span', 'answer', this.flow, this.band), picture as unknown as HTMLElement, axis, this.worst);
  }

  /** What the program saw before the page was opened. */
  begin(recent: Recent): void {
    const before = recent.flow_L_min.map((flow, k) => ({ flow, lower: recent.flow_lower_L_min[k] ?? null, upper: recent.flow_upper_L_min[k] ?? null }));
    this.seconds = [...before.slice(this.seconds.length), ...this.seconds].slice(-history);
  }

  show(valve: Valve): void {
    setText(this.sign, signs[valve.ne107]);
    this.sign.dataset['sign'] = valve.ne107;
    const old = isOld(valve);
    this.link.dataset['stalled'] = String(old);
    setText(this.flow, `${old && valve.flow_L_min !== null ? 'last ' : ''}${figure(valve.flow_L_min, 2)} L/min`);
    setText(this.band, `${figure(valve.flow_lower_L_min, 2)} to ${figure(valve.flow_upper_L_min, 2)}`);
    setText(this.worst, this.said(valve));
    const said = [...valve.findings, rivalText(valve)].filter((one) => one !== '');
    this.worst.dataset['raised'] = String(said.length > 0 || valve.indicators.some((one) => one.state === 'raised'));
    this.worst.title = said.join('\n');
    this.worst.dataset['finding'] = String(!old && said.length > 0);
    this.seconds.push(old ? { flow: null, lower: null, upper: null }
      : { flow: valve.flow_L_min, lower: valve.flow_lower_L_min, upper: valve.flow_upper_L_min });
    if (this.seconds.length > history) this.seconds.shift();
    const { line, band } = sparkOf(this.seconds, valve.rated_flow_L_min);
    this.line.setAttribute('d', line);
    this.area.setAttribute('d', band);
  }

  private said(valve: Valve): string {
    if (isOld(valve)) {
      const { age_s, trouble } = valve.source;
      return `no samples${age_s === null ? '' : ` for ${duration(age_s)}`}${trouble === '' ? '' : `: ${trouble}`}`;
    }
    if (valve.findings.length > 0) return `its samples: ${valve.findings[0]!}`;
    if (rivalText(valve) !== '') return rivalText(valve);
    const worst = worstOf(valve);
    if (worst === undefined) return valve.status.length > 0 ? valve.status.map(words).join(', ') : 'nothing judged yet';
    return `${words(worst.name)} ${measured(worst)}`;
  }
}

export class Overview {
  readonly place = element('div', '');
  private readonly cards = new Map<string, Card>();
  private readonly grid = element('section', 'cards');
  private readonly alarms = new AlarmList(isOpen, 3);
  private readonly events = new EventList(30);
  private readonly wanted = element('input', '');
  private readonly worstFirst = element('input', '');
  private readonly count = element('span', 'count');
  private data: LiveData | null = null;
  private asked = false;

  constructor() {
    this.grid.setAttribute('aria-label', 'valves');
    this.wanted.type = 'search';
    this.wanted.placeholder = 'name, sign or cause';
    this.worstFirst.type = 'checkbox';
    this.worstFirst.checked = true;
    this.wanted.addEventListener('input', () => this.arrange());
    this.worstFirst.addEventListener('change', () => this.arrange());
    this.grid.addEventListener('keydown', (event) => this.move(event));
    const tools = element('div', 'tools', element('label', '', 'Show ', this.wanted),
                          element('label', '', this.worstFirst, ' problems first'), this.count);
    this.place.append(this.alarms.place, tools, this.grid, element('h2', '', 'Events'), this.events.place);
  }

  show(data: LiveData): void {
    this.data = data;
    for (const valve of data.valves) {
      let card = this.cards.get(valve.id);
      if (card === undefined) {
        card = new Card(valve.id);
        this.cards.set(valve.id, card);
      }
      card.show(valve);
    }
    if (!this.asked) void this.begin();
    this.arrange();
    this.alarms.follow(data.valves);
    this.alarms.show(data.alarms);
    this.events.show(data.events);
  }

  /** The last two minutes, once. */
  private async begin(): Promise<void> {
    this.asked = true;
    for (const recent of await readRecent().catch(() => [])) this.cards.get(recent.id)?.begin(recent);
  }

  /** The cards that are asked for, in their order; the page is touched where that changes. */
  private arrange(): void {
    if (this.data === null) return;
    const asked = this.wanted.value.trim().toLowerCase();
    const fits = (valve: Valve): boolean => asked === '' || valve.id.toLowerCase().includes(asked) ||
      signs[valve.ne107].includes(asked) || valve.causes.some((one) => words(one.cause).includes(asked));
    const shown = this.data.valves.filter(fits);
    const rank = (valve: Valve): number => 2 * severity[valve.ne107] + Math.min(1, valve.findings.length);
    if (this.worstFirst.checked) shown.sort((a, b) => rank(b) - rank(a));
    setText(this.count, `${shown.length} of ${this.data.valves.length} valves`);
    const links = shown.map((valve) => this.cards.get(valve.id)!.link);
    if (links.length === this.grid.children.length && links.every((link, k) => this.grid.children[k] === link)) return;
    const focused = document.activeElement;
    this.grid.replaceChildren(...links);
    if (focused instanceof HTMLElement && this.grid.contains(focused)) focused.focus();
  }

  /** Arrows go from card to card. */
  private move(event: KeyboardEvent): void {
    const links = [...this.grid.children] as HTMLElement[];
    const at = links.indexOf(document.activeElement as HTMLElement);
    if (at < 0) return;
    const columns = Math.max(1, links.filter((link) => link.offsetTop === links[0]!.offsetTop).length);
    const steps: Record<string, number> = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: columns, ArrowUp: -columns };
    const next = links[event.key === 'Home' ? 0 : event.key === 'End' ? links.length - 1 : at + (steps[event.key] ?? NaN)];
    if (next === undefined) return;
    event.preventDefault();
    next.focus();
  }
}
