// Reads a surface, makes it fair between its boundaries, which keep their places, and writes it.
// From the project's folder: node examples/js/01_between_boundaries.mjs OUT
import { readFileSync, writeFileSync } from 'node:fs';
import vspringCore from 'vspring';

const out = process.argv[2] ?? '.';
const core = await vspringCore();
const surface = new core.Surface(readFileSync('examples/annulus.obj'), 'annulus.obj');
surface.setRules('{"rules": [{"nodes": "boundary", "position": "fixed"}]}');
const report = surface.fair(null);
writeFileSync(`${out}/01_between_boundaries.obj`, surface.write('fair.obj'));
console.log(`${report.outcome} after ${report.iterations} iterations; nodes moved by up to ${report.greatestMove.toFixed(3)}`);
surface.delete();
process.exitCode = report.usable ? 0 : 1;
