// node compare.mjs PROGRAM MODEL RECORDING ESTIMATE: runs `estimate` of the WebAssembly program (PROGRAM/playground.js and .wasm) and
// prints the largest difference of each column from ESTIMATE, which the native program wrote of the same files. Exit status 1 where the
// files differ in rows or status.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, join, resolve } from 'node:path';

const [folder, model, recording, estimate] = process.argv.slice(2).map((path) => resolve(path));
const program = await createRequire(import.meta.url)(join(folder, 'playground.js'))(
  { wasmBinary: readFileSync(join(folder, 'playground.wasm')), progress: () => {}, noInitialRun: true });
program.FS.mkdirTree('/work');
program.FS.chdir('/work');
const answer = (request) => {
  const text = JSON.stringify(request);
  const room = program.lengthBytesUTF8(text) + 1;
  const at = program._malloc(room);
  program.stringToUTF8(text, at, room);
  const out = JSON.parse(program.UTF8ToString(program._spoolflow_answer(at)));
  program._free(at);
  if (out.error !== undefined) throw new Error(out.error);
  return out;
};
const name = basename(recording);
program.FS.writeFile('model.json', readFileSync(model));
program.FS.writeFile(name, readFileSync(recording));
const begun = performance.now();
console.log(answer({ work: 'estimate', model: 'model.json', recording: name, output: 'estimate.csv' }).sentence);
console.log(`${((performance.now() - begun) / 1000).toFixed(2)} s`);
const here = Buffer.from(program.FS.readFile('estimate.csv')), native = readFileSync(estimate);
if (here.equals(native)) {
  console.log(`the same ${native.length} bytes`);
} else {
  const rows = (bytes) => bytes.toString('utf8').trim().split('\n').map((line) => line.split(','));
  const [a, b] = [rows(here), rows(native)];
  const header = b[0];
  let unlike = a.length === b.length ? 0 : 1, lines = 0;
  const largest = header.map(() => 0);
  for (let k = 1; k < Math.min(a.length, b.length); ++k) {
    if (a[k].join() !== b[k].join()) ++lines;
    header.forEach((column, c) => {
      if (column === 'status') unlike += a[k][c] === b[k][c] ? 0 : 1;
      else largest[c] = Math.max(largest[c], Math.abs(Number(a[k][c]) - Number(b[k][c])));
    });
  }
  console.log(`${lines} of ${b.length - 1} rows differ; status in ${unlike}`);
  header.forEach((column, c) => { if (column !== 'status') console.log(`${column}: ${largest[c]}`); });
  if (unlike > 0) process.exitCode = 1;
}
