// node build.mjs PROGRAM OUT: one page of the built program (PROGRAM/playground.js and .wasm) and of web/src/playground, as
// OUT/playground.html; run by build.sh in a folder that has the packages of web/package-lock.json.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import * as esbuild from 'esbuild';

const [program, out, root] = process.argv.slice(2);
const read = (...path) => readFileSync(join(root, ...path), 'utf8');

async function bundled(entry) {
  const script = await esbuild.build({
    absWorkingDir: join(root, 'web'), entryPoints: [entry], bundle: true, minify: true, format: 'iife', target: 'es2022', charset: 'ascii',
    legalComments: 'none', write: false,
  });
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
const parts = [
  part('program', readFileSync(join(program, 'playground.wasm'))),
  part('worker', worker),
  part('model', read('examples', 'live', 'size_6.json')),
].join('\n');
const page = read('web', 'src', 'playground', 'playground.html')
  .replace('/*style*/', () => style).replace('<!--parts-->', () => parts).replace('/*script*/', () => script);
writeFileSync(join(out, 'playground.html'), page);
const limit = 3_000_000;
console.log(`playground.html: ${page.length} bytes`);
if (page.length >= limit) throw new Error(`the page is to stay below ${limit} bytes`);
