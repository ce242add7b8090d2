// Dragging the arrows of normals or tangents: the head follows the pointer around the node.

import { tilted, tiltedWithin, turnBetween } from '../base/turning';
import { cross, type Vector } from '../base/vectors';
import type { Editor } from '../edit/editor';
import { Arrows } from '../view/arrows';
import type { View } from '../view/view';

function unit(vector: Vector): Vector {
  const length = Math.hypot(...vector);
  return vector.map((part) => part / length) as Vector;
}

export class Tilts {
  private start: { id: number; x: number; y: number; node: number; normal: Vector; moved: boolean } | null = null;

  /** To be made before whatever else listens to the pointer. */
  constructor(private readonly canvas: HTMLCanvasElement, private readonly editor: Editor, private readonly view: () => View, private readonly active: () => boolean) {
    const options = { capture: true };
    canvas.addEventListener('pointerdown', (event) => this.down(event), options);
    canvas.addEventListener('pointermove', (event) => this.move(event), options);
    canvas.addEventListener('pointerup', (event) => this.up(event), options);
    canvas.addEventListener('pointercancel', () => this.cancel(), options);
  }

  /** Ends a tilt as if it had not been. Returns whether there was one. */
  cancel(): boolean {
    const tilting = this.start?.moved;
    this.start = null;
    if (tilting) this.editor.drags.end(false);
    return !!tilting;
  }

  private pick(event: PointerEvent): number {
    const seen = this.active() ? this.view().seen() : null;
    const box = this.canvas.getBoundingClientRect();
    return seen ? this.view().arrows.pick(seen, event.clientX - box.left, event.clientY - box.top, event.pointerType === 'mouse' ? 9 : 20) : -1;
  }

  private down(event: PointerEvent): void {
    if (this.start || event.button !== 0 || !event.isPrimary) return;
    const node = this.pick(event);
    if (node < 0) return;
    event.stopImmediatePropagation();
    this.canvas.setPointerCapture(event.pointerId);
    this.canvas.focus();
    if (event.shiftKey || !this.editor.picked.has(node)) this.editor.pick(node, event.shiftKey);
    if (this.editor.picked.has(node)) this.start = { id: event.pointerId, x: event.clientX, y: event.clientY, node, normal: this.editor.normals.get(node)!, moved: false };
  }

  private move(event: PointerEvent): void {
    const { start } = this;
    if (!start) {
      if (event.buttons === 0) this.hover(event);
      return;
    }
    if (event.pointerId !== start.id) return;
    event.stopImmediatePropagation();
    const [across, down] = [event.clientX - start.x, event.clientY - start.y];
    if (!start.moved) {
      if (Math.hypot(across, down) <= 2) return;
      start.moved = true;
      this.editor.drags.begin(this.editor.direction, start.node, performance.now());
    }
    const [right, up] = [unit(this.view().wayOf(1, 0)), unit(this.view().wayOf(0, -1))];
    const length = Arrows.lengthIn(this.canvas.clientHeight);
    const plane = this.editor.shape?.curve?.plane;
    const frame = [right, up, cross(right, up)] as const;
    const normal = plane ? tiltedWithin(plane, start.normal, frame, across / length, -down / length) : tilted(start.normal, frame, across / length, -down / length);
    this.editor.drags.by(turnBetween(start.normal, normal), event.timeStamp);
  }

  private up(event: PointerEvent): void {
    if (event.pointerId !== this.start?.id) return;
    event.stopImmediatePropagation();
    const { moved } = this.start;
    this.start = null;
    if (moved) this.editor.drags.end(true);
  }

  private hover(event: PointerEvent): void {
    const node = this.pick(event);
    const atArrow = node >= 0;
    if (atArrow) {
      event.stopImmediatePropagation();
      this.canvas.style.cursor = 'move';
    }
    if (atArrow !== this.editor.atArrow || (atArrow && node !== this.editor.hovered)) this.editor.set({ hovered: node, atArrow });
  }
}
