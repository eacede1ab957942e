// tables.mjs NAME: NAME.parquet by hyparquet and NAME.mcap by @mcap/core against NAME.csv, which hold the same rows.
import assert from "node:assert/strict";
import { open, readFile } from "node:fs/promises";
import { McapIndexedReader } from "@mcap/core";
import { decompress } from "fzstd";
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
    const told = group.columns[k].meta_data.statistics;
    assert.equal(told.min_value + 0, rows.reduce((a, b) => Math.min(a, b)) + 0); // -0 tells of either zero
    assert.equal(told.max_value + 0, rows.reduce((a, b) => Math.max(a, b)) + 0);
    assert.equal(Number(told.null_count), Number(group.num_rows) - rows.length);
  }
}

const handle = await open(`${name}.mcap`);
const size = BigInt((await handle.stat()).size);
const readable = {
  size: async () => size,
  read: async (offset, length) => {
    const buffer = new Uint8Array(Number(length));
    const { bytesRead } = await handle.read(buffer, 0, Number(length), Number(offset));
    assert.equal(bytesRead, Number(length));
    return buffer;
  },
};
const mcap = await McapIndexedReader.Initialize({
  readable,
  decompressHandlers: { zstd: (buffer, unpacked) => decompress(buffer, new Uint8Array(Number(unpacked))) },
});
assert.equal(mcap.statistics.messageCount, BigInt(lines.length));
assert.equal(mcap.chunkIndexes.length, mcap.statistics.chunkCount);
const [channel] = mcap.channelsById.values();
assert.equal(channel.topic, "/estimate");
assert.equal(channel.messageEncoding, "json");
numbers.forEach((column, k) => assert.equal(channel.metadata.get(`${column}.unit`), units[k]));
const schema = mcap.schemasById.get(channel.schemaId);
assert.equal(schema.encoding, "jsonschema");
assert.deepEqual(Object.keys(JSON.parse(new TextDecoder().decode(schema.data)).properties), columns);
let origin_s;
for await (const metadata of mcap.readMetadata()) origin_s = Number(metadata.metadata.get("time_origin_s"));
const messages = [];
for await (const message of mcap.readMessages({ validateCrcs: true })) messages.push(message);
assert.equal(messages.length, lines.length);
messages.sort((a, b) => a.sequence - b.sequence);
messages.forEach((message, k) => {
  const row = JSON.parse(new TextDecoder().decode(message.data));
  agrees(k, lines[k], (column) => row[column] ?? null);
  for (const column of numbers) assert.equal(row[column] ?? null, table[k][column]); // to the last digit
  if (row.time_s !== undefined) assert.equal(Number(message.logTime), Math.round((row.time_s - origin_s) * 1e9));
  else assert.equal(message.logTime, messages[k - 1].logTime);
});
await handle.close();
console.log(`${name}: ${lines.length} rows in ${about.row_groups.length} row groups and ${mcap.chunkIndexes.length} chunks, from ${origin_s} s`);
