/** The last half minute of a valve on a canvas: flow with its band, position and current over time, and when which status was set. */
import type { Point } from './stream';

const window_s = 30, faultBits = 0xffff0000, rowHeight = 22, mostRows = 4, markRoom = 16;

/** Of the status word. */
export interface Bit {
  name: string;
  mask: number;
}
const isFault = (bit: Bit): boolean => (bit.mask & faultBits) !== 0;

interface Pane {
  title: string;
  lower: (point: Point) => number;
  upper: (point: Point) => number;
  band: boolean;
}

const panes: Pane[] = [
  { title: 'flow [L/min] with its 95 % band', lower: (p) => p.flowMin, upper: (p) => p.flowMax, band: true },
  { title: 'position [mm]', lower: (p) => p.position, upper: (p) => p.position, band: false },
  { title: 'current [A]', lower: (p) => p.current, upper: (p) => p.current, band: false },
];

function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** A step of 1, 2 or 5 times a power of ten that divides the range into three to seven. */
export function niceStep(range: number): number {
  const power = 10 ** Math.floor(Math.log10(range / 3));
  for (const factor of [5, 2, 1]) {
    if (range / (factor * power) >= 3) return factor * power;
  }
  return power;
}

/** The step of marks on an axis of that length in pixels, which stand apart by what their text needs. */
export const markStep = (range: number, length: number): number => niceStep(range * Math.max(1, 7.5 * markRoom / length));

/** How long before the last sample, of which `age` is said where it is old. */
export function timeMark(before: number, age: string): string {
  if (before === 0) return age === '' ? 'now' : `${age} ago`;
  return age === '' ? `\u2212${before} s` : `${before} s before`;
}

export class Plot {
  /** How old the last sample is, in words; empty: it is new. */
  age = '';
  readonly canvas = document.createElement('canvas');
  bits: readonly Bit[] = [];

  constructor() {
    this.canvas.className = 'plot';
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', 'flow rate, position and current of the last 30 seconds');
  }

