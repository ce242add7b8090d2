// Held nodes or normals on their way to the pointer. A shape follows short steps quickly and long ones badly, so long ways are made in
// steps, as long as lately took few iterations.

import type { Part, Vector } from './constraints';
import type { Drag } from './protocol';

// Beyond 30 the library fairs anew, which takes many times as long.
const few = 8;
const many = 15;

export class Pull {
  private target: Vector = [0, 0, 0];
  private there: Vector = [0, 0, 0];
  private time = 0;
  private longest: number;

  /**
   * at: what is held of the nodes, three numbers each, that far on the way. size: of a way that changes all, such as that of the shape.
   * stepwise: not for curves, where the length of a step does not matter.
   */
  constructor(
    readonly part: Part,
    readonly nodes: readonly number[],
    private readonly at: (way: Vector) => Float64Array,
    private readonly size: number,
    private readonly stepwise = true,
  ) {
    this.longest = stepwise ? 0.02 * size : Infinity;
  }

  /** What is to be held at last. */
  get vectors(): Float64Array {
    return this.at(this.target);
  }

  get arrived(): boolean {
    return this.target.every((part, i) => part === this.there[i]);
  }

  aim(way: Vector, time: number): void {
    Object.assign(this, { target: way, time });
  }

  /** What to solve next. On the way its time is so long ago that its frame does not count. */
  step(): Drag {
    const rest = this.target.map((part, i) => part - this.there[i]);
    const share = Math.min(1, this.longest / Math.hypot(...rest));
    const way = share < 1 ? (this.there.map((part, i) => part + share * rest[i]) as Vector) : this.target;
    return { part: this.part, nodes: Int32Array.from(this.nodes), vectors: this.at(way), way, time: share < 1 ? -Infinity : this.time };
  }

  /** A step is made; iterations: that it took. */
  solved({ way }: Drag, iterations: number): void {
    this.there = way;
    if (this.stepwise) this.longest = Math.min(this.size, this.longest * (iterations <= few ? 2 : iterations > many ? 0.5 : 1));
  }
}
