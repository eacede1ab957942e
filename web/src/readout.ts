/** What stands at the cursor, in the reader's units. Each name is a button that hides and shows its line. */
import type { Panel, Run, Series } from './run_data';
import { numberText } from './number_text';
import type { Unit } from './units';

/** Values of a series at a stretch: "45.12", "44.90 to 45.30" of a band or of a stretch of several samples. */
export function valueText(series: Series, index: number, unit: Unit): string {
  const text = (value: number): string => numberText(value * unit.factor, unit.decimals);
  const low = text(series.lowest.at(index));
  const high = text(series.highest.at(index));
  return low === high ? low : `${low} to ${high}`;
}

export class Readout {
  readonly element = document.createElement('div');
  private readonly title = document.createElement('b');
  private readonly values = new Map<Series, HTMLElement>();

  constructor(private readonly panel: Panel, onToggle: (series: Series, shown: boolean) => void) {
    this.element.className = 'readout';
    this.element.append(this.title);
    for (const series of panel.series) this.element.append(this.chip(series, onToggle));
  }

  showUnit(unit: Unit): void {
    this.title.textContent = `${this.panel.title} [${unit.name}]`;
  }

  /** `index` null: no cursor. */
  show(index: number | null, unit: Unit): void {
    for (const [series, value] of this.values) value.textContent = index === null ? '' : valueText(series, index, unit);
  }

  /** For screen readers: "measured 45.12 L/min". */
  sentence(index: number, unit: Unit): string {
    return this.panel.series.map((series) => `${series.name} ${valueText(series, index, unit)} ${unit.name}`).join(', ');
  }

  private chip(series: Series, onToggle: (series: Series, shown: boolean) => void): HTMLElement {
    const chip = document.createElement('button');
    chip.type = 'button';
    chip.className = 'chip';
    chip.setAttribute('aria-pressed', 'true');
    chip.title = 'hide or show';
    const swatch = document.createElement('i');
    swatch.className = `swatch ${series.shape} ${series.tone}`;
    const value = document.createElement('output');
    value.setAttribute('aria-live', 'off');
    value.dataset.series = series.name;
    this.values.set(series, value);
    chip.append(swatch, series.name, value);
    chip.addEventListener('click', () => {
      const shown = chip.getAttribute('aria-pressed') !== 'true';
      chip.setAttribute('aria-pressed', String(shown));
      onToggle(series, shown);
    });
    return chip;
  }
}

/** Names that the status holds at a stretch. */
export function statusText(run: Run, index: number): string {
  const status = run.status;
  if (!status) return '';
  const said = status.names.filter(({ bit }) => (status.bits[index] & (1 << bit)) !== 0).map((each) => each.name);
  return said.length === 0 ? 'none' : said.join(', ');
}
