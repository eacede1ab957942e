/** What the program answers at /api/v1 (docs/live.md). */
export interface Indicator {
  name: string;
  value: number | null;
  unit: string;
  uncertainty_95: number | null;
  baseline: number | null;
  /** Values beyond count towards an alarm; null: none is judged on that side. Not in alarms. */
  alarm_below?: number | null;
  alarm_above?: number | null;
  trend?: Trend | null;
  state: string;
}

/** Where the slope is beyond chance. */
export interface Trend {
  per_hour: number;
  uncertainty_95: number;
  limit: number;
  hours_to_limit: number | null;
  hours_to_limit_95: [number | null, number | null];
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
  ne107: Sign;
  causes: { cause: string; odds: number | null }[];
  samples: number;
  energy_J: number | null;
  indicators: Indicator[];
  /** What speaks against units and wiring of its samples. */
  findings: string[];
  source: {
    kind: string; stalled: boolean; age_s: number | null; trouble: string;
    received: number; dropped: number; lost: number; repeated: number; unreadable: number; connections: number; port?: number;
  };
}

export type Sign = 'good' | 'M' | 'S' | 'C' | 'F';

export interface SiteEvent {
  id: number;
  time: string;
  valve: string;
  kind: string;
  text: string;
}

export interface Alarm {
  /** Ascending in each list of alarms: of a site, or of one valve of a fleet. */
  id: number;
  /** How a fleet calls it: "SITE/ID/NUMBER". */
  key?: string;
  valve: string;
  cause: string;
  ne107: Sign;
  state: 'raised_unacknowledged' | 'raised_acknowledged' | 'gone_unacknowledged' | 'cleared' | 'shelved';
  raised: string;
  times: number;
  gone: string | null;
  acknowledged: string | null;
  acknowledged_by: string | null;
  text: string;
  /** In words; null where the cause has none. */
  meaning?: string | null;
  remedy?: string | null;
  /** Whose course shows how fast it grows. */
  indicator?: string | null;
  /** Not in a fleet's. */
  shelved_until?: string | null;
  shelved_by?: string | null;
  comments?: { time: string; by: string; text: string }[];
  recording: number | null;
  indicators: Indicator[];
}

export interface Recording {
  id: number;
  time: string;
  valve: string;
  why: string;
}

/** What the valve's model says of itself. */
export interface ModelHistory {
  file: string;
  calibrated: string;
  simulated: boolean;
  /** Newest first. */
  references: { time: string; reasons: string[]; edge_width: number; friction_ratio: number; position_zero_m: number; direction?: 'a' | 'b' }[];
  drift_in_30_days: ModelDrift | null;
  /** Of a whole valve; the one above is then of P to B. */
  drift_in_30_days_p_to_a?: ModelDrift | null;
}

export type ModelDrift = Record<'edge_width' | 'friction' | 'position_zero_m', { value: number; uncertainty_95: number }>;

/** Who sends samples of a valve that the site does not know. */
export interface Stranger {
  valve: string;
  sender: string;
  first: string;
  last: string;
}

/** What goes out beside the page: to a bus, a broker, receivers of messages, a fleet. */
export interface Output {
  sent: number;
  received: number;
  dropped: number;
  waiting: number;
  connected: number;
  /** Why nothing goes out; empty: it does. */
  trouble: string;
}

export interface Site {
  valves: number;
  stalled: number;
  flow_L_min: number | null;
  hydraulic_power_W: number | null;
  store: string;
  store_trouble: string;
  store_mended: { time: string; text: string } | null;
  /** Of the status word. */
  status_bits: Record<string, number>;
  udp: { port: number; datagrams: number; unreadable: number; unknown_valve: number; not_allowed: number; refused: number;
    unknown: (Stranger & { datagrams: number })[] };
  /** The broker that samples come from. */
  mqtt_source: { broker: string; connected: boolean; messages: number; unknown_valve: number;
    unknown: (Stranger & { messages: number })[] } | null;
  outputs: Record<string, Output>;
}

export interface Session {
  account: string | null;
  role: 'none' | 'read' | 'acknowledge';
  accounts: boolean;
}

/** All of one second. */
export interface LiveData {
  valves: Valve[];
  events: SiteEvent[];
  alarms: Alarm[];
  site: Site;
}

type Column = (number | null)[];
export interface IndicatorHistory {
  name: string;
  unit: string;
  time_ms: number[];
  value: Column;
  smallest: Column;
  largest: Column;
  uncertainty_95: Column;
  baseline: Column;
  raised: boolean[];
}
export interface FlowHistory {
  time_ms: number[];
  flow_mean_L_min: Column;
  flow_min_L_min: Column;
  flow_max_L_min: Column;
  flow_lower_L_min: Column;
  flow_upper_L_min: Column;
  power_W: Column;
}

/** An answer that is none of what was asked for. */
export class Refusal extends Error {
  constructor(readonly status: number, text: string) {
    super(text);
  }
}

