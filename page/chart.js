// One chart of lines, as SVG.

import {powersOf, short, ticksOf} from './numbers.js';

export const edge = {left: 58, right: 12, top: 12, bottom: 38};
const mostPoints = 1500;

function element(name, attributes, parent, text) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

function axisOf({low, high, log}, from, to) {
  if (!(high > low)) [low, high] = log ? [low / 2, low * 2] : [low - 0.5, low + 0.5];
  const on = (value) => log ? Math.log(value) : value;
  let ticks = log ? powersOf(low, high) : ticksOf(low, high);
  if (log && ticks.length < 2) ticks = ticksOf(low, high, 4).filter((tick) => tick > 0);
  return {ticks, low, high, place: (value) => from + (to - from) * (on(value) - on(low)) / (on(high) - on(low))};
}

// Thins many points to the lowest and highest of each stretch.
function thinned(points) {
  if (points.length <= mostPoints) return points;
  const stretch = Math.ceil(2 * points.length / mostPoints);
  const kept = [];
  for (let begin = 0; begin < points.length; begin += stretch) {
    const part = points.slice(begin, begin + stretch);
    const low = part.reduce((a, b) => b[1] < a[1] ? b : a);
    const high = part.reduce((a, b) => b[1] > a[1] ? b : a);
    kept.push(...(low[0] < high[0] ? [low, high] : [high, low]));
  }
  return kept;
}

// x, y: {label, low, high, log}. series: {name, style, lines: lists of [x, y]}. pixels: its size, if it is not scaled
// to its place.
export function addChart(parent, {id, title, x, y, series, pixels: {width, height} = {width: 520, height: 260}}) {
  const figure = document.createElement('figure');
  figure.id = id;
  parent.append(figure);
  figure.append(Object.assign(document.createElement('figcaption'), {textContent: title}));
  const across = axisOf(x, edge.left, width - edge.right);
  const up = axisOf(y, height - edge.bottom, edge.top);
  const names = series.map(({name}) => name).join(' and ');
  const svg = element('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img',
    'aria-label': `${title}: ${y.label} against ${x.label}, ${names}`}, figure);
  const clip = element('clipPath', {id: `${id}-clip`}, svg);
  element('rect', {x: edge.left, y: edge.top, width: width - edge.left - edge.right,
    height: height - edge.top - edge.bottom}, clip);
  for (const tick of across.ticks) {
    const at = across.place(tick);
    element('line', {class: 'grid', x1: at, x2: at, y1: edge.top, y2: height - edge.bottom}, svg);
    element('text', {x: at, y: height - edge.bottom + 14, 'text-anchor': 'middle'}, svg, short(tick));
  }
  for (const tick of up.ticks) {
    const at = up.place(tick);
    element('line', {class: tick === 0 ? 'zero' : 'grid', x1: edge.left, x2: width - edge.right, y1: at, y2: at}, svg);
    element('text', {x: edge.left - 5, y: at + 4, 'text-anchor': 'end'}, svg, short(tick));
  }
  element('text', {x: (edge.left + width - edge.right) / 2, y: height - 6, 'text-anchor': 'middle'}, svg, x.label);
  element('text', {x: 0, y: 0, 'text-anchor': 'middle',
    transform: `translate(11 ${(edge.top + height - edge.bottom) / 2}) rotate(-90)`}, svg, y.label);
  for (const {style, lines} of series) {
    const path = lines.map((points) => thinned(points).map(([a, b], k) =>
      `${k ? 'L' : 'M'}${across.place(a).toFixed(1)} ${up.place(b).toFixed(1)}`).join('')).join('');
    element('path', {class: style, d: path || 'M0 0', 'clip-path': `url(#${id}-clip)`}, svg);
  }
  const keys = document.createElement('div');
  keys.className = 'keys';
  for (const {name, style} of series)
    keys.append(Object.assign(document.createElement('span'), {className: style, textContent: name}));
  figure.append(keys);
}
