// Held nodes on their way to the pointer. A shape follows short steps quickly and long ones badly, so long ways are made in steps,
// as long as lately took few iterations.

import type { Drag } from './protocol';
import type { Vector } from './constraints';

// Beyond 30 the library fairs anew, which takes many times as long.
const few = 8;
const many = 15;

export class Pull {
  private target: Vector = [0, 0, 0];
  private there: Vector = [0, 0, 0];
  private time = 0;
  private longest: number;

  /** start: three numbers for each node. size: of the shape, in the same units. stepwise: not for curves, where the length of a step does not matter. */
  constructor(readonly nodes: readonly number[], private readonly start: Float64Array, private readonly size: number, private readonly stepwise = true) {
    this.longest = stepwise ? 0.02 * size : Infinity;
  }

  /** Where the nodes are to be at last. */
  get places(): Float64Array {
    return this.start.map((part, k) => part + this.target[k % 3]);
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
    const next = share < 1 ? this.there.map((part, i) => part + share * rest[i]) : this.target;
    const places = this.start.map((part, k) => part + next[k % 3]);
    return { nodes: Int32Array.from(this.nodes), places, time: share < 1 ? -Infinity : this.time };
  }

  /** The places of a step are reached; iterations: that took. */
  solved({ places }: Drag, iterations: number): void {
    this.there = [0, 1, 2].map((i) => places[i] - this.start[i]) as Vector;
    if (places.every((part, k) => part === this.start[k] + this.target[k % 3])) this.there = this.target;
    if (this.stepwise) this.longest = Math.min(this.size, this.longest * (iterations <= few ? 2 : iterations > many ? 0.5 : 1));
  }
}
