/** What stands at the cursor, and by how much it differs from what stands at cursor A, in the reader's units. Each name is
 *  a button that hides and shows its line; buttons beside them zoom into the values. */
import type { Panel, Run, Series } from './run_data';
import { button } from './element';
import { numberText } from './number_text';
import { inUnit } from './readers_units';
import type { Unit } from './units';

/** Values of a series at a stretch: "45.12", "44.90 to 45.30" of a band or of a stretch of several samples. */
export function valueText(series: Series, index: number, unit: Unit): string {
  const text = (value: number): string => numberText(inUnit(value, unit), unit.decimals);
  const low = text(series.lowest.at(index));
  const high = text(series.highest.at(index));
  return low === high ? low : `${low} to ${high}`;
}

/** Of a stretch of several samples the middle of its smallest and largest value. */
export function middleOf(series: Series, index: number): number {
  return 0.5 * (series.lowest.at(index) + series.highest.at(index));
}

/** "+1.20"; nothing for bands, whose edges are no values. */
export function differenceText(series: Series, from: number, to: number, unit: Unit): string {
  if (series.shape === 'band') return '';
  const difference = (middleOf(series, to) - middleOf(series, from)) * unit.factor;
  const text = numberText(difference, unit.decimals);
  return difference > 0 && /[1-9]/.test(text) ? `+${text}` : text;
}

/** What a readout's buttons do. */
export interface PanelActs {
  toggle(series: Series, shown: boolean): void;
  zoomHeightBy(factor: number): void;
}

export class Readout {
  readonly element = document.createElement('div');
  private readonly title = document.createElement('b');
  private readonly values = new Map<Series, { value: HTMLElement; difference: HTMLElement }>();

  constructor(private readonly panel: Panel, private readonly acts: PanelActs) {
    this.element.className = 'readout';
    this.element.append(this.title);
    for (const series of panel.series) this.element.append(this.chip(series));
    const { title } = panel;
    const taller = button('↕+', `Zoom into the values of: ${title}`, () => acts.zoomHeightBy(0.5));
    const flatter = button('↕−', `Zoom out of the values of: ${title}`, () => acts.zoomHeightBy(2));
    for (const each of [taller, flatter]) each.classList.add('small');
    const room = document.createElement('span');
    room.className = 'heights';
    room.append(taller, flatter);
    this.element.append(room);
  }

  showUnit(unit: Unit): void {
    this.title.textContent = `${this.panel.title} [${unit.name}]`;
  }

  /** `index` null: no cursor. `from`: where cursor A stands, if it does. */
  show(index: number | null, from: number | null, unit: Unit): void {
    for (const [series, { value, difference }] of this.values) {
      value.textContent = index === null ? '' : valueText(series, index, unit);
      const text = index === null || from === null ? '' : differenceText(series, from, index, unit);
      difference.textContent = text === '' ? '' : `Δ ${text}`;
    }
  }

  /** For screen readers: "measured 45.12 L/min". */
  sentence(index: number, from: number | null, unit: Unit): string {
    return this.panel.series.map((series) => {
      const difference = from === null ? '' : differenceText(series, from, index, unit);
      const suffix = difference === '' ? '' : `, difference ${difference}`;
      return `${series.name} ${valueText(series, index, unit)} ${unit.name}${suffix}`;
    }).join(', ');
  }

  private chip(series: Series): HTMLElement {
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
    const difference = document.createElement('output');
    difference.className = 'difference';
    difference.setAttribute('aria-live', 'off');
    difference.dataset.difference = series.name;
    this.values.set(series, { value, difference });
    chip.append(swatch, series.name, value, difference);
    chip.addEventListener('click', () => {
      const shown = chip.getAttribute('aria-pressed') !== 'true';
      chip.setAttribute('aria-pressed', String(shown));
      this.acts.toggle(series, shown);
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
