// node build.mjs FOLDER: makes page.js and page.css of the report pages, and live.html, live.js and live.css of the page of
// `spoolflow live`, and fleet.html, fleet.js and fleet.css of that of `spoolflow fleet`, which the program carries inside.
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import * as esbuild from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const folder = process.argv[2] ?? join(here, 'built');
const read = (...path) => readFileSync(join(here, ...path), 'utf8');

const licence = read('node_modules', 'uplot', 'LICENSE').trim();
async function bundled(entry, banner) {
  const script = await esbuild.build({
    absWorkingDir: here,
    entryPoints: [entry],
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2020',
    charset: 'ascii',
    legalComments: 'none',
    ...(banner === undefined ? {} : { banner: { js: banner } }),
    write: false,
  });
  return script.outputFiles[0].text;
}
const uplot = `/* Contains uPlot:\n${licence}\n*/`;
const page = await bundled('src/page.ts', uplot);
if (/<\/script|<!--/i.test(page)) throw new Error('the script would end the page’s <script> element');

// The dark colours are written once: for systems that are dark, and for readers who chose dark on the page.
const dark = read('src', 'style', 'dark.css');
const colours = [
  read('src', 'style', 'colours.css'),
  `@media screen and (prefers-color-scheme:dark){:root:not([data-theme=light]){${dark}}}`,
  `@media screen{:root[data-theme=dark]{color-scheme:dark;${dark}}:root[data-theme=light]{color-scheme:light}}`,
];
const sheet = [
  ...colours,
  read('src', 'style', 'text.css'),
  read('src', 'style', 'figures.css'),
  read('node_modules', 'uplot', 'dist', 'uPlot.min.css'),
  read('src', 'style', 'plots.css'),
  read('src', 'style', 'narrow.css'),
  read('src', 'style', 'print.css'),
].join('\n');
const minified = async (css) => (await esbuild.transform(css, { loader: 'css', minify: true, charset: 'ascii' })).code;

writeFileSync(join(folder, 'page.js'), page);
writeFileSync(join(folder, 'page.css'), await minified(sheet));
const live = [...colours, read('node_modules', 'uplot', 'dist', 'uPlot.min.css'), read('src', 'live', 'live.css')];
for (const [name, styles] of [['live', live], ['fleet', [...live, read('src', 'fleet', 'fleet.css')]]]) {
  writeFileSync(join(folder, `${name}.js`), await bundled(`src/${name}/${name}.ts`, uplot));
  writeFileSync(join(folder, `${name}.css`), await minified(styles.join('\n')));
  writeFileSync(join(folder, `${name}.html`), read('src', name, `${name}.html`));
}
