import { bytesOf } from './packed_numbers';

/** Times of the stretches: even steps, or 32-bit counts of a tick. */
export interface PackedTimes {
  start: number;
  count: number;
  step?: number;
  tick?: number;
  values?: string;
}

export class SampleTimes {
  readonly length: number;
  private readonly start: number;
  private readonly step: number;
  private readonly counts: Uint32Array | null;

  constructor(packed: PackedTimes) {
    this.length = packed.count;
    this.start = packed.start;
    this.counts = packed.values === undefined ? null : new Uint32Array(bytesOf(packed.values).buffer);
    this.step = (this.counts ? packed.tick : packed.step) ?? 1;
  }

  at(index: number): number {
    return this.start + this.step * (this.counts ? this.counts[index] : index);
  }

  /** How many times are not later than `time`. */
  countUntil(time: number): number {
    let begin = 0;
    let end = this.length;
    while (begin < end) {
      const middle = (begin + end) >> 1;
      if (this.at(middle) <= time) begin = middle + 1;
      else end = middle;
    }
    return begin;
  }

  /** Index of the sample nearest in time, or of the stretch that `time` lies in. */
  indexAt(time: number, everySample: boolean): number {
    const before = Math.max(0, this.countUntil(time) - 1);
    if (!everySample || before + 1 >= this.length) return before;
    return this.at(before + 1) - time < time - this.at(before) ? before + 1 : before;
  }
}
