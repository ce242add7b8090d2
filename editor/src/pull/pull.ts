// Moves held nodes or normals towards the pointer. A shape follows short steps quickly and long ones badly, so long
// ways are divided into steps whose length recently took few iterations.

import type { Vector } from '../base/vectors';
import type { Drag, Part } from '../library/protocol';

// After 30 iterations the library fairs anew, which takes many times as long.
const few = 8;
const many = 15;

export class Pull {
  private target: Vector = [0, 0, 0];
  private there: Vector = [0, 0, 0];
  private time = 0;
  private longest: number;

  /**
   * at: what is held of the nodes, three numbers each, that far on the way. size: of a way that changes all, such as that of the shape.
   * first: step, as a share of it; Infinity for curves, where the length of a step does not matter.
   */
  constructor(
    readonly part: Part,
    readonly nodes: readonly number[],
    private readonly at: (way: Vector) => Float64Array,
    private readonly size: number,
    first = 0.02,
  ) {
    this.longest = first * size;
  }

  /** What is to be held at last. */
  get vectors(): Float64Array {
    return this.at(this.target);
  }

  /** How far it is to go. */
  get way(): Vector {
    return this.target;
  }

  get arrived(): boolean {
    return this.target.every((part, i) => part === this.there[i]);
  }

  aim(way: Vector, time: number): void {
    Object.assign(this, { target: way, time });
  }

  /** All the way at once. */
  whole(): Drag {
    return { part: this.part, nodes: Int32Array.from(this.nodes), vectors: this.vectors, way: this.target, time: this.time };
  }

  /** What to solve next. On the way its time is so long ago that its frame does not count. */
  step(): Drag {
    const rest = this.target.map((part, i) => part - this.there[i]);
    const share = Math.min(1, this.longest / Math.hypot(...rest));
    if (!(share < 1)) return this.whole();
    const way = this.there.map((part, i) => part + share * rest[i]) as Vector;
    return { ...this.whole(), vectors: this.at(way), way, time: -Infinity };
  }

  /** A step is made; iterations: that it took. */
  solved({ way }: Drag, iterations: number): void {
    this.there = way;
    if (Number.isFinite(this.longest)) this.longest = Math.min(this.size, this.longest * (iterations <= few ? 2 : iterations > many ? 0.5 : 1));
  }
}
