/** A run as the page carries it. Flow and error in L/min, pressure in bar, position in mm, force in N, current in A, voltage in V,
 *  temperature in degC, time in s. */
import { channelOf, bytesOf, type Channel, type PackedChannel } from './packed_numbers';
import { SampleTimes, type PackedTimes } from './sample_times';
import type { Shown } from './readers_units';

/** `line`: a quantity. `band`: between `low` and `high`. `layer`: stacked on the layer before it, up to `top`. */
interface PackedSeries extends PackedChannel {
  name: string;
  tone: string;
  shape: 'line' | 'band' | 'layer';
  width: number;
  top?: PackedChannel;
}

interface PackedPanel {
  title: string;
  quantity: Shown;
  height: number;
  fromZero: boolean;
  series: PackedSeries[];
}

export interface StatusName {
  name: string;
  tone: string;
  share: string;
  bit: number;
}

export interface PackedRun {
  run: string;
  samplesPerStretch: number;
  fullScale: number;
  time: PackedTimes;
  panels: PackedPanel[];
  status?: { title: string; names: StatusName[]; values: string };
}

export interface Series extends Channel {
  name: string;
  tone: string;
  shape: 'line' | 'band' | 'layer';
  width: number;
  /** What is drawn: a layer's upper edge, else the quantity itself. */
  drawn: Channel;
}

export interface Panel {
  title: string;
  quantity: Shown;
  height: number;
  fromZero: boolean;
  series: Series[];
}

/** `bits[k]`: what was said in stretch k; each name has its bit. */
export interface Status {
  title: string;
  names: StatusName[];
  bits: Uint32Array;
}

export interface Run {
  name: string;
  samplesPerStretch: number;
  fullScale: number;
  times: SampleTimes;
  panels: Panel[];
  status: Status | null;
  /** The stretch at a time, and the time of that stretch. */
  indexAt(time: number): number;
  nearest(time: number): number;
}

export function runOf(packed: PackedRun): Run {
  const status = packed.status;
  const times = new SampleTimes(packed.time);
  const indexAt = (time: number): number => times.indexAt(time, packed.samplesPerStretch === 1);
  return {
    name: packed.run,
    samplesPerStretch: packed.samplesPerStretch,
    fullScale: packed.fullScale,
    times,
    indexAt,
    nearest: (time) => times.at(indexAt(time)),
    panels: packed.panels.map((panel) => ({
      ...panel,
      series: panel.series.map((series) => {
        const own = channelOf(series);
        return { ...own, name: series.name, tone: series.tone, shape: series.shape, width: series.width,
                 drawn: series.top ? channelOf(series.top) : own };
      }),
    })),
    status: status ? { ...status, bits: new Uint32Array(bytesOf(status.values).buffer) } : null,
  };
}
