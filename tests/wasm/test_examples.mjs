// Every example of examples/js runs with the package for npm, says that its result is usable, and leaves what it claims.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { program, root } from './support.mjs';

test('examples run, and their results are what they claim to be', (t) => {
  const folder = mkdtempSync(join(tmpdir(), 'examples-'));
  t.after(() => rmSync(folder, { recursive: true }));
  cpSync(join(root, 'bindings/wasm/package'), join(folder, 'node_modules/vspring'), { recursive: true });
  for (const name of ['vspring_core.js', 'vspring_core.wasm']) cpSync(join(root, 'build/wasm', name), join(folder, 'node_modules/vspring', name));
  const examples = readdirSync(join(root, 'examples/js'));
  for (const example of examples) {
    // Packages are looked for from where a script lies.
    cpSync(join(root, 'examples/js', example), join(folder, example));
    const told = execFileSync('node', [join(folder, example), folder], { cwd: root, encoding: 'utf8' });
    assert.match(told, /converged/, example);
  }
  execFileSync(join(root, 'tests/examples/check'), [program, folder, ...examples.map((example) => example.replace('.mjs', ''))]);
});
