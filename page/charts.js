// The charts of a page.

import {addChart} from './chart.js';
import {quantiles} from './numbers.js';

const bins = 60;

const styleOf = (k, count) => k === 0 && count > 1 ? 'first' : 'second';

// A histogram, in per cent over even steps of the axis, as an outline.
function outlineOf(values, {low, high, log}) {
  const on = (value) => log ? Math.log(Math.max(value, low)) : value;
  const counts = new Float64Array(bins);
  const step = (on(high) - on(low)) / bins;
  for (const value of values)
    ++counts[Math.min(bins - 1, Math.max(0, Math.floor((on(value) - on(low)) / step)))];
  const back = (place) => log ? Math.exp(place) : place;
  const points = [];
  counts.forEach((count, k) => {
    const share = 100 * count / values.length;
    points.push([back(on(low) + k * step), share], [back(on(low) + (k + 1) * step), share]);
  });
  return points;
}

function addHistogram(parent, {id, title, x, of, sets}) {
  const filled = sets.filter(({values}) => values.length > 0);
  if (filled.length === 0) return;
  const outlines = filled.map(({values}) => outlineOf(values, x));
  const high = Math.max(...outlines.flat().map((point) => point[1]));
  addChart(parent, {id, title, x, y: {label: `share of ${of}, %`, low: 0, high: 1.05 * high},
    series: filled.map(({name, style}, k) => ({name, style, lines: [outlines[k]]}))});
}

function addHistory(parent, report) {
  const history = (report.history || []).map((value, k) => [k + 1, value]).filter(([, value]) => value > 0);
  if (history.length < 2) return;
  const values = history.map(([, value]) => value);
  const [low, high] = [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))];
  addChart(parent, {id: 'history', title: 'The run', x: {label: 'iteration', low: 1, high: history.at(-1)[0]},
    y: {label: 'residual', low, high, log: true}, series: [{name: report.method, style: 'second', lines: [history]}]});
}

// leading: the shape whose range of curvature, but for extremes, is shown.
export function addSurfaceCharts(parent, shapes, leading, report) {
  const sets = (valuesOf) => shapes.map((shape, k) =>
    ({name: shape.title, style: styleOf(k, shapes.length), values: valuesOf(shape)}));
  const turns = shapes.flatMap((shape) => shape.turns);
  const [low, high] = quantiles(turns, [0.005, 1]);
  const least = Math.max(low, high / 1e4, 1e-4);
  addHistogram(parent, {id: 'turns', title: 'Turns at edges', of: 'edges', sets: sets((shape) => shape.turns),
    x: {label: 'angle between the normals of two faces, degrees', low: least, high: Math.max(high, 2 * least), log: true}});
  // Creases of other shapes would leave no room for it.
  const bounds = shapes.map(({mean}, k) => quantiles(mean, k === leading ? [0.005, 0.995] : [0.1, 0.9]));
  const bottom = Math.min(...bounds.map((pair) => pair[0]));
  const top = Math.max(...bounds.map((pair) => pair[1]));
  const half = Math.max((top - bottom) / 2, 1e-3);
  addHistogram(parent, {id: 'mean-curvature', title: 'Mean curvature', of: 'nodes', sets: sets((shape) => shape.mean),
    x: {label: 'H × D, the rest in the columns at the ends', low: (top + bottom) / 2 - half, high: (top + bottom) / 2 + half}});
  addHistory(parent, report);
}

// unit: the length of the input that is 1 in the page. leading: the shape whose curvature is shown whole, or its middle
// `share`. part: of the arc length, from and to, as shares of the whole. pixels: see addChart().
export function addCurveCharts(parent, shapes, {unit, leading, planar, share = 1, part = [0, 1], pixels}, report) {
  const series = shapes.map(({title, chains}, k) => ({name: title, style: styleOf(k, shapes.length),
    lines: chains.map(({middles, curvatures}) =>
      middles.map((length, n) => [length * unit, curvatures[n] === null ? null : curvatures[n] / unit])
        .filter((point) => point[1] !== null)).filter((line) => line.length > 0)}));
  const far = Math.max(...series.flatMap((one) => one.lines.flat().slice(-1)).map((point) => point[0]), 0);
  const [from, to] = part.map((end) => end * far);
  const heights = (one) => one.lines.flat().filter((point) => point[0] >= from && point[0] <= to).map((point) => point[1]);
  // Others are cut off if the leading one would look flat next to them, unless it is straight.
  const farthest = heights(series[leading]).reduce((most, height) => Math.max(most, Math.abs(height)), 0);
  const reach = farthest * shapes[leading].chains.reduce((sum, {arc}) => Math.max(sum, arc.at(-1) || 0), 0) * unit > 0.1 ? 2 * farthest : Infinity;
  const bounds = series.map((one, k) => (k === leading ? quantiles(heights(one), [(1 - share) / 2, (1 + share) / 2])
    : quantiles(heights(one), [(1 - 0.96 * share) / 2, (1 + 0.96 * share) / 2]).map((end) => Math.max(-reach, Math.min(reach, end)))));
  // A part of the curve has the axis to itself.
  const zero = from > 0 || to < far ? [] : [0];
  const low = Math.min(...zero, ...bounds.map((pair) => pair[0]));
  const high = Math.max(...zero, ...bounds.map((pair) => pair[1]));
  const space = 0.05 * (high - low);
  addChart(parent, {id: 'curvature', title: 'Curvature along the curve', series, pixels,
    x: {label: `arc length, units of the input${planar ? '; curvature is positive to the left' : ''}`, low: from, high: to},
    y: {label: 'curvature, 1/unit', low: low - space, high: high + space}});
  addHistory(parent, report);
}
