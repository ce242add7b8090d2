// What a view shows of surfaces: shapes, and values as colours.

import {edgesOf, normalsOf, trianglesOf} from './mesh.js';
import {diverging, sequential} from './colours.js';
import {quantiles, short} from './numbers.js';

// A shape of the scene, prepared for the view.
export function prepared({title, positions, runs, mean, gaussian, deviation}) {
  const edges = edgesOf(runs, positions.length / 3);
  return {title, positions, runs, mean, gaussian, deviation, joints: edges, edges: edges.ends,
    triangles: trianglesOf(runs, positions), normals: normalsOf(runs, positions, edges)};
}

const about = (centre, half) => [centre - half, centre + half];

// The range of the middle share of values, widened about their middle to a least size: so a sphere has one colour,
// although its curvature is not measured to the last digit.
export function aboutMiddle(values, least, share = 0.96) {
  const [low, high] = quantiles(values, [(1 - share) / 2, (1 + share) / 2]);
  return about((low + high) / 2, Math.max((high - low) / 2, least, 0.02 * Math.abs(low + high) / 2));
}

// A range symmetric to zero that contains the middle share of values.
export function aboutZero(values, least, share = 0.96) {
  return about(0, Math.max(least, quantiles(values.map(Math.abs), [(1 + share) / 2])[0]));
}

// The values at nodes in the part that is seen first.
function valuesIn(part, positions, values) {
  if (!part) return values;
  return values.filter((_, n) => Math.hypot(...part.middle.map((middle, i) => positions[3 * n + i] - middle)) <= part.radius);
}

// The fields that colours can show: values for each shape, colour map, range.
export function fieldsOf(shapes, {leading, reference, unit, part}) {
  const seen = (values) => valuesIn(part, shapes[leading].positions, values);
  const fields = {
    mean: {name: 'Mean curvature × D', map: sequential, values: shapes.map((shape) => shape.mean),
      range: aboutMiddle(seen(shapes[leading].mean), 0.01)},
    gaussian: {name: 'Gaussian curvature × D²', map: diverging, values: shapes.map((shape) => shape.gaussian),
      range: aboutZero(seen(shapes[leading].gaussian), 0.01)},
  };
  if (shapes[leading].deviation) {
    const values = shapes.map((shape) => shape.deviation.map((part) => part * unit));
    fields.deviation = {name: `Deviation from “${shapes[reference].title}”, units of the input`, map: diverging, values,
      range: aboutZero(seen(values[leading]), 1e-6 * unit)};
  }
  return fields;
}

// The numbers below a range of colours: its ends and its middle.
export function marksOf([low, high]) {
  return [low, (low + high) / 2, high].map((value, k) => `${['≤ ', '', '≥ '][k]}${short(Number(value.toPrecision(3)))}`);
}
