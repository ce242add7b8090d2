// Closes the two holes of a sphere without its poles: the patches are fair with what is around, so it is a sphere again.
// node examples/js/07_hole.mjs OUT
import { writeFileSync } from 'node:fs';
import vspringCore from 'vspring';

const out = process.argv[2] ?? '.';
const [rows, columns] = [25, 48];
const node = (row, column) => row * columns + (column % columns) + 1;
let text = '';
for (let row = 0; row < rows; ++row) {
  const latitude = (((row * 140) / (rows - 1) - 70) * Math.PI) / 180;
  for (let column = 0; column < columns; ++column) {
    const longitude = (2 * Math.PI * column) / columns;
    text += `v ${Math.cos(latitude) * Math.cos(longitude)} ${Math.cos(latitude) * Math.sin(longitude)} ${Math.sin(latitude)}\n`;
  }
}
for (let row = 0; row + 1 < rows; ++row) {
  for (let column = 0; column < columns; ++column) text += `f ${node(row, column)} ${node(row, column + 1)} ${node(row + 1, column + 1)} ${node(row + 1, column)}\n`;
}

const core = await vspringCore();
const sphere = new core.Surface(new TextEncoder().encode(text), 'sphere.obj');
const nodes = sphere.nodeCount();
const report = sphere.fill({}, null);
writeFileSync(`${out}/07_hole.obj`, sphere.write('closed.obj'));
const places = sphere.positions();
let off = 0;
for (let k = 0; k < places.length; k += 3) off = Math.max(off, Math.abs(Math.hypot(...places.subarray(k, k + 3)) - 1));
const faces = report.holes.reduce((sum, hole) => sum + hole.faceCount, 0);
console.log(`${report.outcome}: ${report.holes.length} holes, filled with ${sphere.nodeCount() - nodes} nodes and ${faces} faces; at most ${off.toExponential(1)} off the sphere`);
sphere.delete();
process.exitCode = report.usable ? 0 : 1;
