// Tools that pick many nodes at once: a box, a lasso and a brush, drawn over the view.

import { projected, type Seen } from '../view/seen';
import { visibleNodes } from './visible';
import { inBox, inLoop, Squares } from './within';

export const tools = ['pick', 'box', 'lasso', 'brush'] as const;
export type Tool = (typeof tools)[number];
type Point = [number, number];
/** Radii of the brush, in pixels. */
export const narrowest = 3;
export const widest = 300;

export interface ToolEvents {
  seen: () => Seen | null;
  picked: () => ReadonlySet<number>;
  pick: (nodes: ReadonlySet<number>) => void;
  /** Those nodes, and others that go with them. */
  withImages: (nodes: Iterable<number>) => Iterable<number>;
  /** Of those nodes the ones that lie within the others. */
  enclosed: (nodes: ReadonlySet<number>, others: Pick<ReadonlySet<number>, 'has'>) => Iterable<number>;
  /** The brush is in hand or no longer, or it works otherwise. */
  brush: () => void;
}

interface Stroke {
  id: number;
  points: Point[];
  screen: Float32Array;
  /** Of the brush. */
  squares: Squares | null;
  /** Null where all nodes count. */
  visible: Uint8Array | null;
  /** What the brush has gone over that is hidden. */
  hidden: Set<number>;
  before: ReadonlySet<number>;
  nodes: Set<number>;
  takes: boolean;
}

/** For the first button or finger; while a second finger is down, the view moves. */
export class Tools {
  tool: Tool = 'pick';
  /** Whether box and lasso leave out what is hidden; the brush always does. */
  visibleOnly = false;
  /** Of the brush, in pixels. */
  radius = 24;
  /** Whether the brush takes away, as it does with Alt. */
  erases = false;
  private pointer: Point = [0, 0];
  private stroke: Stroke | null = null;
  private asked = false;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly overlay: SVGSVGElement, private readonly events: ToolEvents) {
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.up(event));
    canvas.addEventListener('pointercancel', () => this.cancel());
    canvas.addEventListener('pointerenter', () => this.draw());
    canvas.addEventListener('pointerleave', () => this.overlay.replaceChildren());
  }

  /** Whether something is being drawn. */
  get busy(): boolean {
    return this.stroke !== null;
  }

  set(tool: Tool): void {
    this.cancel();
    this.tool = tool;
    this.erases = false;
    this.canvas.style.cursor = tool === 'pick' ? '' : tool === 'brush' ? 'none' : 'crosshair';
    this.events.brush();
    this.draw();
  }

  setRadius(radius: number): void {
    this.radius = Math.min(widest, Math.max(narrowest, Math.round(radius)));
    this.events.brush();
    this.draw();
  }

  setErases(erases: boolean): void {
    this.erases = erases;
    this.events.brush();
  }

  /** What was picked before the stroke is picked again. Returns whether there was one. */
  cancel(): boolean {
    const { stroke } = this;
    this.stroke = null;
    if (stroke) this.events.pick(stroke.before);
    this.draw();
    return stroke !== null;
  }

  private at(event: PointerEvent): Point {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private down(event: PointerEvent): void {
    if (this.stroke) this.cancel();
    const seen = this.events.seen();
    if (this.tool === 'pick' || event.button !== 0 || !event.isPrimary || !seen) return;
    this.canvas.setPointerCapture(event.pointerId);
    const screen = projected(seen);
    const before = this.events.picked();
    const adds = this.tool === 'brush' || event.shiftKey || event.altKey;
    this.pointer = this.at(event);
    this.stroke = {
      id: event.pointerId, points: [this.pointer], screen, before, squares: this.tool === 'brush' ? new Squares(screen, seen.width, seen.height) : null,
      nodes: new Set(adds ? before : []), takes: event.altKey || (this.tool === 'brush' && this.erases), hidden: new Set(),
      visible: this.visibleOnly || this.tool === 'brush' ? visibleNodes(screen, seen) : null,
    };
    if (this.tool === 'brush') this.paint();
    this.draw();
  }

  private move(event: PointerEvent): void {
    this.pointer = this.at(event);
    const { stroke } = this;
    if (stroke?.id === event.pointerId) {
      for (const part of event.getCoalescedEvents()) stroke.points.push(this.at(part));
      stroke.points.push(this.pointer);
      if (this.tool === 'brush') this.askToPaint();
    }
    this.draw();
  }

  private up(event: PointerEvent): void {
    const { stroke } = this;
    if (!stroke || stroke.id !== event.pointerId) return;
    stroke.points.push((this.pointer = this.at(event)));
    if (this.tool === 'brush') this.paintWithin();
    else this.take(this.tool === 'box' ? inBox(stroke.screen, stroke.points[0], this.pointer) : inLoop(stroke.screen, stroke.points));
    this.stroke = null;
    this.events.pick(stroke.nodes);
    this.draw();
  }

  private take(nodes: number[]): void {
    const { visible, takes, nodes: picked } = this.stroke!;
    for (const node of this.events.withImages(visible ? nodes.filter((which) => visible[which]) : nodes)) {
      if (takes) picked.delete(node);
      else picked.add(node);
    }
  }

  /** At most once a frame. */
  private askToPaint(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      if (this.stroke) this.paint();
    });
  }

  /** What is hidden, as behind a spike, goes with what is painted all around it. */
  private paintWithin(): void {
    this.paint();
    const { stroke, events } = this;
    const { nodes, hidden, takes } = stroke!;
    const open = new Set([...hidden].filter((node) => nodes.has(node) === takes));
    const others = takes ? { has: (node: number) => !nodes.has(node) } : nodes;
    stroke!.visible = null;
    this.take([...events.enclosed(open, others)]);
  }

  private paint(): void {
    const { points, squares, nodes, visible, hidden } = this.stroke!;
    points.forEach((to, k) => {
      const under = squares!.inStroke(points[Math.max(0, k - 1)], to, this.radius);
      for (const node of under) if (!visible![node]) hidden.add(node);
      this.take(under);
    });
    points.splice(0, points.length - 1);
    this.events.pick(new Set(nodes));
  }

  private draw(): void {
    const shape = (name: string, attributes: Record<string, number | string>): void => {
      const element = document.createElementNS('http://www.w3.org/2000/svg', name);
      for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
      this.overlay.replaceChildren(element);
    };
    const { pointer: [x, y], stroke } = this;
    if (this.tool === 'brush') {
      shape('circle', { cx: x, cy: y, r: this.radius });
    } else if (!stroke) {
      this.overlay.replaceChildren();
    } else if (this.tool === 'box') {
      const [left, top] = stroke.points[0];
      shape('rect', { x: Math.min(x, left), y: Math.min(y, top), width: Math.abs(x - left), height: Math.abs(y - top) });
    } else {
      shape('polygon', { points: stroke.points.join(' ') });
    }
  }
}
