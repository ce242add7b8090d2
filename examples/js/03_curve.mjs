// A fair curve through five points, with its direction given at both ends: nodes between them start on straight lines.
// node examples/js/03_curve.mjs OUT
import { writeFileSync } from 'node:fs';
import vspringCore from 'vspring';

const out = process.argv[2] ?? '.';
const points = [[0, 0], [2, 1.5], [4, 1], [6, -1], [8, 0]];
const between = 12; // edges from point to point

const start = [];
for (let k = 0; k + 1 < points.length; ++k) {
  const [[x, y], [toX, toY]] = [points[k], points[k + 1]];
  for (let step = 0; step < between; ++step) start.push(x + ((toX - x) * step) / between, y + ((toY - y) * step) / between, 0);
}
start.push(...points.at(-1), 0);

const core = await vspringCore();
const curve = core.Curve.through(Float64Array.from(start), false);
points.forEach(([x, y], k) => curve.holdPosition(k * between, x, y, 0));
curve.holdTangent(0, 0, 1, 0);
curve.holdTangent(curve.nodeCount() - 1, 1, 0, 0);

// The greatest angle between two edges that follow each other, degrees.
const greatestTurn = (nodes) => {
  let greatest = 0;
  for (let k = 3; k + 3 < nodes.length; k += 3) {
    const [x, y, onX, onY] = [nodes[k] - nodes[k - 3], nodes[k + 1] - nodes[k - 2], nodes[k + 3] - nodes[k], nodes[k + 4] - nodes[k + 1]];
    greatest = Math.max(greatest, Math.abs(Math.atan2(x * onY - y * onX, x * onX + y * onY)));
  }
  return ((greatest * 180) / Math.PI).toFixed(1);
};
const before = greatestTurn(curve.positions());
const report = curve.fair(null);
writeFileSync(`${out}/03_curve.csv`, curve.write('fair.csv'));
writeFileSync(`${out}/03_curve.svg`, curve.write('fair.svg'));
console.log(`${report.outcome}: greatest turn at a node ${greatestTurn(curve.positions())} degrees, before ${before}`);
curve.delete();
process.exitCode = report.usable ? 0 : 1;
