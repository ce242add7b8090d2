// The plane, if chosen, about which picks and moves are mirrored.

import { Mirror } from '../shape/mirror';
import type { Shape } from '../shape/shape';

export class Symmetry {
  /** Across the plane: 0, 1 or 2; null: there is none. */
  axis: number | null = null;
  private made: { shape: Shape; mirror: Mirror } | null = null;

  constructor(private readonly shape: () => Shape | null) {}

  /** Of what is open; each time the same one. */
  get mirror(): Mirror | null {
    const { axis, made } = this;
    const shape = this.shape();
    if (!shape || axis === null) return null;
    if (made?.shape !== shape || made.mirror.axis !== axis) this.made = { shape, mirror: new Mirror(shape, axis) };
    return this.made!.mirror;
  }

  /** Those nodes and their mirror images. */
  with(nodes: Iterable<number>): Iterable<number> {
    return this.mirror?.with(nodes) ?? nodes;
  }
}
