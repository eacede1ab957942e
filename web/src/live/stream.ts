/** A valve's points as they come, over a WebSocket that comes back by itself. Layout: addons/live/page/plot_frame.hpp. */
export interface Point {
  time: number;
  flowMin: number;
  flowMax: number;
  lower: number;
  upper: number;
  position: number;
  current: number;
  status: number;
}

const headerBytes = 32, pointBytes = 40, mostPoints = 1500;

/** The number of the first point and the points; null where it is no frame of this version. */
export function readFrame(data: ArrayBuffer): { first: number; points: Point[] } | null {
  const view = new DataView(data);
  if (data.byteLength < headerBytes || view.getUint32(0, true) !== 1) return null;
  const count = view.getUint32(4, true);
  if (data.byteLength !== headerBytes + pointBytes * count) return null;
  const points: Point[] = [];
  for (let k = 0, at = headerBytes; k < count; ++k, at += pointBytes) {
    points.push({
      time: view.getFloat64(at, true),
      flowMin: view.getFloat32(at + 8, true),
      flowMax: view.getFloat32(at + 12, true),
      lower: view.getFloat32(at + 16, true),
      upper: view.getFloat32(at + 20, true),
      position: view.getFloat32(at + 24, true),
      current: view.getFloat32(at + 28, true),
      status: view.getUint32(at + 32, true),
    });
  }
  return { first: Number(view.getBigUint64(8, true)), points };
}

export class Stream {
  readonly points: Point[] = [];
  /** When the last new point came [ms of performance.now()]. */
  arrived = -Infinity;
  private next = 0;  // number behind the last point
  private socket: WebSocket | null = null;
  private closed = false;
  private patience = 250;

  constructor(private readonly id: string, private readonly changed: () => void) {
    this.open();
  }

  close(): void {
    this.closed = true;
    this.socket?.close();
  }

  private open(): void {
    const socket = new WebSocket(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/api/v1/valves/${encodeURIComponent(this.id)}/stream`);
    socket.binaryType = 'arraybuffer';
    socket.onmessage = (message) => this.take(message.data as ArrayBuffer);
    socket.onopen = () => {
      this.points.length = 0;  // numbers count from the program's start, which may be another
      this.next = 0;
      this.patience = 250;
    };
    socket.onclose = () => {
      if (this.closed) return;
      setTimeout(() => this.closed || this.open(), this.patience);
      this.patience = Math.min(5000, 2 * this.patience);
    };
    this.socket = socket;
  }

  private take(data: ArrayBuffer): void {
    const frame = readFrame(data);
    if (frame === null || frame.points.length === 0) return;
    const overlap = Math.min(this.next - frame.first, this.points.length);
    if (overlap >= 0 && frame.first <= this.next) this.points.length -= overlap;
    else this.points.length = 0;
    const last = this.points[this.points.length - 1];
    if (last !== undefined && frame.points[0]!.time < last.time) this.points.length = 0;  // the source began again
    const grew = frame.first + frame.points.length > this.next || overlap > 1 ||
      frame.points[frame.points.length - 1]!.time !== this.lastTime;
    this.points.push(...frame.points);
    if (this.points.length > mostPoints) this.points.splice(0, this.points.length - mostPoints);
    this.next = frame.first + frame.points.length;
    this.lastTime = frame.points[frame.points.length - 1]!.time;
    if (grew) this.arrived = performance.now();
    this.changed();
  }
  private lastTime = NaN;
}
