// The axes in the corner of the view: they show its rotation, and a click on an end looks from there.

import type { Vector } from '../base/vectors';
import { standing, type Up } from '../shape/upright';

const axes: [string, Vector][] = [['X', [1, 0, 0]], ['Y', [0, 1, 0]], ['Z', [0, 0, 1]], ['−X', [-1, 0, 0]], ['−Y', [0, -1, 0]], ['−Z', [0, 0, -1]]];
/** Of directions as they stand in the view. */
const sides: [string, Vector][] = [['right', [1, 0, 0]], ['left', [-1, 0, 0]], ['back', [0, 1, 0]], ['front', [0, -1, 0]], ['top', [0, 0, 1]], ['bottom', [0, 0, -1]]];
const radius = 30;

export class Gizmo {
  private readonly ends: { button: HTMLButtonElement; axis: Vector }[];
  private turned = '';

  constructor(private readonly box: HTMLElement, look: (from: Vector) => void) {
    this.ends = axes.map(([title, axis]) => {
      const button = Object.assign(document.createElement('button'), { type: 'button', textContent: title.length === 1 ? title : '' });
      button.dataset.axis = title.at(-1)!.toLowerCase();
      button.addEventListener('click', () => look(axis));
      return { button, axis };
    });
    const lines = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
    lines.append(...axes.slice(0, 3).map(() => document.createElementNS('http://www.w3.org/2000/svg', 'line')));
    box.append(lines, ...this.ends.map(({ button }) => button));
    this.setUp('z');
  }

  setUp(up: Up): void {
    this.ends.forEach(({ button, axis }, k) => {
      const stands = standing(axis, up);
      const [side] = sides.find(([, way]) => way.every((part, i) => part === stands[i]))!;
      button.title = `From the ${side}, ${axes[k][0]}`;
      button.setAttribute('aria-label', `View from the ${side}, ${axes[k][0]}`);
    });
  }

  /** Unit vectors of the view: to the right, up, and towards whoever looks. */
  turn(right: Vector, up: Vector, towards: Vector): void {
    const turned = JSON.stringify([right, up]);
    if (turned === this.turned) return;
    this.turned = turned;
    const along = (axis: Vector, way: Vector): number => axis.reduce((sum, part, i) => sum + part * way[i], 0);
    const lines = this.box.querySelectorAll('line');
    this.ends.forEach(({ button, axis }, k) => {
      const [x, y, near] = [along(axis, right), -along(axis, up), along(axis, towards)];
      button.style.translate = `${radius * x}px ${radius * y}px`;
      button.style.zIndex = String(Math.round(10 + 9 * near));
      if (k < 3) for (const [name, value] of [['x2', radius * x], ['y2', radius * y]] as const) lines[k].setAttribute(name, String(value));
      if (k < 3) lines[k].dataset.axis = button.dataset.axis;
    });
  }
}
