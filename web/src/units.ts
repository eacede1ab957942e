// Written by web/write_units.cpp from the table in spoolflow/units/reader_unit.cpp: change it there, then run
// ninja -C build/release web_units
/** A unit in which plots draw and read out: shown value = factor * value of the data + offset. */
export interface Unit {
  name: string;
  factor: number;
  offset: number;
  decimals: number;
}

export type Quantity = 'flow' | 'pressure' | 'position' | 'force' | 'temperature' | 'current' | 'voltage';

/** Data come in the first unit of each quantity. */
export const units: Record<Quantity, Unit[]> = {
  flow: [
    { name: 'L/min', factor: 1, offset: 0, decimals: 2 },
    { name: 'm³/h', factor: 0.06, offset: 0, decimals: 3 },
    { name: 'gal/min (US)', factor: 0.26417205235814845, offset: 0, decimals: 3 },
  ],
  pressure: [
    { name: 'bar', factor: 1, offset: 0, decimals: 1 },
    { name: 'MPa', factor: 0.1, offset: 0, decimals: 2 },
    { name: 'psi', factor: 14.503773773, offset: 0, decimals: 0 },
  ],
  position: [
    { name: 'mm', factor: 1, offset: 0, decimals: 3 },
    { name: 'µm', factor: 1000, offset: 0, decimals: 0 },
    { name: 'in', factor: 0.03937007874015748, offset: 0, decimals: 4 },
  ],
  force: [
    { name: 'N', factor: 1, offset: 0, decimals: 2 },
    { name: 'lbf', factor: 0.224808943, offset: 0, decimals: 3 },
  ],
  temperature: [
    { name: '°C', factor: 1, offset: 0, decimals: 1 },
    { name: '°F', factor: 1.8, offset: 32, decimals: 1 },
  ],
  current: [
    { name: 'A', factor: 1, offset: 0, decimals: 3 },
  ],
  voltage: [
    { name: 'V', factor: 1, offset: 0, decimals: 2 },
  ],
};
