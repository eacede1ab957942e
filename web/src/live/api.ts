/** What the program tells at /api/v1 (docs/live.md). */
export interface Indicator {
  name: string;
  value: number | null;
  unit: string;
  uncertainty_95: number | null;
  baseline: number | null;
  state: string;
}

export interface Valve {
  id: string;
  time_s: number | null;
  flow_L_min: number | null;
  flow_lower_L_min: number | null;
  flow_upper_L_min: number | null;
  pressure_difference_bar: number | null;
  rated_flow_L_min: number;
  status: string[];
  ne107: 'good' | 'M' | 'S' | 'C' | 'F';
  causes: { cause: string; odds: number | null }[];
  samples: number;
  energy_J: number | null;
  indicators: Indicator[];
  source: {
    kind: string; stalled: boolean; age_s: number | null; trouble: string;
    received: number; dropped: number; lost: number; repeated: number; unreadable: number; connections: number; port?: number;
  };
}

export interface SiteEvent {
  id: number;
  time: string;
  valve: string;
  kind: string;
  text: string;
  acknowledged: string | null;
}

export interface Recording {
  id: number;
  time: string;
  valve: string;
  why: string;
}

export interface Site {
  valves: number;
  stalled: number;
  flow_L_min: number | null;
  hydraulic_power_W: number | null;
  store: string;
  store_trouble: string;
}

async function read<T>(path: string): Promise<T> {
  const answer = await fetch(path, { cache: 'no-store', signal: AbortSignal.timeout(5000) });
  if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
  return await answer.json() as T;
}

export const readValves = async (): Promise<Valve[]> => (await read<{ valves: Valve[] }>('/api/v1/valves')).valves;
export const readEvents = async (): Promise<SiteEvent[]> => (await read<{ events: SiteEvent[] }>('/api/v1/events')).events;
export const readRecordings = async (): Promise<Recording[]> =>
  (await read<{ recordings: Recording[] }>('/api/v1/recordings')).recordings;
export const readSite = (): Promise<Site> => read<Site>('/api/v1/site');

/** Each sign of NAMUR NE 107 in words. */
export const signs: Record<Valve['ne107'], string> = {
  good: 'good',
  M: 'maintenance required',
  S: 'out of specification',
  C: 'function check',
  F: 'failure',
};

export function figure(value: number | null, digits: number): string {
  return value === null ? '–' : value.toFixed(digits);
}

/** Four digits that matter, for figures of any size. */
export function short(value: number | null): string {
  if (value === null) return '–';
  const size = Math.abs(value);
  return size !== 0 && (size < 1e-3 || size >= 1e6) ? value.toExponential(3) : String(Number(value.toPrecision(4)));
}
