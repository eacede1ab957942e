// tables.mjs NAME: NAME.parquet by hyparquet against NAME.csv, which holds the same rows.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { parquetMetadata, parquetReadObjects } from "hyparquet";
import { compressors } from "hyparquet-compressors";

const name = process.argv[2];
const decimals = [6, 6, 6, 6, 4, 3, 3, 3];
const units = ["s", "L/min", "L/min", "L/min", "bar", "N", "N", "N"];

const [header, ...lines] = (await readFile(`${name}.csv`, "utf8")).trimEnd().split("\n");
const columns = header.split(",");
const numbers = columns.slice(0, -1);

function agrees(row, line, value) {
  const cells = line.split(",");
  numbers.forEach((column, k) => {
    const number = value(column);
    if (cells[k] === "") assert.equal(number, null, `${name} row ${row} ${column}`);
    else assert.ok(Math.abs(number - Number(cells[k])) <= 0.501 * 10 ** -decimals[k], `${name} row ${row} ${column}: ${number} is not ${cells[k]}`);
  });
  assert.equal(value("status"), cells.at(-1), `${name} row ${row} status`);
}

const bytes = await readFile(`${name}.parquet`);
const file = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
const about = parquetMetadata(file);
assert.deepEqual(about.schema.slice(1).map((each) => each.name), columns);
assert.equal(Number(about.num_rows), lines.length);
const notes = Object.fromEntries(about.key_value_metadata.map(({ key, value }) => [key, value]));
numbers.forEach((column, k) => assert.equal(notes[`${column}.unit`], units[k]));
const table = await parquetReadObjects({ file, compressors });
assert.equal(table.length, lines.length);
table.forEach((row, k) => agrees(k, lines[k], (column) => row[column]));
for (const [k, column] of numbers.entries()) {
  let at = 0;
  for (const group of about.row_groups) {
    const rows = table.slice(at, (at += Number(group.num_rows))).map((row) => row[column]).filter((value) => value !== null);
    const statistics = group.columns[k].meta_data.statistics;
    assert.equal(statistics.min_value + 0, rows.reduce((a, b) => Math.min(a, b)) + 0); // -0 stands for either zero
    assert.equal(statistics.max_value + 0, rows.reduce((a, b) => Math.max(a, b)) + 0);
    assert.equal(Number(statistics.null_count), Number(group.num_rows) - rows.length);
  }
}

console.log(`${name}: ${lines.length} rows in ${about.row_groups.length} row groups`);
