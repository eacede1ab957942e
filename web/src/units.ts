/** The reader's units: what the plots draw and read out. Data come in the first unit of each quantity. */
export interface Unit {
  name: string;
  factor: number;
  decimals: number;
}

export type Quantity = 'flow' | 'error' | 'pressure' | 'position' | 'force';

const flowUnits: Unit[] = [
  { name: 'L/min', factor: 1, decimals: 2 },
  { name: 'm³/h', factor: 0.06, decimals: 3 },
  { name: 'gal/min (US)', factor: 1 / 3.785411784, decimals: 3 },
];

const units: Record<Exclude<Quantity, 'error'>, Unit[]> = {
  flow: flowUnits,
  pressure: [
    { name: 'bar', factor: 1, decimals: 1 },
    { name: 'MPa', factor: 0.1, decimals: 2 },
    { name: 'psi', factor: 14.503773773, decimals: 0 },
  ],
  position: [
    { name: 'mm', factor: 1, decimals: 3 },
    { name: 'µm', factor: 1000, decimals: 0 },
    { name: 'in', factor: 1 / 25.4, decimals: 4 },
  ],
  force: [
    { name: 'N', factor: 1, decimals: 2 },
    { name: 'lbf', factor: 0.224808943, decimals: 3 },
  ],
};

/** What the reader can choose: a quantity, its name, the units' names. */
export const choices: { quantity: Quantity; label: string; names: string[] }[] = [
  { quantity: 'flow', label: 'Flow', names: flowUnits.map((unit) => unit.name) },
  { quantity: 'error', label: 'Error', names: ['% of full scale', 'as flow'] },
  { quantity: 'pressure', label: 'Pressure', names: units.pressure.map((unit) => unit.name) },
  { quantity: 'position', label: 'Position', names: units.position.map((unit) => unit.name) },
  { quantity: 'force', label: 'Force', names: units.force.map((unit) => unit.name) },
];

export class ReadersUnits {
  private readonly chosen: Record<Quantity, number> = { flow: 0, error: 0, pressure: 0, position: 0, force: 0 };
  private readonly listeners: (() => void)[] = [];

  /** `page`: the root's data attributes, by which a page says in which units it was made (`flowUnit`: place of the unit). */
  constructor(page: DOMStringMap = {}) {
    for (const { quantity, names } of choices) {
      const index = Number(page[`${quantity}Unit`] ?? 0);
      if (index > 0 && index < names.length) this.chosen[quantity] = index;
    }
  }

  chosenOf(quantity: Quantity): number {
    return this.chosen[quantity];
  }

  choose(quantity: Quantity, index: number): void {
    this.chosen[quantity] = index;
    for (const listener of this.listeners) listener();
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** `fullScale`: of the valve, in the data's unit of flow. */
  unitOf(quantity: Quantity, fullScale: number): Unit {
    if (quantity !== 'error') return units[quantity][this.chosen[quantity]];
    return this.chosen.error === 0 ? { name: '% FS', factor: 100 / fullScale, decimals: 2 } : flowUnits[this.chosen.flow];
  }
}

/** With a true minus sign and no negative zero; a dash for what is not known. */
export function numberText(value: number, decimals: number): string {
  if (!Number.isFinite(value)) return '–';
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && /[1-9]/.test(text) ? `−${text}` : text;
}
