// The page of a curve: its view with the comb, and its charts.

import {CurveView} from './curve_view.js';
import {addChoice, addSlider, addSwitch} from './controls.js';
import {addCurveCharts} from './charts.js';
import {chainsOf} from './curve.js';

// Returns a function that draws the view, given the camera, and one that goes on to the next shape.
export function makeCurvePage({canvas, form, charts}, scene, report, redraw) {
  const plane = {planar: scene.planar, towards: scene.view[2]};
  const shapes = scene.shapes.map((shape) => ({title: shape.title, chains: chainsOf(shape, plane)}));
  const {unit, leading, planar} = scene;
  addCurveCharts(charts, shapes, {unit, leading, planar}, report);
  const view = new CurveView(canvas, shapes.map(({chains}) => chains), scene);
  const state = {shape: scene.leading, behind: true, comb: 1};
  const set = (change) => {
    Object.assign(state, change);
    redraw();
  };
  const inputs = shapes.length < 2 ? [] : addChoice(form, 'shape', 'Shape', shapes.map(({title}, k) => [String(k), title]),
    String(state.shape), (value) => set({shape: Number(value)}));
  if (shapes.length > 1) addSwitch(form, 'behind', 'The other one behind', true, (behind) => set({behind}));
  addSlider(form, 'comb', 'Curvature comb', {low: 0, high: 3, step: 0.05, value: 1}, (comb) => set({comb}));
  return {
    draw: (camera) => view.draw(camera, state),
    next() {
      if (inputs.length) inputs[(state.shape + 1) % inputs.length].click();
    },
  };
}
