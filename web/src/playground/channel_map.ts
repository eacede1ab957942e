/** A channel map as text (TOML, docs/formats/channels.md) and as rows of a table. */
export interface MapRow {
  channel: string;
  column: string;
  unit: string;
  /** As written; empty: 1. */
  scale: string;
  /** As written; empty: 0. */
  offset: string;
  /** Unit of the scaled value; empty: that of `unit`. */
  to: string;
}

const numbers = ['scale', 'offset'] as const;
const texts = ['column', 'unit', 'to'] as const;

/** What is written between quotes of either kind; what stands bare, as it stands. */
function unquoted(value: string): string {
  const basic = /^"((?:[^"\\]|\\.)*)"$/.exec(value), literal = /^'([^']*)'$/.exec(value);
  if (basic) {
    try {
      return JSON.parse(`"${basic[1]}"`) as string;
    } catch {
      return basic[1];
    }
  }
  return literal ? literal[1] : value;
}

/** The rows that the text writes, a line each: `current = { column = "I", unit = "mA" }`; other lines are passed over. */
export function rowsOf(map: string): MapRow[] {
  const out: MapRow[] = [];
  for (const line of map.split('\n')) {
    const entry = /^\s*([A-Za-z_][A-Za-z0-9_]*)\s*=\s*\{(.*)\}\s*(?:#.*)?$/.exec(line);
    if (entry === null) continue;
    const row: MapRow = { channel: entry[1], column: '', unit: '', scale: '', offset: '', to: '' };
    for (const pair of entry[2].matchAll(/([a-z]+)\s*=\s*("(?:[^"\\]|\\.)*"|'[^']*'|[^,\s}]+)/g)) {
      const key = [...texts, ...numbers].find((name) => name === pair[1]);
      if (key !== undefined) row[key] = unquoted(pair[2]);
    }
    out.push(row);
  }
  return out;
}

/** The text of these rows; those without a column are left out. Lines that are no rows of it stay as they are in `before`: comments,
 *  the table's head. */
export function mapOf(rows: MapRow[], before = '[channels]\n'): string {
  const kept = before.split('\n').filter((line) => rowsOf(line).length === 0 && line.trim() !== '');
  if (!kept.some((line) => line.trim() === '[channels]')) kept.unshift('[channels]');
  const written = rows.filter((row) => row.column !== '').map((row) => {
    const parts = [`column = ${JSON.stringify(row.column)}`];
    if (row.unit !== '') parts.push(`unit = ${JSON.stringify(row.unit)}`);
    for (const name of numbers) if (row[name].trim() !== '') parts.push(`${name} = ${row[name].trim()}`);
    if (row.to !== '') parts.push(`to = ${JSON.stringify(row.to)}`);
    return `${row.channel} = { ${parts.join(', ')} }`;
  });
  return `${[...kept, ...written].join('\n')}\n`;
}
