// A synthetic run of a valve at 1 kHz: slow triangles of the spool, a pressure that swings, and one instant at which the
// reference meter jumps.
export const long = 1_000_000;
export const spikeAt = 7777;
export const gap = { from: 4000, to: 6000 };

export function channels(k) {
  const time_s = k / 1000;
  const phase = (time_s / 8) % 2;
  const share = phase < 1 ? phase : 2 - phase;
  const bar = 40 + 20 * Math.sin(time_s / 3);
  const flow = k === spikeAt ? 66.5 : 60 * share * Math.sqrt(bar / 60);
  return {
    time_s: time_s.toFixed(3),
    current_A: (0.25 + 1.5 * share + 0.1 * Math.sin(40 * time_s)).toFixed(4),
    position_mm: (2.2 * share).toFixed(4),
    voltage_V: (24 * (0.1 + 0.5 * share)).toFixed(2),
    oil_temperature_C: (50 + 2 * Math.sin(time_s / 100)).toFixed(3),
    pressure_difference_bar: bar.toFixed(3),
    flow_reference_L_min: flow.toFixed(3),
  };
}
