// Drags a node of a sheet upwards, step by step, as an editor does, and prints how another one follows.
// node examples/js/06_session.mjs OUT
import { writeFileSync } from 'node:fs';
import vspringCore from 'vspring';

const out = process.argv[2] ?? '.';
const cells = 24;
const node = (column, row) => row * (cells + 1) + column;
let text = '';
for (let row = 0; row <= cells; ++row) {
  for (let column = 0; column <= cells; ++column) text += `v ${(2 * column) / cells} ${(2 * row) / cells} 0\n`;
}
for (let row = 0; row < cells; ++row) {
  for (let column = 0; column < cells; ++column) {
    const corners = [node(column, row), node(column + 1, row), node(column + 1, row + 1), node(column, row + 1)];
    text += `f ${corners.map((corner) => corner + 1).join(' ')}\n`;
  }
}
const dragged = node(cells / 2, cells / 2);
const other = dragged + cells / 4;

const core = await vspringCore();
const sheet = new core.Surface(new TextEncoder().encode(text), 'sheet.obj');
sheet.setRules('{"rules": [{"nodes": "boundary", "position": "fixed", "normal": "fixed"}]}');
const height = () => sheet.positions()[3 * other + 2].toFixed(4);
for (let step = 1; step <= 6; ++step) {
  sheet.holdPosition(dragged, 1, 1, 0.1 * step);
  const { iterations } = sheet.update(null); // for a picture
  console.log(`height ${(0.1 * step).toFixed(1)}: the other node is at ${height()}, after ${iterations} iterations`);
}
// The button is released: to the tolerance, and never worse than the input without a word.
const report = sheet.fair(null);
console.log(`${report.outcome}: the other node is at ${height()}`);
writeFileSync(`${out}/06_session.obj`, sheet.write('fair.obj'));
sheet.delete();
process.exitCode = report.usable ? 0 : 1;
