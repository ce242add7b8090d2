// The pointer in the view: a click picks, a held node is dragged, everything else moves the camera.

export interface GestureEvents {
  /** Whether the pointer is to pick and drag, and no other tool is in hand. */
  active: () => boolean;
  /** The node at a point of the canvas, or -1. */
  pick: (x: number, y: number, radius: number) => number;
  draggable: (node: number) => boolean;
  hovered: (node: number) => void;
  picked: (node: number, add: boolean) => void;
  dragBegun: (node: number) => void;
  /** By so many pixels since the drag began; time: of the pointer there. */
  dragged: (across: number, down: number, time: number) => void;
  dropped: () => void;
  cancelled: () => void;
}

const clickReach = 4;

export class Gestures {
  private start: { id: number; x: number; y: number; node: number; moved: boolean; drags: boolean } | null = null;
  /** Where the pointer was last, until the next frame looks what is there. */
  private hovering: PointerEvent | null = null;

  /** To be made before the camera's controls, which must not see the pointer where a node is dragged. */
  constructor(private readonly canvas: HTMLCanvasElement, private readonly events: GestureEvents) {
    const options = { capture: true };
    canvas.addEventListener('pointerdown', (event) => this.down(event), options);
    canvas.addEventListener('pointermove', (event) => this.move(event), options);
    canvas.addEventListener('pointerup', (event) => this.up(event), options);
    canvas.addEventListener('pointercancel', () => this.cancel(), options);
    canvas.addEventListener('pointerleave', () => {
      this.hovering = null;
      events.hovered(-1);
    });
  }

  /** Ends a drag as if it had not been. Returns whether there was one. */
  cancel(): boolean {
    const dragged = this.start?.drags && this.start.moved;
    this.start = null;
    if (dragged) this.events.cancelled();
    return !!dragged;
  }

  private pick(event: PointerEvent): number {
    const box = this.canvas.getBoundingClientRect();
    return this.events.pick(event.clientX - box.left, event.clientY - box.top, event.pointerType === 'mouse' ? 12 : 24);
  }

  private down(event: PointerEvent): void {
    if (!event.isPrimary && this.start) this.joined(event);
    if (!this.events.active() || this.start || event.button !== 0 || !event.isPrimary) return;
    const node = this.pick(event);
    const drags = node >= 0 && !event.shiftKey && this.events.draggable(node);
    this.start = { id: event.pointerId, x: event.clientX, y: event.clientY, node, moved: false, drags };
    if (!drags) return;
    event.stopImmediatePropagation();
    this.canvas.setPointerCapture(event.pointerId);
  }

  /** A second finger: the view moves, and nothing is picked; it does not count while a node is dragged. */
  private joined(event: PointerEvent): void {
    if (this.start!.drags) event.stopImmediatePropagation();
    this.start!.moved = true;
  }

  private move(event: PointerEvent): void {
    const { start } = this;
    if (!start) {
      this.hover(event);
      return;
    }
    if (event.pointerId !== start.id) return;
    const [across, down] = [event.clientX - start.x, event.clientY - start.y];
    const begins = !start.moved && Math.hypot(across, down) > clickReach;
    start.moved ||= begins;
    if (!start.drags || !start.moved) return;
    if (begins) this.events.dragBegun(start.node);
    this.events.dragged(across, down, event.timeStamp);
  }

  private up(event: PointerEvent): void {
    const { start } = this;
    if (!start || event.pointerId !== start.id) return;
    this.start = null;
    if (!start.moved) this.events.picked(start.node, event.shiftKey);
    else if (start.drags) this.events.dropped();
  }

  /** At most once a frame. */
  private hover(event: PointerEvent): void {
    if (!this.events.active() || event.buttons !== 0) return;
    const asked = this.hovering !== null;
    this.hovering = event;
    if (asked) return;
    requestAnimationFrame(() => {
      const at = this.hovering;
      this.hovering = null;
      if (!at || this.start || !this.events.active()) return;
      const node = this.pick(at);
      this.canvas.style.cursor = node < 0 ? 'grab' : this.events.draggable(node) ? 'move' : 'pointer';
      this.events.hovered(node);
    });
  }
}
