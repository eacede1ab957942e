/** Sites, and below them the valves that are asked for. */
import { figure, severity, signs, type Sign } from '../live/api';
import { element, row, setText } from '../live/element';
import type { FleetSite, FleetData, FleetValve } from './api';
import { ValveList } from './valve_list';

function siteRow(site: FleetSite, chosen: boolean, choose: () => void): HTMLTableRowElement {
  const button = element('button', '', site.site);
  button.type = 'button';
  button.setAttribute('aria-pressed', String(chosen));
  button.addEventListener('click', choose);
  const bad = (['F', 'C', 'S', 'M'] as Sign[]).filter((sign) => site.ne107[sign] > 0)
    .map((sign) => `${site.ne107[sign]} ${signs[sign]}`).join(', ');
  const made = row('td', '', String(site.valves), bad === '' ? 'all good' : bad, String(site.silent), String(site.alarms),
                   String(site.unacknowledged), figure(site.flow_L_min, 1));
  made.firstChild!.appendChild(button);
  if (bad !== '') made.children[2]!.className = 'bad';
  made.dataset['chosen'] = String(chosen);
  return made;
}

export class Overview {
  readonly place = element('div', '');
  private readonly body = element('tbody', '');
  private readonly wanted = element('input', '');
  private readonly sign = element('select', '');
  private readonly worstFirst = element('input', '');
  private readonly count = element('span', 'count');
  private readonly list = new ValveList();
  private site = '';
  private data: FleetData | null = null;

  constructor() {
    this.wanted.type = 'search';
    this.wanted.placeholder = 'name or series';
    this.worstFirst.type = 'checkbox';
    for (const [text, value] of [['every sign', ''], ['not good', 'bad'], ['silent', 'silent']] as const) this.sign.add(new Option(text, value));
    this.wanted.addEventListener('input', () => this.arrange());
    this.sign.addEventListener('change', () => this.arrange());
    this.worstFirst.addEventListener('change', () => this.arrange());
    const head = element('thead', '', row('th', 'site', 'valves', 'signs', 'silent', 'alarms', 'not acknowledged', 'flow [L/min]'));
    const lineHead = element('div', 'line lineHead', element('span', '', 'valve'), element('span', 'wideOnly', 'series'),
                             element('span', 'right', 'mean flow'), element('span', 'wideOnly', '95 % band'),
                             element('span', '', 'sign'), element('span', 'right wideOnly', 'age'));
    this.place.append(element('div', 'wide sites', element('table', '', head, this.body)),
                      element('div', 'tools', element('label', '', 'Show ', this.wanted), this.sign,
                              element('label', '', this.worstFirst, ' worst first'), this.count), lineHead, this.list.place);
  }

  show(data: FleetData): void {
    this.data = data;
    const focused = this.body.contains(document.activeElement) ? document.activeElement!.textContent : null;
    this.body.replaceChildren(...data.sites.map((site) => siteRow(site, site.site === this.site, () => {
      this.site = this.site === site.site ? '' : site.site;
      this.show(this.data!);
    })));
    if (focused !== null) [...this.body.querySelectorAll('button')].find((one) => one.textContent === focused)?.focus();
    this.arrange();
  }

  private arrange(): void {
    if (this.data === null) return;
    const asked = this.wanted.value.trim().toLowerCase(), sign = this.sign.value;
    const fits = (valve: FleetValve): boolean => (this.site === '' || valve.site === this.site) &&
      (asked === '' || valve.id.toLowerCase().includes(asked) || valve.series.toLowerCase().includes(asked)) &&
      (sign === '' || (sign === 'silent' ? valve.silent : valve.ne107 !== 'good'));
    const shown = this.data.valves.filter(fits);
    if (this.worstFirst.checked) shown.sort((a, b) => severity[b.ne107] - severity[a.ne107]);
    setText(this.count, `${shown.length} of ${this.data.valves.length} valves`);
    this.list.show(shown);
  }
}
