// The rooms of src/: each imports only from those before it, and no files import each other in a circle. Types count too.

import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, normalize } from 'node:path';
import { test } from 'node:test';

const rooms = ['base', 'library', 'shape', 'constraints', 'pull', 'edit', 'navigation', 'view', 'pick', 'draw', 'look', 'start', 'panels'];
const src = new URL('../src/', import.meta.url).pathname;
const files = readdirSync(src, { recursive: true }).filter((name) => name.endsWith('.ts'));

// The modules of src/ that a file imports; of packages and of the page's own drawing there is no order.
function importsOf(file) {
  return [...readFileSync(join(src, file), 'utf8').matchAll(/(?:from |import |import\()'(\.[^']+)'/g)]
    .map(([, path]) => normalize(join(dirname(file), path))).filter((path) => !path.startsWith('../')).map((path) => `${path}.ts`);
}

const roomOf = (file) => (file === 'main.ts' ? rooms.length : rooms.indexOf(file.split('/')[0]));
const imports = new Map(files.map((file) => [file, importsOf(file)]));

test('every file is in a room, and imports from its own and those before it', () => {
  assert.ok([...imports.values()].flat().length > 100, 'imports are found');
  const faults = files.filter((file) => roomOf(file) < 0).map((file) => `${file} is in no room`);
  for (const [file, others] of imports) {
    for (const other of others) {
      if (!imports.has(other)) faults.push(`${file} imports ${other}, which there is not`);
      else if (roomOf(other) > roomOf(file)) faults.push(`${file} imports ${other}, whose room comes after its own`);
    }
  }
  assert.deepEqual(faults, []);
});

test('no files import each other in a circle', () => {
  const done = new Set();
  const circles = [];
  const visit = (file, way) => {
    if (way.includes(file)) circles.push([...way.slice(way.indexOf(file)), file].join(' > '));
    if (done.has(file) || way.includes(file)) return;
    for (const other of imports.get(file) ?? []) visit(other, [...way, file]);
    done.add(file);
  };
  for (const file of files) visit(file, []);
  assert.deepEqual(circles, []);
});
