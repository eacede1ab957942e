/** What the program answers at /api/v1 of a fleet (docs/fleet.md). */
import { read, type Alarm, type Sign, type SiteEvent } from '../live/api';

export interface FleetValve {
  id: string;
  site: string;
  series: string;
  time: string;
  age_s: number;
  silent: boolean;
  flow_L_min: number | null;
  flow_lower_L_min: number | null;
  flow_upper_L_min: number | null;
  status: string[];
  ne107: Sign;
  alarms: number;
  unacknowledged: number;
  samples: number;
  energy_J: number | null;
}

export interface FleetSite {
  site: string;
  valves: number;
  silent: number;
  ne107: Record<Sign, number>;
  alarms: number;
  unacknowledged: number;
  flow_L_min: number | null;
}

export interface Outlier {
  valve: string;
  value: number;
  uncertainty_95: number | null;
  score: number;
}
export interface SeriesIndicator {
  name: string;
  unit: string;
  valves: number;
  median: number;
  scale: number;
  outliers: { count: number; named: Outlier[] };
}
export interface Series {
  series: string;
  indicators: SeriesIndicator[];
}
export interface Distribution {
  unit: string;
  median: number;
  scale: number;
  valve: string[];
  value: number[];
  score: number[];
  outlier: boolean[];
}
export interface Partition {
  partition: number;
  epoch: number;
  valves: number;
  blocks: number;
  behind_s: number | null;
  owner: string | null;
}

export const readValves = async (): Promise<FleetValve[]> => (await read<{ valves: FleetValve[] }>('/api/v1/valves')).valves;
export const readSites = async (): Promise<FleetSite[]> => (await read<{ sites: FleetSite[] }>('/api/v1/sites')).sites;
const of = (valve: string): string => valve === '' ? '' : `?valve=${encodeURIComponent(valve)}`;
export const readAlarms = async (valve = ''): Promise<Alarm[]> => (await read<{ alarms: Alarm[] }>(`/api/v1/alarms${of(valve)}`)).alarms;
export const readEvents = async (valve = ''): Promise<SiteEvent[]> =>
  (await read<{ events: SiteEvent[] }>(`/api/v1/events${of(valve)}`)).events;
export const readSeries = async (): Promise<Series[]> => (await read<{ series: Series[] }>('/api/v1/series')).series;
export const readDistribution = (series: string, indicator: string): Promise<Distribution> =>
  read<Distribution>(`/api/v1/distribution?series=${encodeURIComponent(series)}&indicator=${encodeURIComponent(indicator)}`);
export const readPartitions = async (): Promise<Partition[]> =>
  (await read<{ partitions: Partition[] }>('/api/v1/partitions')).partitions;

/** All of a few seconds. */
export interface FleetData {
  valves: FleetValve[];
  sites: FleetSite[];
  alarms: Alarm[];
}
export async function readFleet(): Promise<FleetData> {
  const [valves, sites, alarms] = await Promise.all([readValves(), readSites(), readAlarms()]);
  return { valves, sites, alarms };
}
