/** The page of `spoolflow fleet`: asks the program every few seconds how all valves stand. */
import { goodText } from '../live/api';
import { run, valveOf, type View } from '../live/frame';
import { readFleet, type FleetData } from './api';
import { AlarmsView, WorkersView } from './other_views';
import { Overview } from './overview';
import { SeriesView } from './series_view';
import { ValveView } from './valve_view';

function viewOf(hash: string): View<FleetData> | null {
  const valve = valveOf(hash);
  if (valve !== null) return new ValveView(valve);
  switch (hash) {
    case '#/alarms': return new AlarmsView();
    case '#/series': return new SeriesView();
    case '#/workers': return new WorkersView();
    default: return null;
  }
}

function totals({ valves, sites }: FleetData): { text: string; open: number } {
  const sum = (of: (site: FleetData['sites'][number]) => number): number => sites.reduce((all, site) => all + of(site), 0);
  const text = `${valves.length} valves of ${sites.length} sites, ${goodText(sum((one) => one.valves - one.ne107.good))}, ` +
    `${sum((one) => one.silent)} silent`;
  return { text, open: sum((one) => one.unacknowledged) };
}

run({ name: 'spoolflow fleet', period_ms: 3000, read: readFleet, overview: new Overview(), viewOf, totals });
