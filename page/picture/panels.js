// A picture of surfaces as SVG: a panel for every shape and style, all from the same side and at the same scale.

import {SurfaceView} from '../surface_view.js';
import {fieldsOf, marksOf, prepared} from '../surface_fields.js';

const margin = 1.04;  // by how much a panel is larger than what it shows
// Pixels of a panel per pixel of the picture: 2 smooths edges, but would fade lines a pixel wide.
const sharpnessOf = (style) => style === 'wire' ? 1 : 2;

const escaped = (text) => text.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);

// A camera for the view, with all shapes, or a part of them, in the middle of a panel of that width.
function cameraOf(shapes, rows, part, width) {
  const {extents, middle} = part ?? boundsOf(shapes, rows);
  const height = Math.round(width * Math.min(1.3, Math.max(0.35, extents[1] / extents[0])));
  const breadth = Math.max(...extents);
  return {rows, middle, breadth, zoom: part ? 1 / breadth : 1, height, scale: (w, h) => Math.min(w / extents[0], h / extents[1])};
}

// The size of the shapes in the view, and their middle.
function boundsOf(shapes, rows) {
  const low = [Infinity, Infinity];
  const high = [-Infinity, -Infinity];
  for (const {positions, triangles} of shapes) {
    for (const node of triangles) {
      for (const i of [0, 1]) {
        const place = rows[i][0] * positions[3 * node] + rows[i][1] * positions[3 * node + 1] + rows[i][2] * positions[3 * node + 2];
        low[i] = Math.min(low[i], place);
        high[i] = Math.max(high[i], place);
      }
    }
  }
  const extents = [0, 1].map((i) => high[i] > low[i] ? margin * (high[i] - low[i]) : 1e-3);
  const centre = [0, 1].map((i) => high[i] >= low[i] ? (low[i] + high[i]) / 2 : 0);
  return {extents, middle: [0, 1, 2].map((k) => centre[0] * rows[0][k] + centre[1] * rows[1][k])};
}

// A ramp of colours with its name and numbers, in the middle of a strip.
function legendOf({name, map, range}, id, {x, y, width, line}) {
  const stops = map.map((colour, k) =>
    `<stop offset="${k / (map.length - 1)}" stop-color="rgb(${colour.map((part) => Math.round(255 * part)).join(',')})"/>`);
  const anchors = ['start', 'middle', 'end'];
  const marks = marksOf(range).map((text, k) =>
    `<text x="${x + k * width / 2}" y="${y + 2.9 * line}" text-anchor="${anchors[k]}">${text}</text>`);
  return `<linearGradient id="${id}">${stops.join('')}</linearGradient>
<text x="${x + width / 2}" y="${y + 0.8 * line}" text-anchor="middle">${escaped(name)}</text>
<rect x="${x}" y="${y + 1.1 * line}" width="${width}" height="${0.8 * line}" fill="url(#${id})"/>
${marks.join('\n')}`;
}

// styles: those of the view, a row each. width: of the picture in pixels.
export function panelsOf(scene, {styles, width, title}) {
  const all = scene.shapes.map(prepared);
  const fields = fieldsOf(all, scene);
  // The shape before stands on the left.
  const columns = scene.reference === null ? [scene.leading] : [scene.reference, scene.leading];
  const shapes = columns.map((k) => all[k]);
  const gap = Math.round(width / 80);
  const across = Math.floor((width - gap * (columns.length + 1)) / columns.length);
  const camera = cameraOf(shapes, scene.view, scene.part, across);
  const line = Math.max(11, Math.round(width / 75));
  const left = (k) => gap + k * (across + gap);
  const canvas = document.createElement('canvas');
  document.body.append(canvas);
  const view = new SurfaceView(canvas, shapes, scene.points);
  let y = gap;
  const parts = shapes.length < 2 ? [] : shapes.map((shape, k) =>
    `<text x="${left(k) + across / 2}" y="${y + line}" text-anchor="middle" font-weight="600">${escaped(shape.title)}</text>`);
  if (parts.length) y += 2 * line;
  for (const style of styles) {
    const field = fields[style];
    const sharpness = sharpnessOf(style);
    canvas.style.cssText = `display:block;width:${sharpness * across}px;height:${sharpness * camera.height}px`;
    shapes.forEach((_, k) => {
      view.draw(camera, {shape: k, mode: style, colours: field && {...field, values: columns.map((c) => field.values[c])}});
      parts.push(`<image class="${style}" x="${left(k)}" y="${y}" width="${across}" height="${camera.height}" href="${canvas.toDataURL('image/png')}"/>`);
    });
    y += camera.height + gap;
    if (!field) continue;
    const ramp = Math.min(width - 2 * gap, 24 * line);
    parts.push(legendOf(field, style, {x: (width - ramp) / 2, y, width: ramp, line}));
    y += 3.2 * line + gap;
  }
  const height = Math.ceil(y);
  const [paper, ink] = ['--panel', '--ink'].map((name) => getComputedStyle(document.documentElement).getPropertyValue(name));
  return `<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="DejaVu Sans, Arial, sans-serif" font-size="${line}" fill="${ink}">
<title>${escaped(title)}</title>
<rect width="${width}" height="${height}" fill="${paper}"/>
${parts.join('\n')}
</svg>
`;
}
