/** The page of `spoolflow live`: asks the program once a second, and follows one valve as its samples come. */
import { figure, readAll, readSession, Refusal, words, type Told } from './api';
import { element, setText } from './element';
import { Overview } from './overview';
import { AlarmsView, SiteView } from './site_view';
import { themeControl, onThemeChange } from '../theme';
import { ValveView } from './valve_view';
import { AccountControl, LoginForm, visitor } from './visitor';

interface View {
  readonly place: HTMLElement;
  show(told: Told): void;
}

const view = document.getElementById('view')!;
const totals = document.getElementById('totals')!;
const stale = document.getElementById('stale')!;
const news = document.getElementById('news')!;
const links = [...document.querySelectorAll<HTMLAnchorElement>('nav a')];
const alarmCount = document.getElementById('alarm-count')!;

const account = new AccountControl(begin);
const login = new LoginForm(begin);
document.getElementById('controls')!.append(themeControl(), account.place);

const overview = new Overview();
let shown: View = overview;
let last: Told | null = null;
let answered = performance.now();
let next = 0;

function viewOf(hash: string): View {
  const valve = /^#\/valve\/(.+)$/.exec(hash);
  if (valve !== null) return new ValveView(decodeURIComponent(valve[1]!));
  return hash === '#/alarms' ? new AlarmsView() : hash === '#/site' ? new SiteView() : overview;
}

function route(): void {
  if (shown instanceof ValveView) shown.close();
  shown = viewOf(location.hash);
  view.replaceChildren(shown.place);
  if (last !== null) shown.show(last);
  for (const link of links) {
    if (link.hash === (location.hash === '' ? '#/' : location.hash)) link.setAttribute('aria-current', 'page');
    else link.removeAttribute('aria-current');
  }
  const heading = view.querySelector('h2');
  const title = shown === overview ? '' : heading?.firstChild?.textContent ?? '';
  document.title = title === '' ? 'spoolflow live' : `${title} – spoolflow live`;
}

/** Whoever may not read sees nothing but the form. */
function askToLogIn(): void {
  last = null;
  if (shown instanceof ValveView) shown.close();
  shown = overview;
  setText(totals, '');
  account.show();
  if (!view.contains(login.place)) {
    view.replaceChildren(login.place);
    login.focus();
  }
}

function showTotals(told: Told): void {
  const { site, valves } = told;
  const bad = valves.filter((valve) => valve.ne107 !== 'good').length;
  setText(totals, `${site.valves} valves, ${bad} not good${site.stalled === 0 ? '' : `, ${site.stalled} without samples`}; ${figure(site.flow_L_min, 1)} L/min, ` +
    `${figure(site.hydraulic_power_W === null ? null : site.hydraulic_power_W / 1e3, 2)} kW hydraulic` +
    (site.store_trouble === '' ? '' : `; nothing is kept: ${site.store_trouble}`));
  const open = told.alarms.filter((alarm) => alarm.acknowledged === null).length;
  setText(alarmCount, open === 0 ? '' : String(open));
  alarmCount.hidden = open === 0;
}

/** Screen readers are told of alarms that are new since the page was opened. */
function announce(told: Told): void {
  const open = told.alarms.filter((alarm) => alarm.state === 'raised_unacknowledged');
  const fresh = open.filter((alarm) => last !== null && !last.alarms.some((known) => known.id === alarm.id && known.times === alarm.times));
  if (fresh.length > 0) setText(news, `New alarm: ${fresh.map((alarm) => `${words(alarm.cause)} of ${alarm.valve}`).join('; ')}`);
}

async function ask(): Promise<void> {
  try {
    const told = await readAll();
    answered = performance.now();
    announce(told);
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
  stale.hidden = age_s < 3;
  setText(stale, stale.hidden ? '' : `The program has not answered for ${age_s.toFixed(0)} s: what is shown is old.`);
  document.body.classList.toggle('old', !stale.hidden);
}

async function follow(): Promise<void> {
  const begun = performance.now();
  if (!view.contains(login.place)) await ask();
  showAge();
  next = window.setTimeout(() => void follow(), Math.max(200, 1000 - (performance.now() - begun)));
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
window.addEventListener('resize', () => shown instanceof ValveView && shown.resize());
onThemeChange(() => shown instanceof ValveView && shown.recolour());
view.replaceChildren(element('p', 'soft', 'Asking the program …'));
begin();