async function answered<T>(path: string, options: RequestInit, patience_ms = 10_000): Promise<T> {
  const answer = await fetch(path, { cache: 'no-store', signal: AbortSignal.timeout(patience_ms), ...options });
  if (!answer.ok) throw new Refusal(answer.status, (await answer.text()).trim());
  return await answer.json() as T;
}
export const read = <T>(path: string): Promise<T> => answered<T>(path, {});
/** Days wait for those that others read. */
const readLong = <T>(path: string): Promise<T> => answered<T>(path, {}, 60_000);
const post = <T>(path: string, body: unknown = {}): Promise<T> =>
  answered<T>(path, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body) });

export async function readAll(): Promise<LiveData> {
  const [valves, events, alarms, site] = await Promise.all([
    read<{ valves: Valve[] }>('/api/v1/valves'), read<{ events: SiteEvent[] }>('/api/v1/events'),
    read<{ alarms: Alarm[] }>('/api/v1/alarms'), read<Site>('/api/v1/site')]);
  return { valves: valves.valves, events: events.events, alarms: alarms.alarms, site };
}
/** Of a valve in each of the last seconds, the oldest first. */
export interface Recent {
  id: string;
  flow_L_min: Column;
  flow_lower_L_min: Column;
  flow_upper_L_min: Column;
}
export const readRecent = async (): Promise<Recent[]> => (await read<{ valves: Recent[] }>('/api/v1/recent')).valves;
export const readRecordings = async (): Promise<Recording[]> =>
  (await read<{ recordings: Recording[] }>('/api/v1/recordings')).recordings;
export const readModel = (id: string): Promise<ModelHistory> => read<ModelHistory>(`/api/v1/valves/${encodeURIComponent(id)}/model`);
export const readSession = (): Promise<Session> => read<Session>('/api/v1/session');
export const logIn = (name: string, password: string): Promise<Session> => post<Session>('/api/v1/login', { name, password });
export const logOut = (): Promise<Session> => post<Session>('/api/v1/logout');
export const keyOf = (alarm: Alarm): string => alarm.key ?? String(alarm.id);
/** `what`: "acknowledge", "shelve", "unshelve" or "comment". */
export const act = (key: string, what: string, body: unknown = {}): Promise<Alarm> => post<Alarm>(`/api/v1/alarms/${key}/${what}`, body);
/** Whether nobody has seen it who should. */
export const isOpen = (alarm: Alarm): boolean => alarm.acknowledged === null && alarm.state !== 'shelved';

/** Of seconds since 1970. */
const between = (id: string, what: string, from: number, to: number): string =>
  `/api/v1/valves/${encodeURIComponent(id)}/${what}?from=${from.toFixed(0)}&to=${Math.ceil(to).toFixed(0)}`;
export const readIndicators = async (id: string, from: number, to: number): Promise<IndicatorHistory[]> =>
  (await readLong<{ indicators: IndicatorHistory[] }>(between(id, 'indicators', from, to))).indicators;
export const readFlow = (id: string, from: number, to: number): Promise<FlowHistory> =>
  readLong<FlowHistory>(between(id, 'history', from, to));

/** Each sign of NAMUR NE 107 in words. */
export const signs: Record<Sign, string> = {
  good: 'good',
  M: 'maintenance required',
  S: 'out of specification',
  C: 'function check',
  F: 'failure',
};
export const severity: Record<Sign, number> = { good: 0, M: 1, S: 2, C: 3, F: 4 };

export function figure(value: number | null, digits: number): string {
  return value === null ? '–' : value.toFixed(digits).replace(/^-(?=[0.]*$)/, '').replace(/^-/, '−');
}

/** "all good", "3 not good". */
export const goodText = (bad: number): string => bad === 0 ? 'all good' : `${bad} not good`;

/** Whether what is known of a valve is old: no samples come, none came since the start, or its recording has ended. */
export function isOld({ source }: Valve): boolean {
  const longest_s = 5;
  return source.stalled || (source.age_s ?? Infinity) > longest_s;
}

/** That two senders use the valve's id, while its samples come; a trouble of other sources is that none come. */
export const rivalText = (valve: Valve): string => isOld(valve) || valve.source.kind !== 'udp' ? '' : valve.source.trouble;

/** "12 s", "5 min", "3 h", "2 days". */
export function duration(seconds: number): string {
  if (seconds < 120) return `${seconds.toFixed(0)} s`;
  if (seconds < 7200) return `${(seconds / 60).toFixed(0)} min`;
  return seconds < 172800 ? `${(seconds / 3600).toFixed(0)} h` : `${(seconds / 86400).toFixed(0)} days`;
}

/** Of indicators the most informative ones, in their order; those of solenoid a count with those of b. */
const first = ['friction_ratio', 'edge_rounding', 'spring_preload_ratio', 'spring_rate_ratio', 'shorted_turns', 'position_zero',
  'coil_resistance', 'breakaway_force', 'hysteresis_width', 'stick_slip_share', 'response_time', 'winding_warmer_than_reference'];