  draw(points: readonly Point[]): void {
    const ratio = devicePixelRatio;
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width === 0 || height === 0) return;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    const paint = this.canvas.getContext('2d');
    if (paint === null) return;
    paint.scale(ratio, ratio);
    paint.font = '12px system-ui, sans-serif';
    const end = points.length > 0 ? points[points.length - 1]!.time : 0;
    const shown = points.filter((point) => point.time >= end - window_s);
    const heights = [0.5, 0.25, 0.25], axis = 18;
    const said = this.said(shown);
    const strip = said.length === 0 ? 0 : 8 + rowHeight * said.length;
    let top = 0;
    panes.forEach((pane, k) => {
      const tall = heights[k]! * (height - strip);
      this.pane(paint, pane, shown, end, { left: 56, top: top + 18, width: width - 64, height: tall - 26 - axis });
      this.times(paint, { left: 56, top: top + tall - axis - 8, width: width - 64, height: axis });
      top += tall;
    });
    said.forEach((bit, row) => this.strip(paint, bit, shown, end,
                                          { left: 56, top: height - strip + 8 + rowHeight * row, width: width - 64, height: rowHeight - 4 }));
    this.canvas.setAttribute('aria-label', `flow rate, position and current of the last ${window_s} seconds` +
      `${this.age === '' ? '' : ` before the last sample, ${this.age} ago`}` +
      `${said.length === 0 ? '' : `; status: ${said.map((bit) => bit.name).join(', ')}`}`);
  }

  private pane(paint: CanvasRenderingContext2D, pane: Pane, points: readonly Point[], end: number,
               box: { left: number; top: number; width: number; height: number }): void {
    let lowest = Infinity, highest = -Infinity;
    for (const point of points) {
      const from = pane.band ? Math.min(point.lower, pane.lower(point)) : pane.lower(point);
      const to = pane.band ? Math.max(point.upper, pane.upper(point)) : pane.upper(point);
      if (from < lowest) lowest = from;
      if (to > highest) highest = to;
    }
    if (!(highest > lowest)) {
      const middle = Number.isFinite(lowest) ? lowest : 0;
      lowest = middle - 0.5;
      highest = middle + 0.5;
    }
    const margin = 0.05 * (highest - lowest);
    lowest -= margin;
    highest += margin;
    const x = (time: number): number => box.left + box.width * (1 - (end - time) / window_s);
    const y = (value: number): number => box.top + box.height * (1 - (value - lowest) / (highest - lowest));

    paint.fillStyle = colour('--soft');
    paint.textAlign = 'left';
    paint.fillText(pane.title, box.left, box.top - 5);
    paint.textAlign = 'right';
    paint.strokeStyle = colour('--rule');
    paint.lineWidth = 1;
    const step = markStep(highest - lowest, box.height);
    for (let tick = Math.ceil(lowest / step) * step; tick <= highest; tick += step) {
      paint.beginPath();
      paint.moveTo(box.left, y(tick));
      paint.lineTo(box.left + box.width, y(tick));
      paint.stroke();
      paint.fillText(String(Number(tick.toPrecision(6))), box.left - 6, y(tick) + 4);
    }
    if (pane.band) {
      paint.fillStyle = colour('--ramp-a');
      paint.globalAlpha = 0.35;
      this.area(paint, points, x, (point) => y(point.lower), (point) => y(point.upper));
      paint.globalAlpha = 1;
    }
    paint.strokeStyle = colour('--observer');
    paint.lineWidth = 1.5;
    paint.beginPath();
    for (const point of points) {
      paint.lineTo(x(point.time), y(pane.upper(point)));
      paint.lineTo(x(point.time), y(pane.lower(point)));
    }
    paint.stroke();
  }

  private area(paint: CanvasRenderingContext2D, points: readonly Point[], x: (time: number) => number,
               from: (point: Point) => number, to: (point: Point) => number): void {
    paint.beginPath();
    for (const point of points) paint.lineTo(x(point.time), from(point));
    for (let k = points.length - 1; k >= 0; --k) paint.lineTo(x(points[k]!.time), to(points[k]!));
    paint.closePath();
    paint.fill();
  }

  /** The bits that any of the points has, faults first, as far as there is room for their names. */
  private said(points: readonly Point[]): Bit[] {
    let all = 0;
    for (const point of points) all |= point.status;
    return this.bits.filter((bit) => (all & bit.mask) !== 0)
      .sort((a, b) => Number(isFault(b)) - Number(isFault(a)) || a.mask - b.mask).slice(0, mostRows);
  }

  private times(paint: CanvasRenderingContext2D, box: { left: number; top: number; width: number; height: number }): void {
    paint.fillStyle = colour('--soft');
    paint.strokeStyle = colour('--rule');
    const step = box.width >= 420 ? 5 : this.age === '' ? 10 : 15;
    for (let ago = 0; ago <= window_s; ago += step) {
      const x = box.left + box.width * (1 - ago / window_s);
      paint.textAlign = ago === 0 ? 'right' : ago === window_s ? 'left' : 'center';
      paint.fillText(timeMark(ago, this.age), x, box.top + 13);
      paint.beginPath();
      paint.moveTo(x, box.top - 3);
      paint.lineTo(x, box.top + 1);
      paint.stroke();
    }
  }

  /** When one bit was set, with its name in front where there is room, else above. */
  private strip(paint: CanvasRenderingContext2D, bit: Bit, points: readonly Point[], end: number,
                box: { left: number; top: number; width: number; height: number }): void {
    paint.fillStyle = colour(isFault(bit) ? '--fault' : '--soft');
    paint.textAlign = 'left';
    paint.fillText(bit.name.replace(/_/g, ' '), box.left, box.top + 10);
    for (const point of points) {
      if ((point.status & bit.mask) === 0) continue;
      paint.fillRect(box.left + box.width * (1 - (end - point.time) / window_s), box.top + 13,
                     Math.max(1, box.width * 0.02 / window_s), 5);
    }
  }
}
