// The page of a surface: its view with ways to look at it, and its charts.

import {diverging, gradientOf, sequential} from './colours.js';
import {deviationsOf, edgesOf, normalsOf, trianglesOf, turnsOf} from './mesh.js';
import {SurfaceView} from './surface_view.js';
import {addChoice, addSlider} from './controls.js';
import {addSurfaceCharts} from './charts.js';
import {quantiles, short} from './numbers.js';

function prepared({title, positions, runs, mean, gaussian}) {
  const edges = edgesOf(runs, positions.length / 3);
  return {title, positions, runs, mean, gaussian, edges: edges.ends, triangles: trianglesOf(runs, positions),
    normals: normalsOf(runs, positions, edges), turns: turnsOf(runs, positions, edges)};
}

// What colours can show: values for each shape, map, range of its colours.
function fieldsOf(shapes, {leading, reference, unit}) {
  const about = (centre, half) => [centre - half, centre + half];
  const even = (values, least) => about(0, Math.max(least, quantiles(values.map(Math.abs), [0.98])[0]));
  const [low, high] = quantiles(shapes[leading].mean, [0.02, 0.98]);
  const fields = {
    mean: {name: 'Mean curvature × D', map: sequential, values: shapes.map((shape) => shape.mean),
      range: about((low + high) / 2, Math.max((high - low) / 2, 0.01))},
    gaussian: {name: 'Gaussian curvature × D²', map: diverging, values: shapes.map((shape) => shape.gaussian),
      range: even(shapes[leading].gaussian, 0.01)},
  };
  const from = shapes[reference];
  if (from && from.runs === shapes[leading].runs) {
    const values = deviationsOf(shapes[leading].positions, from.positions, from.normals).map((part) => part * unit);
    fields.deviation = {name: `Deviation from “${from.title}”, units of the input`, map: diverging,
      values: shapes.map(() => values), range: even(values, 1e-6 * unit)};
  }
  return fields;
}

function showLegend(legend, field, range) {
  legend.hidden = !field;
  if (!field) return;
  legend.querySelector('figcaption').textContent = field.name;
  legend.querySelector('.ramp').style.background = gradientOf(field.map);
  legend.querySelector('.marks').replaceChildren(...[range[0], (range[0] + range[1]) / 2, range[1]].map((value, k) =>
    Object.assign(document.createElement('span'), {textContent: `${['≤ ', '', '≥ '][k]}${short(Number(value.toPrecision(3)))}`})));
}

// Returns what draws the view, given the camera, and what goes on to the next shape.
export function makeSurfacePage({canvas, form, legend, charts}, scene, report, redraw) {
  const shapes = scene.shapes.map(prepared);
  addSurfaceCharts(charts, shapes, scene.leading, report);
  const fields = fieldsOf(shapes, scene);
  const view = new SurfaceView(canvas, shapes);
  const state = {shape: scene.leading, mode: 'shaded', spread: 1};
  const names = [['shaded', 'Shaded'], ['wire', 'Wire'], ['zebra', 'Zebra'], ['mean', 'Mean curvature'],
    ['gaussian', 'Gaussian curvature'], ['deviation', 'Deviation']];
  const choose = (value) => {
    state.shape = Number(value);
    redraw();
  };
  const inputs = shapes.length < 2 ? [] : addChoice(form, 'shape', 'Shape',
    shapes.map(({title}, k) => [String(k), title]), String(state.shape), choose);
  const shown = names.filter(([mode]) => mode !== 'deviation' || fields.deviation);
  addChoice(form, 'mode', 'Show', shown, state.mode, (mode) => {
    state.mode = mode;
    redraw();
  });
  addSlider(legend, 'spread', 'Range of colours', {low: -3, high: 3, step: 0.1, value: 0}, (power) => {
    state.spread = 2 ** power;
    redraw();
  });
  return {
    draw(camera) {
      const field = fields[state.mode];
      const range = field && [0, 1].map((end) =>
        (field.range[0] + field.range[1]) / 2 + (end - 0.5) * state.spread * (field.range[1] - field.range[0]));
      showLegend(legend, field, range);
      view.draw(camera, {...state, colours: field && {...field, range}});
    },
    next() {
      if (inputs.length) inputs[(state.shape + 1) % inputs.length].click();
    },
  };
}
