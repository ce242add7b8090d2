// Draws a flat sheet to 4,000 scattered points with noise: what is shorter than some six times the smoothing length goes.
// From the project's folder: node examples/js/05_points.mjs OUT
import { readFileSync, writeFileSync } from 'node:fs';
import vspringCore from 'vspring';

const out = process.argv[2] ?? '.';
const core = await vspringCore();
const sheet = new core.Surface(readFileSync('examples/figure-12.obj'), 'figure-12.obj');
const points = new core.Points(readFileSync('examples/figure-12.xyz'), 'figure-12.xyz');
sheet.setRules('{"rules": [{"nodes": "boundary", "position": "fixed"}]}');
const report = sheet.fit(points, { smoothingLength: 0.1 }, null);
writeFileSync(`${out}/05_points.obj`, sheet.write('fair.obj'));
console.log(`${report.outcome}: ${report.fit.points} points, of which ${report.fit.pullingPoints} pull, are ${report.fit.rms.toFixed(4)} away (root mean square)`);
points.delete();
sheet.delete();
process.exitCode = report.usable ? 0 : 1;
