/** What the plots of a run show, as text: the range of time and the traces that are on, in the reader's units. */
import { inUnit } from './readers_units';
import { statusText } from './readout';
import type { Panel, Run, Series } from './run_data';
import type { Column } from './packed_numbers';
import type { Unit } from './units';

export interface ShownPanel {
  panel: Panel;
  unit: Unit;
  series: Series[];
}

/** Fields that hold commas or quotes are quoted (RFC 4180). */
function field(text: string): string {
  return /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
}

/** Recorded times are numbers of at most this many digits; values come as 16-bit codes. */
const timeDigits = 12;
const valueDigits = 7;

/** Samples from `from` to `to`; of a stretch of several samples the smallest and the largest value. Unknown: empty. */
export function visibleCsv(run: Run, shown: ShownPanel[], from: number, to: number): string {
  const heads = ['time [s]'];
  const columns: { column: Column; unit: Unit }[] = [];
  for (const { panel, unit, series } of shown) {
    for (const each of series) {
      const edges = each.shape === 'band' ? ['lower', 'upper'] : each.lowest === each.highest ? [''] : ['smallest', 'largest'];
      edges.forEach((edge, k) => {
        heads.push(`${[`${panel.title}: ${each.name}`, edge].join(' ').trim()} [${unit.name}]`);
        columns.push({ column: k === 0 ? each.lowest : each.highest, unit });
      });
    }
  }
  if (run.status) heads.push('status');
  const lines = [heads.map(field).join(',')];
  for (let k = run.times.countUntil(from - 1e-9); k < run.times.length && run.times.at(k) <= to + 1e-9; ++k) {
    const row = [String(Number(run.times.at(k).toPrecision(timeDigits)))];
    for (const { column, unit } of columns) {
      const value = inUnit(column.at(k), unit);
      row.push(Number.isNaN(value) ? '' : String(Number(value.toPrecision(valueDigits))));
    }
    if (run.status) row.push(field(statusText(run, k).replace(/, /g, '|')));
    lines.push(row.join(','));
  }
  return `${lines.join('\n')}\n`;
}
