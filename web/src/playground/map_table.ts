/** A channel map as a table: of each channel the file's column, its unit, and what is made of its numbers. */
import { button, element } from '../element';
import { mapOf, rowsOf, type MapRow } from './channel_map';

/** Units that are read (docs/formats/channels.md), as proposals of what may be typed. */
const units = ['s', 'ms', 'us', 'A', 'mA', 'V', 'mV', 'mm', 'um', 'm', 'in', 'percent', '1', 'N', 'kN', 'bar', 'mbar', 'Pa', 'kPa', 'MPa', 'psi', 'C', 'K', 'degF',
  'L/min', 'L/s', 'm3/s', 'm3/h', 'gal/min'];

export class MapTable {
  readonly root = element('div', 'map-table');
  private readonly table = element('table', '');
  private rows: MapRow[] = [];

  /** `columns`: of the file. `wanted`: channels that have no row in the map, and might. `text`: the map as TOML, which both change. */
  constructor(private readonly columns: string[], private readonly wanted: string[], private readonly text: HTMLTextAreaElement) {
    const known = document.createElement('datalist');
    known.id = 'map-units';
    known.append(...units.map((unit) => new Option(unit, unit)));
    const more = element('input', '');
    more.setAttribute('aria-label', 'another channel');
    more.placeholder = 'pressure_difference';
    const tools = element('div', 'tools');
    tools.append(more, button('Add a channel', 'Add a row for this channel', () => {
      const channel = more.value.trim();
      if (!/^[a-z_]+$/.test(channel) || this.rows.some((row) => row.channel === channel)) return;
      this.rows.push({ channel, column: '', unit: '', scale: '', offset: '', to: '' });
      more.value = '';
      this.show();
    }));
    this.root.append(known, this.table, tools);
    text.addEventListener('input', () => this.read());
    this.read();
  }

  /** What the text says now. */
  read(): void {
    const written = rowsOf(this.text.value);
    const without = this.wanted.filter((channel) => !written.some((row) => row.channel === channel));
    this.rows = [...written, ...without.map((channel) => ({ channel, column: '', unit: '', scale: '', offset: '', to: '' }))];
    this.show();
  }

  private write(): void {
    this.text.value = mapOf(this.rows, this.text.value);
  }

  private show(): void {
    const head = element('tr', '');
    for (const name of ['channel', 'column of the file', 'unit', 'scale', 'offset', 'to']) {
      const cell = document.createElement('th');
      cell.scope = 'col';
      cell.textContent = name;
      head.append(cell);
    }
    this.table.replaceChildren(head, ...this.rows.map((row) => this.line(row)));
  }

  private line(row: MapRow): HTMLElement {
    const out = element('tr', '');
    const name = document.createElement('th');
    name.scope = 'row';
    name.textContent = row.channel;
    const column = element('select', '');
    column.setAttribute('aria-label', `column of ${row.channel}`);
    column.add(new Option('not in the file', ''));
    for (const each of this.columns) column.add(new Option(each, each));
    if (row.column !== '' && !this.columns.includes(row.column)) column.add(new Option(`${row.column} (not in the file)`, row.column));
    column.value = row.column;
    column.addEventListener('change', () => {
      row.column = column.value;
      this.write();
    });
    const cell = (content: HTMLElement): HTMLTableCellElement => {
      const made = document.createElement('td');
      made.append(content);
      return made;
    };
    const field = (key: 'unit' | 'scale' | 'offset' | 'to', hint: string): HTMLTableCellElement => {
      const input = element('input', '');
      input.setAttribute('aria-label', `${key} of ${row.channel}`);
      input.value = row[key];
      input.placeholder = hint;
      if (key === 'unit' || key === 'to') input.setAttribute('list', 'map-units');
      else input.inputMode = 'decimal';
      input.addEventListener('input', () => {
        const valid = key === 'unit' || key === 'to' || input.value.trim() === '' || Number.isFinite(Number(input.value));
        input.setAttribute('aria-invalid', String(!valid));
        if (!valid) return;
        row[key] = input.value.trim();
        this.write();
      });
      return cell(input);
    };
    out.append(name, cell(column), field('unit', '?'), field('scale', '1'), field('offset', '0'), field('to', ''));
    return out;
  }
}
