// Extrapolates a large shape from its last shapes and the pointer while the library still works on it, so the picture
// keeps up with the pointer.

import { dot, type Vector } from '../base/vectors';

interface Reached {
  way: Vector;
  positions: Float64Array;
  /** Foreseen by the library, not solved. */
  rough: boolean;
}

/** The newest and two ways from it: a drag goes in two directions, seldom in three. */
const depth = 3;
/** Of ways in nearly one direction: their difference is told from errors. */
const damping = 1e-3;
/** Times the longest way that is known. */
const farthest = 8;

export class Ahead {
  /** The newest first. */
  private reached: Reached[];

  /** start: the shape as the drag begins; null where that is still to be solved. */
  constructor(start: Float64Array | null) {
    this.reached = start ? [{ way: [0, 0, 0], positions: start, rough: false }] : [];
  }

  /** The shape with what is dragged that far on the way. What was foreseen is forgotten once something is solved. */
  add(way: Vector, positions: Float64Array, rough: boolean): void {
    const known = this.reached.filter((shape) => !shape.rough);
    this.reached = rough ? [...known, { way, positions, rough }] : [{ way, positions, rough }, ...known].slice(0, depth);
  }

  /** The newest shape, moved on to that way, or as far as it is known where that leads; null where there is none. */
  at(way: Vector): Float64Array | null {
    if (this.reached.length === 0) return null;
    const [base, ...others] = this.reached;
    const steps = others.map((shape) => ({ shape, way: minus(shape.way, base.way) })).filter((step) => dot(step.way, step.way) > 0);
    const rest = minus(way, base.way);
    const longest = Math.max(0, ...steps.map((step) => Math.hypot(...step.way)));
    const share = Math.min(1, (farthest * longest) / Math.hypot(...rest));
    if (!(share > 0)) return base.positions;
    const positions = base.positions.slice();
    sharesOf(steps.map((step) => step.way), rest).forEach((part, s) => {
      const { positions: other } = steps[s].shape;
      for (let k = 0; k < positions.length; ++k) positions[k] += share * part * (other[k] - base.positions[k]);
    });
    return positions;
  }
}

function minus(a: Vector, b: Vector): Vector {
  return a.map((part, i) => part - b[i]) as Vector;
}

/** How much of one or two ways comes nearest to another: least squares. */
function sharesOf(ways: Vector[], to: Vector): number[] {
  const lengths = ways.map((way) => Math.hypot(...way));
  const along = ways.map((way, k) => dot(way, to) / lengths[k]);
  if (ways.length === 1) return [along[0] / lengths[0]];
  const cosine = dot(ways[0], ways[1]) / lengths[0] / lengths[1];
  const own = 1 + damping;
  const determinant = own * own - cosine * cosine;
  return [(own * along[0] - cosine * along[1]) / determinant / lengths[0], (own * along[1] - cosine * along[0]) / determinant / lengths[1]];
}
