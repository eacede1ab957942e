/** The page of `spoolflow live`: asks the program once a second, and follows one valve as its samples come. */
import { figure, readEvents, readSite, readValves } from './api';
import { setText } from './element';
import { Overview } from './overview';
import { themeControl, onThemeChange } from '../theme';
import { ValveView } from './valve_view';

const view = document.getElementById('view')!;
const totals = document.getElementById('totals')!;
const stale = document.getElementById('stale')!;
document.getElementById('controls')!.append(themeControl());

const overview = new Overview();
let shown: Overview | ValveView | null = null;
let answered = performance.now();

function route(): void {
  const valve = /^#\/valve\/(.+)$/.exec(location.hash);
  if (shown instanceof ValveView) shown.close();
  shown = valve === null ? overview : new ValveView(decodeURIComponent(valve[1]!));
  view.replaceChildren(shown.place);
  document.title = valve === null ? 'spoolflow live' : `${decodeURIComponent(valve[1]!)} – spoolflow live`;
}

async function ask(): Promise<void> {
  try {
    const [valves, events, site] = await Promise.all([readValves(), readEvents(), readSite()]);
    answered = performance.now();
    shown?.show(valves, events);
    const raised = valves.filter((valve) => valve.ne107 !== 'good').length;
    setText(totals, `${site.valves} valves, ${raised} not good; ${figure(site.flow_L_min, 1)} L/min, ` +
      `${figure(site.hydraulic_power_W === null ? null : site.hydraulic_power_W / 1e3, 2)} kW hydraulic` +
      (site.store_trouble === '' ? '' : `; nothing is kept: ${site.store_trouble}`));
  } catch {
    // told below, as long as it lasts
  }
  const age_s = (performance.now() - answered) / 1000;
  stale.hidden = age_s < 3;
  setText(stale, stale.hidden ? '' : `The program has not answered for ${age_s.toFixed(0)} s: what is shown is old.`);
  document.body.classList.toggle('old', !stale.hidden);
  setTimeout(() => void ask(), 1000);
}

window.addEventListener('hashchange', route);
window.addEventListener('resize', () => shown instanceof ValveView && shown.redraw());
onThemeChange(() => shown instanceof ValveView && shown.redraw());
route();
void ask();
