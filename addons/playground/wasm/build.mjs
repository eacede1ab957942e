// node build.mjs PROGRAM OUT: one page of the built program (PROGRAM/playground.js and .wasm) and of web/src/playground, as
// OUT/playground.html; run by build.sh in a folder that has the packages of web/package-lock.json. The page holds the SHA-256 of each
// file that it was made of (PROGRAM/deps.txt names those of the program).
import { createHash } from 'node:crypto';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, relative, resolve } from 'node:path';
import { gzipSync } from 'node:zlib';
import * as esbuild from 'esbuild';

const [program, out, root] = process.argv.slice(2);
const sources = new Set();
const used = (path) => {
  const name = relative(root, resolve(root, path));
  if (!name.startsWith('..') && !/^(build|out)\/|\/node_modules\//.test(name)) sources.add(name);
};
const read = (...path) => {
  used(join(...path));
  return readFileSync(join(root, ...path), 'utf8');
};

async function bundled(entry) {
  const script = await esbuild.build({
    absWorkingDir: join(root, 'web'), entryPoints: [entry], bundle: true, minify: true, format: 'iife', target: 'es2022', charset: 'ascii',
    legalComments: 'none', write: false, metafile: true,
  });
  for (const input of Object.keys(script.metafile.inputs)) used(join('web', input));
  return script.outputFiles[0].text;
}
const dark = read('web', 'src', 'style', 'dark.css');
const sheet = [
  read('web', 'src', 'style', 'colours.css'),
  `@media screen and (prefers-color-scheme:dark){:root:not([data-theme=light]){${dark}}}`,
  `@media screen{:root[data-theme=dark]{color-scheme:dark;${dark}}:root[data-theme=light]{color-scheme:light}}`,
  read('web', 'src', 'playground', 'playground.css'),
].join('\n');
const style = (await esbuild.transform(sheet, { loader: 'css', minify: true, charset: 'ascii' })).code;
const script = await bundled('src/playground/playground.ts');
if (/<\/script|<!--/i.test(script)) throw new Error('the script would end the page’s <script> element');

const worker = readFileSync(join(program, 'playground.js'), 'utf8') + '\n' + await bundled('src/playground/worker.ts');
const packed = (bytes) => gzipSync(bytes, { level: 9 }).toString('base64');
const part = (id, bytes) => `<script type="text/plain" id="${id}">${packed(bytes)}</script>`;
for (const line of readFileSync(join(program, 'deps.txt'), 'utf8').split('\n')) {
  if (line.startsWith('    ')) used(resolve(program, line.trim()));
}
// What is carried in the program, and how all is made.
for (const name of ['page.js', 'page.css']) used(join('web', 'built', name));
for (const folder of ['examples/valves', 'addons/playground/wasm', 'addons/playground/wasm/browser', 'addons/playground/wasm/missing']) {
  for (const entry of readdirSync(join(root, folder), { withFileTypes: true })) if (entry.isFile()) used(join(folder, entry.name));
}
used('web/package-lock.json');
used('web/src/playground/playground.html');
read('examples', 'live', 'size_6.json');
const sums = [...sources].sort().map((name) => `${createHash('sha256').update(readFileSync(join(root, name))).digest('hex')}  ${name}\n`).join('');
const parts = [
  part('program', readFileSync(join(program, 'playground.wasm'))),
  part('worker', worker),
  part('model', read('examples', 'live', 'size_6.json')),
  part('sources', sums),
].join('\n');
const page = read('web', 'src', 'playground', 'playground.html')
  .replace('/*style*/', () => style).replace('<!--parts-->', () => parts).replace('/*script*/', () => script);
writeFileSync(join(out, 'playground.html'), page);
const limit = 3_000_000;
console.log(`playground.html: ${page.length} bytes, of ${sources.size} files`);
if (page.length >= limit) throw new Error(`the page is to stay below ${limit} bytes`);
