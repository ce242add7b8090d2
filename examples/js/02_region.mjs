// Three pipes that meet in a rough block. Two of their rims keep their tangent planes, too; the end of the third pipe is
// outside of the region that moves, stays to the bit, and is met smoothly.
// From the project's folder: node examples/js/02_region.mjs OUT
import { readFileSync, writeFileSync } from 'node:fs';
import vspringCore from 'vspring';

const out = process.argv[2] ?? '.';
const core = await vspringCore();
const pipes = new core.Surface(readFileSync('examples/pipe-blend.obj'), 'pipe-blend.obj');
// Later rules win.
pipes.setRules(JSON.stringify({
  rules: [
    { nodes: 'all', position: 'fixed' },
    { nodes: { region: 'box:-1.2,-2,-2,2,2,2' }, position: 'free' },
    { nodes: 'boundary', position: 'fixed', normal: 'fixed' },
  ],
}));

// The sharpest bend at a node, as a radius.
const sharpest = () => {
  const { k1, k2 } = pipes.curvatures(pipes.positions());
  return 1 / Math.max(...k1.map(Math.abs), ...k2.map(Math.abs));
};
const before = sharpest();
const report = pipes.fair(null);
writeFileSync(`${out}/02_region.obj`, pipes.write('fair.obj'));
console.log(`${report.outcome}: ${report.movingNodes} of ${pipes.nodeCount()} nodes moved; least radius of curvature ${sharpest().toFixed(3)}, before ${before.toFixed(3)}`);
pipes.delete();
process.exitCode = report.usable ? 0 : 1;
