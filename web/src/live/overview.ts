/** Every valve of the site on one card: flow, band, sign, the worst indicator, and a line of the last two minutes. */
import { figure, short, signs, type SiteEvent, type Valve } from './api';
import { element, setText } from './element';

const history = 120;

class Card {
  readonly link = element('a', 'card');
  private readonly sign = element('span', 'sign');
  private readonly flow = element('strong', 'flow');
  private readonly band = element('span', 'band');
  private readonly worst = element('span', 'worst');
  private readonly line: SVGPathElement;
  private readonly flows: number[] = [];

  constructor(id: string) {
    this.link.href = `#/valve/${encodeURIComponent(id)}`;
    const picture = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    picture.setAttribute('viewBox', `0 0 ${history} 24`);
    picture.setAttribute('preserveAspectRatio', 'none');
    picture.setAttribute('class', 'spark');
    picture.setAttribute('aria-hidden', 'true');
    this.line = document.createElementNS('http://www.w3.org/2000/svg', 'path');
    picture.append(this.line);
    this.link.append(element('span', 'name', id), this.sign, this.flow, this.band, picture, this.worst);
  }

  show(valve: Valve): void {
    setText(this.sign, signs[valve.ne107]);
    this.sign.dataset['sign'] = valve.ne107;
    this.link.dataset['stalled'] = String(valve.source.stalled);
    setText(this.flow, `${figure(valve.flow_L_min, 2)} L/min`);
    setText(this.band, `${figure(valve.flow_lower_L_min, 2)} to ${figure(valve.flow_upper_L_min, 2)}`);
    const raised = valve.indicators.find((one) => one.state === 'raised');
    setText(this.worst, valve.source.stalled ? 'no samples'
      : raised !== undefined ? `${raised.name.replace(/_/g, ' ')} ${short(raised.value)} ${raised.unit}`
      : valve.status.join(', '));
    this.flows.push(valve.flow_L_min ?? 0);
    if (this.flows.length > history) this.flows.shift();
    const full = Math.max(1e-9, ...this.flows.map(Math.abs));
    this.line.setAttribute('d', this.flows.map((flow, k) =>
      `${k === 0 ? 'M' : 'L'}${k + history - this.flows.length} ${(23 - 22 * Math.abs(flow) / full).toFixed(1)}`).join(''));
  }
}

export class Overview {
  readonly place = element('div', '');
  private readonly cards = new Map<string, Card>();
  private readonly grid = element('section', 'cards');
  private readonly events = element('ul', 'events');

  constructor() {
    this.grid.setAttribute('aria-label', 'valves');
    this.place.append(this.grid, element('h2', '', 'Events'), this.events);
  }

  show(valves: readonly Valve[], events: readonly SiteEvent[]): void {
    for (const valve of valves) {
      let card = this.cards.get(valve.id);
      if (card === undefined) {
        card = new Card(valve.id);
        this.cards.set(valve.id, card);
        this.grid.append(card.link);
      }
      card.show(valve);
    }
    showEvents(this.events, events.slice(0, 50));
  }
}

export function showEvents(place: HTMLElement, events: readonly SiteEvent[]): void {
  const lines = events.map((event) => `${event.time.replace('T', ' ').slice(0, 19)} UTC  ${event.valve}  ${event.text}`);
  const newest = lines.join('\n');
  if (place.dataset['shown'] === newest) return;
  place.dataset['shown'] = newest;
  place.replaceChildren(...(lines.length > 0 ? lines : ['none yet']).map((line) => element('li', '', line)));
}
