// The way of a drag: with the pointer in the plane of the view, along an axis, or along the normal of the node. Keys
// change it during the drag.

import { dot, type Vector } from '../base/vectors';

export type Line = 'x' | 'y' | 'z' | 'n';

const axes: Record<'x' | 'y' | 'z', Vector> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

/** The way along a unit vector that is seen nearest to the pointer. right, down: of a pixel, in the plane of the view. */
export function along(axis: Vector, right: Vector, down: Vector, across: number, downwards: number): Vector {
  const square = dot(right, right);
  const [x, y] = [dot(axis, right) / square, dot(axis, down) / square];
  // The pointer gives no distance along an axis that points at the eye.
  const seen = (x * x + y * y) * square;
  const far = seen < 0.0025 ? 0 : (across * x + downwards * y) / (x * x + y * y);
  return axis.map((part) => part * far) as Vector;
}

export interface WayEvents {
  /** What so many pixels are in the plane of the view. */
  wayOf: (across: number, down: number) => Vector;
  normal: () => Vector;
  /** Another way than before leads to another place. */
  moved: (way: Vector, time: number) => void;
}

export class Ways {
  private line: Line | null = null;
  private pointer: { across: number; down: number; time: number } | null = null;

  constructor(private readonly hint: HTMLElement, private readonly events: WayEvents) {
    addEventListener('keydown', (event) => this.key(event), { capture: true });
  }

  begin(): void {
    this.line = null;
    this.pointer = { across: 0, down: 0, time: 0 };
    this.describe();
  }

  by(across: number, down: number, time: number): void {
    if (!this.pointer) return;
    this.pointer = { across, down, time };
    this.aim();
  }

  end(): void {
    this.pointer = null;
    this.hint.hidden = true;
  }

  private key(event: KeyboardEvent): void {
    const key = event.key.toLowerCase();
    if (!this.pointer || event.ctrlKey || event.metaKey || event.altKey || !['x', 'y', 'z', 'n'].includes(key)) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    if (event.repeat) return;
    this.line = this.line === key ? null : (key as Line);
    this.describe();
    this.aim();
  }

  private aim(): void {
    const { across, down, time } = this.pointer!;
    const { line, events } = this;
    const axis = line && (line === 'n' ? events.normal() : axes[line]);
    events.moved(axis ? along(axis, events.wayOf(1, 0), events.wayOf(0, 1), across, down) : events.wayOf(across, down), time);
  }

  private describe(): void {
    const { line } = this;
    this.hint.hidden = false;
    this.hint.textContent = line
      ? `Along ${line === 'n' ? 'the normal' : line.toUpperCase()} · ${line.toUpperCase()} again: free`
      : 'In the plane of the view · X, Y, Z: along an axis · N: along the normal';
  }
}
