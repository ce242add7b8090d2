// The page of a surface: its view with ways to look at it, and its charts.

import {gradientOf} from './colours.js';
import {turnsOf} from './mesh.js';
import {SurfaceView} from './surface_view.js';
import {addChoice, addSlider} from './controls.js';
import {addSurfaceCharts} from './charts.js';
import {fieldsOf, marksOf, prepared} from './surface_fields.js';

function showLegend(legend, field, range) {
  legend.hidden = !field;
  if (!field) return;
  legend.querySelector('figcaption').textContent = field.name;
  legend.querySelector('.ramp').style.background = gradientOf(field.map);
  legend.querySelector('.marks').replaceChildren(...marksOf(range).map((textContent) =>
    Object.assign(document.createElement('span'), {textContent})));
}

// Returns a function that draws the view, given the camera, and one that goes on to the next shape.
export function makeSurfacePage({canvas, form, legend, charts}, scene, report, redraw) {
  const shapes = scene.shapes.map(prepared).map((shape) =>
    ({...shape, turns: turnsOf(shape.runs, shape.positions, shape.joints)}));
  addSurfaceCharts(charts, shapes, scene.leading, report);
  const fields = fieldsOf(shapes, scene);
  const view = new SurfaceView(canvas, shapes, scene.points);
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
