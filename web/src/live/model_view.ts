/** What the valve's model says of itself: its age, what references moved it to, how fast it drifts. */
import { clock, duration, readModel, type ModelDrift, type ModelHistory } from './api';
import { element, row, setText } from './element';

const columns = ['when', 'edge width [%]', 'friction [%]', 'position zero [\u00b5m]'];
const shown = 12;

const signed = (value: number, decimals: number): string => `${value < 0 ? '\u2212' : '+'}${Math.abs(value).toFixed(decimals)}`;

function named(line: HTMLElement): HTMLElement {
  columns.forEach((name, k) => { (line.children[k] as HTMLElement).dataset['name'] = name; });
  return line;
}

/** ", P to A" of one direction of a whole valve. */
const flowOf = (direction: 'a' | 'b' | undefined): string => (direction === undefined ? '' : direction === 'a' ? ', P to A' : ', P to B');

/** "in 30 days +0.4 ± 0.9" of each column. */
function driftRow(drift: ModelDrift, direction: 'a' | 'b' | undefined): HTMLElement {
  const cell = (rate: { value: number; uncertainty_95: number }, scale: number, decimals: number): string =>
    `${signed(scale * rate.value, decimals)} ± ${(scale * rate.uncertainty_95).toFixed(decimals)}`;
  return named(row('td', `drift in 30 days, \u00b1 95 %${flowOf(direction)}`, cell(drift.edge_width, 100, 1), cell(drift.friction, 100, 1),
                   cell(drift.position_zero_m, 1e6, 1)));
}

export class ModelView {
  readonly place = element('section', '');
  private readonly about = element('p', 'source');
  private readonly rows = element('tbody', '');
  private readonly table: HTMLElement;

  constructor(id: string) {
    this.table = element('div', 'wide', element('table', 'indicators stacked model', element('thead', '', row('th', ...columns)), this.rows));
    this.table.hidden = true;
    this.place.append(element('h3', '', 'Model'), this.about, this.table);
    void readModel(id).then((model) => this.show(model)).catch(() => setText(this.about, 'What the model says of itself cannot be read.'));
  }

  private show(model: ModelHistory): void {
    const ago = (time: string): string => `${duration((Date.now() - Date.parse(time)) / 1000)} ago`;
    const { references, drift_in_30_days: drift, drift_in_30_days_p_to_a: other = null } = model, last = references[0];
    const whole = model.drift_in_30_days_p_to_a !== undefined;
    const looks = new Set(references.map((one) => one.time)).size;  // each is of both directions of a whole valve
    setText(this.about, `${model.file === '' ? 'the demonstration' : model.file}, calibrated ${ago(model.calibrated)} ` +
      `(${clock(model.calibrated)})${model.simulated ? ' from simulated recordings' : ''}; ` +
      (last === undefined ? 'references have not looked at it since.'
        : `references have looked at it ${looks === 1 ? 'once' : `${looks} times`}, the last time ${ago(last.time)}.`));
    this.table.hidden = last === undefined;
    this.rows.replaceChildren(
      ...(drift === null ? [] : [driftRow(drift, whole ? 'b' : undefined)]),
      ...(other === null ? [] : [driftRow(other, 'a')]),
      ...references.slice(0, shown).map((one) => {
        const line = named(row('td', `${clock(one.time)}${flowOf(one.direction)}`, signed(100 * one.edge_width, 1), signed(100 * (one.friction_ratio - 1), 1),
                               signed(1e6 * one.position_zero_m, 1)));
        line.title = one.reasons.join('\n');
        return line;
      }));
  }
}
