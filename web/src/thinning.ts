/** Long series made short enough for the pixels there are, with every peak kept: each bucket of neighbours is drawn by its
 *  smallest and its largest value. */
import { missing, type Channel, type Column } from './packed_numbers';
import type { SampleTimes } from './sample_times';

/** Stretches [from, to) of a run, drawn in `buckets` buckets; or each by one point where there is room for all. */
export interface DrawnRange {
  from: number;
  to: number;
  buckets: number;
  everySample: boolean;
}

export function drawnRange(times: SampleTimes, begin: number, end: number, buckets: number, oneSampleEach: boolean): DrawnRange {
  // One more on either side, so that lines leave the picture rather than end in it.
  const from = Math.max(0, times.countUntil(begin) - 2);
  const to = Math.min(times.length, times.countUntil(end) + 2);
  const everySample = oneSampleEach && to - from <= 2 * buckets;
  return { from, to, buckets: Math.min(buckets, to - from), everySample };
}

/** First stretch of bucket `b`. */
export function bucketBegin(range: DrawnRange, b: number): number {
  return range.from + Math.floor(((range.to - range.from) * b) / range.buckets);
}

export function drawnTimes(times: SampleTimes, range: DrawnRange): number[] {
  const out: number[] = [];
  if (range.everySample) {
    for (let k = range.from; k < range.to; ++k) out.push(times.at(k));
    return out;
  }
  for (let b = 0; b < range.buckets; ++b) {
    const begin = bucketBegin(range, b);
    const next = Math.min(times.length - 1, bucketBegin(range, b + 1));
    out.push(times.at(begin), 0.5 * (times.at(begin) + times.at(next)));
  }
  return out;
}

function smallest(column: Column, begin: number, end: number): number {
  let code = 32767 + 1;
  for (let k = begin; k < end; ++k) {
    const each = column.codes[k];
    if (each !== missing && each < code) code = each;
  }
  return code > 32767 ? missing : code;
}

function largest(column: Column, begin: number, end: number): number {
  let code = missing;  // the smallest code there is
  for (let k = begin; k < end; ++k) {
    if (column.codes[k] > code) code = column.codes[k];
  }
  return code;
}

function drawn(value: number, factor: number, offset: number): number | null {
  return Number.isNaN(value) ? null : value * factor + offset;
}

/** Two values a bucket, the smallest and the largest; null breaks the line. `factor` and `offset`: into the reader's unit. */
export function drawnLine(channel: Channel, range: DrawnRange, factor: number, offset = 0): (number | null)[] {
  const out: (number | null)[] = [];
  if (range.everySample) {
    for (let k = range.from; k < range.to; ++k) out.push(drawn(channel.lowest.at(k), factor, offset));
    return out;
  }
  for (let b = 0; b < range.buckets; ++b) {
    const begin = bucketBegin(range, b);
    const end = bucketBegin(range, b + 1);
    out.push(drawn(channel.lowest.valueOf(smallest(channel.lowest, begin, end)), factor, offset),
             drawn(channel.highest.valueOf(largest(channel.highest, begin, end)), factor, offset));
  }
  return out;
}

/** An edge of a band: of each bucket the value that is farther out, twice. */
export function drawnEdge(column: Column, range: DrawnRange, factor: number, upper: boolean, offset = 0): (number | null)[] {
  const out: (number | null)[] = [];
  if (range.everySample) {
    for (let k = range.from; k < range.to; ++k) out.push(drawn(column.at(k), factor, offset));
    return out;
  }
  for (let b = 0; b < range.buckets; ++b) {
    const farthest = upper ? largest : smallest;
    const value = drawn(column.valueOf(farthest(column, bucketBegin(range, b), bucketBegin(range, b + 1))), factor, offset);
    out.push(value, value);
  }
  return out;
}
