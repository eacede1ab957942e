/** Valves as lines, of which only those are there that can be seen: ten thousand are as quick as ten. */
import { figure, signs } from '../live/api';
import { element, setText } from '../live/element';
import type { FleetValve } from './api';

const tall = 32, beyond = 8;

class Line {
  readonly link = element('a', 'line');
  private readonly id = element('span', '');
  private readonly series = element('span', 'soft wideOnly');
  private readonly flow = element('span', 'right');
  private readonly band = element('span', 'soft wideOnly');
  private readonly sign = element('span', 'sign');
  private readonly age = element('span', 'soft right wideOnly');

  constructor() {
    this.link.append(this.id, this.series, this.flow, this.band, this.sign, this.age);
  }

  show(valve: FleetValve, at: number): void {
    this.link.style.transform = `translateY(${at * tall}px)`;
    this.link.href = `#/valve/${encodeURIComponent(valve.id)}`;
    this.link.dataset['silent'] = String(valve.silent);
    this.link.setAttribute('aria-posinset', String(at + 1));
    setText(this.id, valve.id);
    setText(this.series, valve.series);
    setText(this.flow, `${figure(valve.flow_L_min, 2)} L/min`);
    setText(this.band, `${figure(valve.flow_lower_L_min, 2)} to ${figure(valve.flow_upper_L_min, 2)}`);
    setText(this.sign, valve.silent ? 'silent' : signs[valve.ne107]);
    this.sign.dataset['sign'] = valve.silent ? 'C' : valve.ne107;
    setText(this.age, valve.age_s < 1000 ? `${Math.max(0, valve.age_s).toFixed(0)} s` : `${(valve.age_s / 3600).toFixed(1)} h`);
  }
}

export class ValveList {
  readonly place = element('div', 'list');
  private readonly rows = element('div', 'rows');
  private readonly lines: Line[] = [];
  private valves: readonly FleetValve[] = [];
  private waits = false;

  constructor() {
    this.place.tabIndex = 0;
    this.place.setAttribute('role', 'region');
    this.place.setAttribute('aria-label', 'valves');
    this.place.append(this.rows);
    this.place.addEventListener('scroll', () => this.later(), { passive: true });
    new ResizeObserver(() => this.later()).observe(this.place);
  }

  show(valves: readonly FleetValve[]): void {
    this.valves = valves;
    this.rows.style.height = `${valves.length * tall}px`;
    this.draw();
  }

  private later(): void {
    if (this.waits) return;
    this.waits = true;
    requestAnimationFrame(() => {
      this.waits = false;
      this.draw();
    });
  }

  /** A line keeps to the valves of its turn, so that scrolling by one changes one. */
  private draw(): void {
    const first = Math.max(0, Math.floor(this.place.scrollTop / tall) - beyond);
    const count = Math.ceil((this.place.clientHeight || 600) / tall) + 2 * beyond;
    while (this.lines.length < count) {
      const line = new Line();
      this.lines.push(line);
      this.rows.append(line.link);
    }
    for (let k = first; k < first + this.lines.length; ++k) {
      const line = this.lines[k % this.lines.length]!, valve = this.valves[k];
      line.link.hidden = valve === undefined;
      if (valve !== undefined) line.show(valve, k);
    }
  }
}
