/** The page of `spoolflow live`: asks the program once a second, and follows one valve as its samples come. */
import { figure, goodText, isOpen, readAll, words, type LiveData } from './api';
import { setText } from './element';
import { run, valveOf, type View } from './frame';
import { Overview } from './overview';
import { AlarmsView, SiteView } from './site_view';
import { ValveView } from './valve_view';

const news = document.getElementById('news')!;

function viewOf(hash: string): View<LiveData> | null {
  const valve = valveOf(hash);
  if (valve !== null) return new ValveView(valve);
  return hash === '#/alarms' ? new AlarmsView() : hash === '#/site' ? new SiteView() : null;
}

function totals({ site, valves, alarms }: LiveData): { text: string; open: number } {
  const bad = valves.filter((valve) => valve.ne107 !== 'good').length;
  const text = `${site.valves} valves, ${goodText(bad)}${site.stalled === 0 ? '' : `, ${site.stalled} without samples`}; ${figure(site.flow_L_min, 1)} L/min, ` +
    `${figure(site.hydraulic_power_W === null ? null : site.hydraulic_power_W / 1e3, 2)} kW hydraulic` +
    (site.store_trouble === '' ? '' : `; nothing is kept: ${site.store_trouble}`);
  return { text, open: alarms.filter(isOpen).length };
}

/** Screen readers announce alarms that are new since the page was opened. */
function announce(data: LiveData, before: LiveData | null): void {
  const open = data.alarms.filter((alarm) => alarm.state === 'raised_unacknowledged');
  const fresh = open.filter((alarm) => before !== null && !before.alarms.some((known) => known.id === alarm.id && known.state === alarm.state && known.times === alarm.times));
  if (fresh.length > 0) setText(news, `New alarm: ${fresh.map((alarm) => `${words(alarm.cause)} of ${alarm.valve}`).join('; ')}`);
}

run({ name: 'spoolflow live', period_ms: 1000, read: readAll, overview: new Overview(), viewOf, totals, announce });
