/** The page of `spoolflow fleet`: asks the program every few seconds how all valves stand. */
import { readSession, Refusal } from '../live/api';
import { element, setText } from '../live/element';
import { AccountControl, LoginForm, visitor } from '../live/visitor';
import { onThemeChange, themeControl } from '../theme';
import { readFleet, type FleetTold } from './api';
import { AlarmsView, WorkersView } from './other_views';
import { Overview } from './overview';
import { SeriesView } from './series_view';
import { ValveView } from './valve_view';

const period_ms = 3000;

interface View {
  readonly place: HTMLElement;
  show(told: FleetTold): void;
  resize?(): void;
  recolour?(): void;
  close?(): void;
}

const view = document.getElementById('view')!;
const totals = document.getElementById('totals')!;
const stale = document.getElementById('stale')!;
const links = [...document.querySelectorAll<HTMLAnchorElement>('nav a')];
const alarmCount = document.getElementById('alarm-count')!;

const account = new AccountControl(begin);
const login = new LoginForm(begin);
document.getElementById('controls')!.append(themeControl(), account.place);

const overview = new Overview();
let shown: View = overview;
let last: FleetTold | null = null;
let answered = performance.now();
let next = 0;

function viewOf(hash: string): View {
  const valve = /^#\/valve\/(.+)$/.exec(hash);
  if (valve !== null) return new ValveView(decodeURIComponent(valve[1]!));
  switch (hash) {
    case '#/alarms': return new AlarmsView();
    case '#/series': return new SeriesView();
    case '#/workers': return new WorkersView();
    default: return overview;
  }
}

function route(): void {
  shown.close?.();
  shown = viewOf(location.hash);
  view.replaceChildren(shown.place);
  if (last !== null) shown.show(last);
  for (const link of links) {
    if (link.hash === (location.hash === '' ? '#/' : location.hash)) link.setAttribute('aria-current', 'page');
    else link.removeAttribute('aria-current');
  }
  const title = shown === overview ? '' : view.querySelector('h2')?.firstChild?.textContent ?? '';
  document.title = title === '' ? 'spoolflow fleet' : `${title} – spoolflow fleet`;
}

/** Whoever may not read sees nothing but the form. */
function askToLogIn(): void {
  last = null;
  shown.close?.();
  shown = overview;
  setText(totals, '');
  account.show();
  if (!view.contains(login.place)) {
    view.replaceChildren(login.place);
    login.focus();
  }
}

function showTotals(told: FleetTold): void {
  const sum = (of: (site: FleetTold['sites'][number]) => number): number => told.sites.reduce((all, site) => all + of(site), 0);
  setText(totals, `${told.valves.length} valves of ${told.sites.length} sites, ${sum((one) => one.valves - one.ne107.good)} not good, ` +
    `${sum((one) => one.silent)} silent`);
  const open = sum((one) => one.unacknowledged);
  setText(alarmCount, open === 0 ? '' : String(open));
  alarmCount.hidden = open === 0;
}

async function ask(): Promise<void> {
  try {
    const told = await readFleet();
    answered = performance.now();
    last = told;
    showTotals(told);
    shown.show(told);
  } catch (error) {
    if (error instanceof Refusal && error.status === 401) {
      visitor.session = { account: null, role: 'none', accounts: true };
      answered = performance.now();
      askToLogIn();
    }
    // else told below, as long as it lasts
  }
}

function showAge(): void {
  const age_s = (performance.now() - answered) / 1000;
  stale.hidden = age_s < 3 * period_ms / 1000;
  setText(stale, stale.hidden ? '' : `The program has not answered for ${age_s.toFixed(0)} s: what is shown is old.`);
  document.body.classList.toggle('old', !stale.hidden);
}

async function follow(): Promise<void> {
  const begun = performance.now();
  if (!view.contains(login.place)) await ask();
  showAge();
  next = window.setTimeout(() => void follow(), Math.max(500, period_ms - (performance.now() - begun)));
}

/** At the start, and whenever somebody came or went. */
function begin(): void {
  clearTimeout(next);
  void readSession().then((session) => {
    visitor.session = session;
    account.show();
    if (session.role === 'none') askToLogIn();
    else route();
  }).catch(() => undefined).finally(() => void follow());
}

window.addEventListener('hashchange', () => {
  if (visitor.session.role === 'none' && visitor.session.accounts) return;
  route();
  const heading = view.querySelector('h2');
  if (heading !== null && shown !== overview) {
    heading.tabIndex = -1;
    heading.focus({ preventScroll: true });
  }
  scrollTo(0, 0);
});
window.addEventListener('keydown', (event) => {
  if (event.key === 'Escape' && shown !== overview && !(event.target instanceof HTMLSelectElement)) location.hash = '#/';
});
window.addEventListener('resize', () => shown.resize?.());
onThemeChange(() => {
  shown.recolour?.();
  shown.resize?.();
});
view.replaceChildren(element('p', 'soft', 'Asking the program …'));
begin();
