// Trials: a shape shown for judgement before it becomes a step, and the state before.

import type { Report } from '../library/protocol';
import type { Constraints } from '../constraints/constraints';
import { furthest } from '../shape/between';
import type { Shape } from '../shape/shape';
import { slid } from '../shape/stays';

export interface Before {
  readonly positions: Float64Array;
  readonly strength: number;
  readonly report: Report | null;
}

/** How far nodes have come to positions: at most, and along the shape. */
export interface Moved {
  readonly positions: Float64Array;
  readonly all: number;
  readonly along: number;
}

export class Trial {
  constraints: Constraints | null = null;
  before: Before = { positions: new Float64Array(), strength: 1, report: null };
  private moves: Moved = { positions: new Float64Array(), all: 0, along: 0 };

  /** now: what there is, which stays as it was before the first of several. */
  begin(constraints: Constraints, now: Before): void {
    if (!this.constraints) this.before = now;
    this.constraints = constraints;
  }

  /** Returns what there was before; null where nothing is tried. */
  end(): Before | null {
    const { constraints, before } = this;
    this.constraints = null;
    return constraints && before;
  }

  /** Looked up where it is asked again of the same positions. */
  moved(shape: Shape, positions: Float64Array): Moved {
    const { before: { positions: from } } = this;
    if (!this.constraints) return { positions, all: 0, along: 0 };
    if (this.moves.positions !== positions) this.moves = { positions, all: furthest(positions, from), along: slid(shape, from, positions) };
    return this.moves;
  }
}
