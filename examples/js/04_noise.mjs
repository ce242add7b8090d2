// Takes the noise off a scan: no node ends further from where it was measured than a tolerance. The scan is of the saddle
// z = xy, so the program can say how near it comes to the truth. From the project's folder: node examples/js/04_noise.mjs OUT
import { readFileSync, writeFileSync } from 'node:fs';
import vspringCore from 'vspring';

const out = process.argv[2] ?? '.';
const core = await vspringCore();
const scan = new core.Surface(readFileSync('examples/saddle.ply'), 'saddle.ply');
scan.setRules('{"rules": [{"nodes": "boundary", "position": "fixed"}]}');

const fromTruth = (nodes) => {
  let sum = 0;
  for (let k = 0; k < nodes.length; k += 3) sum += (nodes[k + 2] - nodes[k] * nodes[k + 1]) ** 2;
  return Math.sqrt(sum / (nodes.length / 3)).toFixed(4);
};
const before = fromTruth(scan.positions());
const noise = scan.noise();
// The points that the surface is drawn to are its own nodes, which keep their places along it.
const points = core.Points.at(scan.positions());
const report = scan.fit(points, { within: 0.05, keep: true }, null);
writeFileSync(`${out}/04_noise.ply`, scan.write('fair.ply'));
console.log(`noise of ${noise.toFixed(4)}; ${report.outcome}: ${fromTruth(scan.positions())} from the truth, before ${before}; points are at most ${report.fit.greatest.toFixed(4)} away`);
points.delete();
scan.delete();
process.exitCode = report.usable ? 0 : 1;
