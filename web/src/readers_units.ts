/** The reader's units: what the plots draw and read out. */
import { units, type Quantity, type Unit } from './units';

/** A value of the data in the reader's unit. */
export function inUnit(value: number, unit: Unit): number {
  return value * unit.factor + unit.offset;
}

/** What a plot shows: a quantity, or the error of the flow. */
export type Shown = Quantity | 'error';

export interface Choice {
  quantity: Shown;
  label: string;
  names: string[];
}

function choiceOf(quantity: Quantity): Choice {
  const label = quantity[0].toUpperCase() + quantity.slice(1);
  return { quantity, label, names: units[quantity].map((unit) => unit.name) };
}

/** What the reader can choose, where there are several: a quantity, its name, the units' names. */
export const choices: Choice[] = [
  choiceOf('flow'),
  { quantity: 'error', label: 'Error', names: ['% of full scale', 'as flow'] },
  choiceOf('pressure'),
  choiceOf('position'),
  choiceOf('force'),
  choiceOf('temperature'),
];

export class ReadersUnits {
  private readonly chosen: Record<Shown, number> = {
    flow: 0, error: 0, pressure: 0, position: 0, force: 0, temperature: 0, current: 0, voltage: 0,
  };
  private readonly listeners: (() => void)[] = [];

  /** `page`: the root's data attributes, by which a page says in which units it was made (`flowUnit`: place of the unit). */
  constructor(page: DOMStringMap = {}) {
    for (const { quantity, names } of choices) {
      const index = Number(page[`${quantity}Unit`] ?? 0);
      if (index > 0 && index < names.length) this.chosen[quantity] = index;
    }
  }

  chosenOf(quantity: Shown): number {
    return this.chosen[quantity];
  }

  choose(quantity: Shown, index: number): void {
    this.chosen[quantity] = index;
    for (const listener of this.listeners) listener();
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** `fullScale`: of the valve, in the data's unit of flow. */
  unitOf(quantity: Shown, fullScale: number): Unit {
    if (quantity !== 'error') return units[quantity][this.chosen[quantity]];
    return this.chosen.error === 0 ? { name: '% FS', factor: 100 / fullScale, offset: 0, decimals: 2 } : units.flow[this.chosen.flow];
  }
}
