// Bundles src/ with esbuild, compresses every file and writes page_assets.cpp, by which they become part of dncd (server/web).
// node tools/build.mjs FOLDER
import { createHash } from 'node:crypto';
import { mkdir, readFile, rm, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const web = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
const folder = path.resolve(process.argv[2]);
const out = path.join(folder, 'page');

const kTypes = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript; charset=utf-8', '.css': 'text/css; charset=utf-8' };

async function bundle() {
  const result = await build({
    absWorkingDir: web,
    entryPoints: ['src/main.tsx', 'src/style/page.css'],
    outdir: path.join(out, 'assets'),
    entryNames: '[name]-[hash]',
    chunkNames: '[name]-[hash]',
    bundle: true,
    splitting: true,
    minify: true,
    format: 'esm',
    target: 'es2022',
    jsx: 'automatic',
    jsxImportSource: 'preact',
    legalComments: 'none',
    metafile: true,
    write: false,
    logLevel: 'warning',
  });
  return { files: result.outputFiles, outputs: result.metafile.outputs };
}

/// The entry, what it imports at once, and the style: all that the first view needs.
function headOf(outputs) {
  const name = (file) => `/assets/${path.basename(file)}`;
  const tags = [];
  for (const [file, output] of Object.entries(outputs)) {
    if (output.entryPoint === 'src/style/page.css') tags.push(`<link rel="stylesheet" href="${name(file)}" />`);
    if (output.entryPoint !== 'src/main.tsx') continue;
    const needed = output.imports.filter((i) => i.kind === 'import-statement');
    tags.push(...needed.map((i) => `<link rel="modulepreload" href="${name(i.path)}" />`));
    tags.push(`<script type="module" src="${name(file)}"></script>`);
  }
  return tags.join('\n    ');
}

/// `address` is the path of a URL, without its first slash.
async function keep(address, content) {
  const file = path.join(out, address === '' ? 'index.html' : address);
  const gzip = gzipSync(content, { level: 9 });
  await mkdir(path.dirname(file), { recursive: true });
  await writeFile(`${file}.gz`, gzip);
  const etag = createHash('sha256').update(content).digest('hex').slice(0, 32);
  return { address, file: `${file}.gz`, etag, type: kTypes[path.extname(file)], size: gzip.length };
}

/// The assembler includes the bytes; a string literal of half a MiB would take the compiler seconds.
function sourceText(assets) {
  const symbol = (i) => `dripline_page_asset_${i}`;
  const data = assets.map((a, i) => `.globl ${symbol(i)}\n.hidden ${symbol(i)}\n${symbol(i)}:\n.incbin ${JSON.stringify(a.file)}\n`
    + `.globl ${symbol(i)}_end\n.hidden ${symbol(i)}_end\n${symbol(i)}_end:\n`).join('');
  const declarations = assets.map((_, i) => `extern const char ${symbol(i)}[], ${symbol(i)}_end[];`).join('\n');
  const rows = assets.map((a, i) => `    {${JSON.stringify(a.address)}, ${JSON.stringify(a.type)}, "\\"${a.etag}\\"",\n`
    + `     {${symbol(i)}, static_cast<std::size_t>(${symbol(i)}_end - ${symbol(i)})}},`).join('\n');
  return `// Made by clients/web/tools/build.mjs.
#include "server/web/page_assets.hpp"

asm(R"(.pushsection .rodata
${data}.popsection
)");

extern "C" {
#pragma GCC visibility push(hidden)
${declarations}
#pragma GCC visibility pop
}

namespace dripline::web {

std::span<const Asset> embedded_assets() {
  static const Asset kAssets[] = {
${rows}
  };
  return kAssets;
}

}  // namespace dripline::web
`;
}

await rm(out, { recursive: true, force: true });
const { files, outputs } = await bundle();
const html = (await readFile(path.join(web, 'index.html'), 'utf8')).replace('<!--assets-->', () => headOf(outputs));
const assets = [await keep('', html)];
for (const file of files) assets.push(await keep(`assets/${path.basename(file.path)}`, file.contents));
await writeFile(path.join(out, 'sizes.json'), JSON.stringify(Object.fromEntries(assets.map((a) => [a.address, a.size])), null, 1));
await writeFile(path.join(folder, 'page_assets.cpp'), sourceText(assets));
