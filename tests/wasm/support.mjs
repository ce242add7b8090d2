// The library as it is built, and the native program beside it.

import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

export const root = new URL('../../', import.meta.url).pathname;
export const program = process.env.VSPRING ?? join(root, 'build/release/vspring');

export const rules = JSON.stringify({ rules: [{ nodes: 'boundary', position: 'fixed', normal: 'fixed' }] });

// name: vspring_core or vspring_core_threads.
export function load(name, options = {}) {
  const core = createRequire(import.meta.url)(join(root, `build/wasm/${name}.js`));
  return core({ wasmBinary: readFileSync(join(root, `build/wasm/${name}.wasm`)), ...options });
}

export function native(...options) {
  return execFileSync(program, options, { encoding: 'utf8' });
}
