/** The last seconds of the virtual valve on a canvas: flow as estimated with its band, and as it truly is. */
import { colour, paleColour } from '../colours';
import { niceStep } from '../live/plot';

export interface PlayedColumns {
  time_s: number[];
  flow_L_min: number[];
  flow_lower_L_min: number[];
  flow_upper_L_min: number[];
  true_flow_L_min: number[];
  position_mm: number[];
  current_A: number[];
  status: string;
}
export type Line = 'flow_L_min' | 'flow_lower_L_min' | 'flow_upper_L_min' | 'true_flow_L_min' | 'position_mm';

export const window_s = 12;
const kept = 200 * window_s + 50;

export class ValvePlot {
  readonly canvas = document.createElement('canvas');
  readonly columns = new Map<Line | 'time_s', number[]>();

  constructor() {
    this.canvas.className = 'valve-plot';
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', 'flow rate as estimated with its band, as it truly is, and position, over the last seconds');
  }

  add(samples: PlayedColumns): void {
    for (const name of ['time_s', 'flow_L_min', 'flow_lower_L_min', 'flow_upper_L_min', 'true_flow_L_min', 'position_mm'] as const) {
      const column = this.columns.get(name) ?? [];
      column.push(...samples[name]);
      if (column.length > kept) column.splice(0, column.length - kept);
      this.columns.set(name, column);
    }
  }

  clear(): void {
    this.columns.clear();
  }

  draw(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const paint = this.canvas.getContext('2d');
    const time = this.columns.get('time_s') ?? [];
    if (width === 0 || height === 0 || paint === null || time.length === 0) return;
    this.canvas.width = Math.round(width * devicePixelRatio);
    this.canvas.height = Math.round(height * devicePixelRatio);
    paint.scale(devicePixelRatio, devicePixelRatio);
    paint.font = '12px system-ui, sans-serif';
    const split = Math.round(0.68 * height);
    this.pane(paint, 'flow rate [L/min]', { left: 44, top: 22, width: width - 52, height: split - 34 }, ['true_flow_L_min', 'flow_L_min'], true);
    this.pane(paint, 'spool position [mm]', { left: 44, top: split + 12, width: width - 52, height: height - split - 34 }, ['position_mm'], false);
    paint.fillStyle = colour('soft');
    paint.textAlign = 'left';
    paint.fillText(`${window_s} s ago`, 44, height - 6);
    paint.textAlign = 'right';
    paint.fillText('now', width - 8, height - 6);
  }

  private pane(paint: CanvasRenderingContext2D, title: string, box: { left: number; top: number; width: number; height: number },
               lines: Line[], band: boolean): void {
    const time = this.columns.get('time_s') as number[];
    const end = time[time.length - 1];
    const of = (name: Line): number[] => this.columns.get(name) as number[];
    let highest = band ? 10 : 1, lowest = 0;
    for (const name of [...lines, ...(band ? ['flow_upper_L_min', 'flow_lower_L_min'] as const : [])]) {
      for (const value of of(name)) {
        if (value > highest) highest = value;
        if (value < lowest) lowest = value;
      }
    }
    highest *= 1.05;
    const x = (k: number): number => box.left + box.width * (1 - (end - time[k]) / window_s);
    const y = (value: number): number => box.top + box.height * (1 - (value - lowest) / (highest - lowest));
    paint.fillStyle = colour('soft');
    paint.strokeStyle = colour('rule');
    paint.textAlign = 'left';
    paint.fillText(title, box.left, box.top - 7);
    paint.textAlign = 'right';
    const step = niceStep(highest - lowest);
    for (let value = Math.ceil(lowest / step) * step; value <= highest; value += step) {
      paint.beginPath();
      paint.moveTo(box.left, y(value));
      paint.lineTo(box.left + box.width, y(value));
      paint.stroke();
      paint.fillText(String(Number(value.toPrecision(6))), box.left - 6, y(value) + 4);
    }
    paint.save();
    paint.beginPath();
    paint.rect(box.left, box.top, box.width, box.height);
    paint.clip();
    if (band) {
      const [lower, upper] = [of('flow_lower_L_min'), of('flow_upper_L_min')];
      paint.fillStyle = paleColour('observer', 0.25);
      paint.beginPath();
      lower.forEach((value, k) => paint.lineTo(x(k), y(value)));
      for (let k = upper.length - 1; k >= 0; --k) paint.lineTo(x(k), y(upper[k]));
      paint.fill();
    }
    for (const name of lines) {
      paint.strokeStyle = colour(name === 'true_flow_L_min' ? 'ink' : 'observer');
      paint.lineWidth = name === 'true_flow_L_min' ? 1 : 1.8;
      paint.beginPath();
      of(name).forEach((value, k) => paint.lineTo(x(k), y(value)));
      paint.stroke();
    }
    paint.restore();
  }
}
