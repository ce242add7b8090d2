// Puts the editor into build/editor: the page, its two bundles, the library in WebAssembly, the examples, and licences of what is bundled. Any static server can serve it.

import { cpSync, existsSync, mkdirSync, rmSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { build } from 'esbuild';

const root = new URL('../', import.meta.url).pathname;
const out = join(root, 'build/editor');
const core = ['vspring_core.js', 'vspring_core.wasm', 'vspring_core_threads.js', 'vspring_core_threads.worker.js', 'vspring_core_threads.wasm'].map((name) => join(root, 'build/wasm', name));
const missing = core.find((path) => !existsSync(path));
if (missing) {
  console.error(`${missing} does not exist: run bindings/wasm/build first`);
  process.exit(1);
}

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
const options = { absWorkingDir: join(root, 'editor'), bundle: true, minify: true, target: 'es2022', logLevel: 'warning', legalComments: 'linked' };
await build({ ...options, entryPoints: ['src/main.ts', 'src/style.css'], outdir: out, format: 'esm', splitting: true, chunkNames: '[name]' });
// Not a module: Emscripten's output is loaded by importScripts.
await build({ ...options, entryPoints: ['src/library/worker.ts'], outdir: out, format: 'iife' });
for (const path of [...core, join(root, 'editor/src/index.html')]) cpSync(path, join(out, path.split('/').at(-1)));
for (const licence of ['three/LICENSE', 'idb-keyval/LICENCE', 'meshoptimizer/LICENSE.md']) cpSync(join(root, 'editor/node_modules', licence), join(out, 'licences', `${dirname(licence)}.txt`));
// Shapes and rules; programs stay.
cpSync(join(root, 'examples'), join(out, 'examples'), { recursive: true, filter: (path) => !/[/](cpp|python|js|gallery[.]py|README[.]md)$/.test(path) });