/** Raised ones first of all, then the twelve most informative ones, what else is judged or learnt, and counters apart. */
export function grouped(indicators: readonly Indicator[]): { shown: Indicator[]; more: Indicator[]; counters: Indicator[] } {
  const rank = (one: Indicator): number => {
    const at = first.indexOf(one.name.replace(/_a$/, ''));
    return one.state === 'raised' ? -1 : at < 0 ? first.length : at;
  };
  const judged = indicators.filter((one) => one.state !== 'counts');
  const shown = judged.filter((one) => rank(one) < first.length).sort((a, b) => rank(a) - rank(b));
  return { shown, more: judged.filter((one) => rank(one) === first.length), counters: indicators.filter((one) => one.state === 'counts') };
}

/** How an indicator changes, and when it reaches its limit; empty where it has no trend. */
export function trendText(one: Indicator): string {
  if (one.trend == null) return '';
  const { factor, unit } = inUnit(one), { per_hour, limit, hours_to_limit } = one.trend;
  const days = Math.abs(per_hour * 24 * factor) < 1000, of = unit === '' ? '' : ` ${unit}`;
  const rate = `${per_hour * factor > 0 ? '+' : ''}${short(per_hour * factor * (days ? 24 : 1))}${of} ${days ? 'a day' : 'an hour'}`;
  const its = `its limit of ${short(limit * factor)}${of}`;
  const beyond = one.value !== null && (per_hour < 0 ? one.value <= limit : one.value >= limit);
  if (beyond) return `${rate}; it is beyond ${its}`;
  if (hours_to_limit === null) return rate;
  // The line through the last points runs ahead of the value, which is of all that was learnt.
  return hours_to_limit <= 0 ? `${rate}; by its trend it is about to reach ${its}`
    : `${rate}; reaches ${its} in about ${duration(3600 * hours_to_limit)} at work`;
}

/** Four digits that matter, for figures of any size. */
export function short(value: number | null): string {
  if (value === null) return '–';
  const size = Math.abs(value);
  const text = size !== 0 && (size < 1e-3 || size >= 1e6) ? value.toExponential(2) : String(Number(value.toPrecision(4)));
  return text.replace(/-/g, '−');
}

/** A value by its uncertainty, of which two digits matter: "0.94 ± 0.13", "1250 ± 120"; without one four digits. */
export function measured(one: Indicator): string {
  const { factor, unit } = inUnit(one), value = scaled(one.value, factor), about = scaled(one.uncertainty_95, factor);
  const of = unit === '' ? '' : ` ${unit}`;
  if (value === null || about === null || !(about >= 1e-6 && about < 1e6)) return `${short(value)} ± ${short(about)}${of}`;
  const decimals = 1 - Math.floor(Math.log10(Number(about.toPrecision(2)))), step = 10 ** -decimals;
  const text = (number: number): string => decimals < 0 ? figure(Math.round(number / step) * step, 0) : figure(number, decimals);
  return `${text(value)} ± ${text(about)}${of}`;
}

/** What the monitor thinks of; an alarm of it that stands is its decision, as a raised indicator is. */
export function causesText({ id, causes, indicators }: Valve, alarms: readonly Alarm[]): string {
  const raised = indicators.some((one) => one.state === 'raised');
  const standing = new Set(alarms.filter((one) => one.valve === id && one.gone === null).map((one) => one.cause));
  const listed = (decided: boolean): string => causes.filter((one) => (raised || standing.has(one.cause)) === decided)
    .map((one) => `${words(one.cause)} (odds ${short(one.odds)})`).join(', ');
  return [['Likely', listed(true)], ['Suspected, not decided', listed(false)]]
    .flatMap(([how, which]) => which === '' ? [] : [`${how}: ${which}`]).join('. ');
}

export const words = (name: string): string => name.replace(/_/g, ' ');

/** Of an indicator as people write it: micrometres for wear, percent for shares of turns. */
export function inUnit(one: { name: string; unit: string }): { factor: number; unit: string } {
  if (one.unit === 'm' && !one.name.startsWith('distance')) return { factor: 1e6, unit: 'µm' };
  if (one.name.startsWith('shorted_turns')) return { factor: 100, unit: '%' };
  if (one.unit === 'Ohm') return { factor: 1, unit: 'Ω' };
  return { factor: 1, unit: one.unit === '1' ? '' : one.unit === 'm3' ? 'm³' : one.unit };
}
export function scaled(value: number | null, factor: number): number | null {
  return value === null ? null : value * factor;
}

/** "2026-11-22 10:30:05" of the reader's clock. */
export function clock(time: string | number): string {
  const at = new Date(time), two = (value: number): string => String(value).padStart(2, '0');
  return `${at.getFullYear()}-${two(at.getMonth() + 1)}-${two(at.getDate())} ` +
    `${two(at.getHours())}:${two(at.getMinutes())}:${two(at.getSeconds())}`;
}
