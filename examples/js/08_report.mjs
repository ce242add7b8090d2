// How to tell what a call did: progress, ending it before its time, whether its result is usable, and how sharply the shape
// is bent before and after. From the project's folder: node examples/js/08_report.mjs OUT
import { readFileSync, writeFileSync } from 'node:fs';
import vspringCore from 'vspring';

function tell(report) {
  const off = report.expectedError === null ? '' : `, off by some ${report.expectedError.toExponential(0)} of the size`;
  console.log(`${report.usable ? 'usable' : 'not usable'} (${report.outcome}): ${report.iterations} iterations${off}`);
  for (const warning of report.warnings) console.log(`  ${warning}`);
}

const out = process.argv[2] ?? '.';
const core = await vspringCore();
const pipes = new core.Surface(readFileSync('examples/pipe-blend.obj'), 'pipe-blend.obj');
pipes.setRules('{"rules": [{"nodes": "boundary", "position": "fixed", "normal": "fixed"}]}');

// The sharpest bend at a node, as a radius.
const sharpest = () => {
  const { k1, k2 } = pipes.curvatures(pipes.positions());
  return (1 / Math.max(...k1.map(Math.abs), ...k2.map(Math.abs))).toFixed(3);
};
const before = sharpest();

// True ends it soon: what comes back is a shape on the way, and says so.
const ended = pipes.fair(() => true);
tell(ended);

const report = pipes.fair((fraction) => {
  console.log(`${Math.round(100 * fraction)} %`);
  return false;
});
tell(report);
if (report.usable && !ended.usable) {
  console.log(`least radius of curvature ${sharpest()}, before ${before}`);
  writeFileSync(`${out}/08_report.obj`, pipes.write('fair.obj'));
} else {
  process.exitCode = 1;
}
pipes.delete();
