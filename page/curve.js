// A polygonal curve: arc length and curvature along its chains.

import {cross, dot, minus} from './vectors.js';

// The curvature vector of the circle through three points, at the middle one; zero where there is no circle.
function curvatureAt(before, here, after) {
  const a = minus(here, before);
  const b = minus(after, here);
  const chord = minus(after, before);
  const squares = dot(a, a) * dot(b, b) * dot(chord, chord);
  if (squares === 0) return [0, 0, 0];
  const binormal = cross(a, b);
  const tangent = a.map((part, i) => part / dot(a, a) + b[i] / dot(b, b));
  const length = Math.hypot(...tangent) || 1;
  const size = 2 / Math.sqrt(squares);
  return cross(binormal, tangent).map((part) => size * part / length);
}

// Chains with points, arc length (going on from chain to chain), curvature vectors and curvature: signed on planar
// curves, positive to the left as seen in the view. Ends that are open have none. middles: the arc length at which the
// curve has that curvature, to second order: the mean of the node's and its neighbours'.
export function chainsOf({positions, runs, closed}, {planar, towards}) {
  let length = 0;
  return closed.map((loop, c) => {
    const points = [];
    for (let k = runs.begin[c]; k < runs.begin[c + 1]; ++k)
      points.push([0, 1, 2].map((i) => positions[3 * runs.nodes[k] + i]));
    const count = points.length;
    const around = (k) => points[(k + count) % count];
    const begin = length;
    const arc = points.map((point, k) => length += k ? Math.hypot(...minus(point, points[k - 1])) : 0);
    if (loop && count) length += Math.hypot(...minus(points[0], points[count - 1]));
    const vectors = points.map((point, k) => {
      const end = !loop && (k === 0 || k === count - 1);
      return end || count < 3 ? null : curvatureAt(around(k - 1), point, around(k + 1));
    });
    const curvatures = vectors.map((vector, k) => {
      if (!vector) return null;
      if (!planar) return Math.hypot(...vector);
      return dot(cross(minus(around(k + 1), around(k - 1)), vector), towards) < 0 ? -Math.hypot(...vector) : Math.hypot(...vector);
    });
    const middles = arc.map((at, k) => {
      const before = k ? arc[k - 1] : loop ? arc[count - 1] - (length - begin) : at;
      const after = k + 1 < count ? arc[k + 1] : loop ? length : at;
      return (before + at + after) / 3;
    });
    return {points, arc, middles, vectors, curvatures, closed: loop};
  });
}
