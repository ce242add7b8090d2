// The table of figures, and the summary of the report.

import {short} from './numbers.js';

function cell(row, kind, text, className) {
  const made = Object.assign(document.createElement(kind), {textContent: text, className});
  row.append(made);
  return made;
}

export function fillTable(table, {columns, figures}) {
  const head = table.createTHead().insertRow();
  for (const [text, className] of [['figure', ''], ...columns.map((title) => [title, 'number']), ['unit', ''], ['definition', '']])
    cell(head, 'th', text, className).scope = 'col';
  const body = table.createTBody();
  for (const figure of figures) {
    const row = body.insertRow();
    row.dataset.key = figure.key;
    cell(row, 'th', figure.name, '').scope = 'row';
    for (const value of figure.values) cell(row, 'td', short(value, figure.whole), 'number');
    cell(row, 'td', figure.unit, '');
    cell(row, 'td', figure.definition, 'definition');
  }
}

export function summaryOf(report) {
  const counts = [`${report.nodes} nodes`];
  if (report.faces) counts.push(`${report.faces} faces`);
  if (report.outcome) {
    counts.unshift(`${report.outcome} after ${report.iterations} iterations (${report.method}), ${short(report.seconds)} s`);
    counts.push(`moved by up to ${short(report.greatest_move)}, root mean square ${short(report.rms_move)}`);
  }
  if (report.distance)
    counts.push(`to the other: up to ${short(report.distance.to_other.greatest)}, root mean square ${short(report.distance.to_other.rms)}`);
  if (report.points) {
    const {count, distance: {before, after}} = report.points;
    const change = (key) => `${short(before[key])} → ${short(after[key])}`;
    counts.push(`${count} points: root mean square distance ${change('rms')}, greatest ${change('greatest')}`);
  }
  return counts.join(' · ');
}

export function fillWarnings(list, warnings) {
  list.hidden = warnings.length === 0;
  list.append(...warnings.map((text) => Object.assign(document.createElement('li'), {textContent: text})));
}
