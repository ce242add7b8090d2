// node fair.mjs part.ply fair.ply: the boundary keeps its places and its tangent planes, and what is between becomes fair.

import { readFileSync, writeFileSync } from 'node:fs';
import vspringCore from 'vspring';

const [input, output] = process.argv.slice(2);
const core = await vspringCore();
const surface = new core.Surface(readFileSync(input), input);
surface.setRules(JSON.stringify({ rules: [{ nodes: 'boundary', position: 'fixed', normal: 'fixed' }] }));
const report = surface.fair(null);
console.log(`${report.outcome} after ${report.iterations} iterations; nodes moved by at most ${report.greatestMove}`);
writeFileSync(output, surface.write(output));
surface.delete();
