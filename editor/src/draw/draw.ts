// The tool that draws a curve: a click adds a node, Enter or a double click ends it open, a click on its first node closes it.

import type { Vector } from '../base/vectors';

export interface DrawEvents {
  /** The place under a point of the canvas, in the plane that is drawn in; null where the plane is seen from its edge. */
  placeAt: (x: number, y: number) => Vector | null;
  /** Where a place is on the canvas. */
  pixelOf: (place: Vector) => [number, number];
  /** What to show: the nodes so far and one under the pointer. */
  changed: (nodes: readonly Vector[], next: Vector | null) => void;
  /** Without nodes: it was given up. */
  ended: (nodes: readonly Vector[], closed: boolean) => void;
}

const reach = 10;
const clickReach = 4;

export class DrawTool {
  private nodes: Vector[] | null = null;
  private down: [number, number] = [0, 0];

  /** To be made before all else that listens to the canvas, which sees nothing of the left button while somebody draws. */
  constructor(private readonly canvas: HTMLCanvasElement, private readonly events: DrawEvents) {
    const listen = (type: 'pointerdown' | 'pointermove' | 'pointerup', does: (x: number, y: number) => void): void => canvas.addEventListener(type, (event) => {
      if (!this.nodes || !event.isPrimary || (type === 'pointermove' ? event.buttons & ~1 : event.button !== 0)) return;
      event.stopImmediatePropagation();
      does(event.offsetX, event.offsetY);
    }, { capture: true });
    listen('pointerdown', (x, y) => { this.down = [x, y]; });
    listen('pointermove', (x, y) => this.show(this.closes(x, y) ? this.nodes![0] : events.placeAt(x, y)));
    listen('pointerup', () => {});
    canvas.addEventListener('click', (event) => this.click(event));
    addEventListener('keydown', (event) => this.key(event), { capture: true });
  }

  get draws(): boolean {
    return this.nodes !== null;
  }

  start(): void {
    this.nodes = [];
    this.canvas.style.cursor = 'crosshair';
    this.canvas.focus();
    this.show(null);
  }

  end(closed: boolean): void {
    const nodes = this.nodes;
    if (!nodes) return;
    this.nodes = null;
    this.canvas.style.cursor = '';
    this.events.changed([], null);
    this.events.ended(nodes.length > 1 ? nodes : [], closed);
  }

  back(): void {
    this.nodes?.pop();
    this.show(null);
  }

  private click(event: MouseEvent): void {
    const { offsetX: x, offsetY: y, detail } = event;
    if (!this.nodes) return;
    event.stopImmediatePropagation();
    if (Math.hypot(x - this.down[0], y - this.down[1]) > clickReach) return;
    if (detail > 1) return this.end(false);
    if (this.closes(x, y)) return this.end(true);
    const place = this.events.placeAt(x, y);
    if (place) this.nodes.push(place);
    this.show(null);
  }

  private closes(x: number, y: number): boolean {
    if (!this.nodes || this.nodes.length < 3) return false;
    const [across, down] = this.events.pixelOf(this.nodes[0]);
    return Math.hypot(across - x, down - y) <= reach;
  }

  private show(next: Vector | null): void {
    if (this.nodes) this.events.changed(this.nodes, next);
  }

  private key(event: KeyboardEvent): void {
    if (!this.nodes || event.ctrlKey || event.metaKey || event.altKey || (event.target as Element).closest('input, select, textarea, dialog[open]')) return;
    const does = { Enter: () => this.end(false), Backspace: () => this.back(), Escape: () => { this.nodes = []; this.end(false); } }[event.key];
    // On a button, Enter presses it.
    if (!does || (event.key === 'Enter' && (event.target as Element).closest('button'))) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    does();
  }
}
