// Puts the page together.

import {Camera, steer} from './camera.js';
import {addButton} from './controls.js';
import {fillTable, fillWarnings, summaryOf} from './table.js';
import {jsonOf, sceneOf} from './data.js';
import {makeCurvePage} from './curve_page.js';
import {makeSurfacePage} from './surface_page.js';

const part = (id) => document.getElementById(id);
const report = jsonOf('figures');
const scene = sceneOf(jsonOf('scene'));

part('summary').textContent = summaryOf(report);
fillWarnings(part('warnings'), report.warnings || []);
fillTable(part('table'), scene);
part('footer').textContent = `vspring ${report.version}`;

// One picture for many changes, when the browser paints next.
let waiting = false;
let page = null;
const redraw = () => {
  if (waiting || !page) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    page.draw(camera);
  });
};
const camera = new Camera(scene.view, scene.shapes.map((shape) => shape.positions), scene.surface ? 1.1 : 1.5, redraw, scene.part);

try {
  const places = {canvas: part('canvas'), form: part('controls'), legend: part('legend'), charts: part('charts')};
  page = (scene.surface ? makeSurfacePage : makeCurvePage)(places, scene, report, redraw);
  steer(part('canvas'), camera, () => page.next());
  addButton(part('controls'), 'Show all', () => camera.show(camera.all));
  if (scene.part) addButton(part('controls'), 'Show what moved', () => camera.show(camera.home));
  new ResizeObserver(redraw).observe(part('canvas'));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
} catch (error) {
  part('canvas').hidden = true;
  part('controls').hidden = true;
  Object.assign(part('trouble'), {hidden: false, textContent: error.message});
}
