// Mirror symmetry about a plane through the origin: which node is the image of which, and how a move is mirrored.

import type { Vector } from '../base/vectors';
import type { Shape } from './shape';

/** How far from the mirror image of a node another one may be to count as that, in mean lengths of edges. */
const slack = 0.1;

export class Mirror {
  /** By node its image, which is itself on the plane; -1: none. */
  private readonly images: Int32Array;
  private readonly input: Float64Array;

  /** axis: across the plane; 0, 1 or 2. */
  constructor(shape: Pick<Shape, 'input' | 'scale' | 'spacing'>, readonly axis: number) {
    this.input = shape.input;
    const nearest = nearestOf(shape.input, axis, (slack * shape.spacing) / shape.scale);
    this.images = nearest.map((image, node) => (image >= 0 && nearest[image] === node ? image : -1));
  }

  /** How many nodes have an image. */
  get count(): number {
    return this.images.reduce((count, image) => count + Number(image >= 0), 0);
  }

  /** These and their images, each once. */
  with(nodes: Iterable<number>): number[] {
    const all = new Set(nodes);
    for (const node of [...all]) if (this.images[node] >= 0) all.add(this.images[node]);
    return [...all];
  }

  /** What another node does as one goes that way, or turns so: on the other side of the plane the mirror image, on the plane no more than stays on it. */
  mirrored(way: Vector, of: number, node: number, turns: boolean): Vector {
    const side = this.sideOf(of, node);
    return way.map((part, i) => ((i === this.axis) === turns ? part : side * part)) as Vector;
  }

  private sideOf(of: number, node: number): number {
    const image = this.images[node];
    if (image < 0) return 1;
    if (image === node) return 0;
    const first = this.images[of] === of ? 1 : this.input[3 * of + this.axis];
    return first * this.input[3 * node + this.axis] < 0 ? -1 : 1;
  }
}

/** The node nearest to the mirror image of each, within the distance; -1: none. Linear in the nodes: they are looked up by cells as large as that. */
function nearestOf(places: Float64Array, axis: number, distance: number): Int32Array {
  const count = places.length / 3;
  const size = 1 << Math.ceil(Math.log2(2 * count + 2));
  const first = new Int32Array(size).fill(-1);
  const next = new Int32Array(count);
  const slot = (x: number, y: number, z: number): number => ((Math.imul(x, 73856093) ^ Math.imul(y, 19349663) ^ Math.imul(z, 83492791)) >>> 0) & (size - 1);
  const cell = (part: number): number => Math.floor(part / distance);
  for (let node = 0; node < count; ++node) {
    const at = slot(cell(places[3 * node]), cell(places[3 * node + 1]), cell(places[3 * node + 2]));
    next[node] = first[at];
    first[at] = node;
  }
  return Int32Array.from({ length: count }, (_, node) => {
    const image = [0, 1, 2].map((i) => (i === axis ? -1 : 1) * places[3 * node + i]);
    const [x, y, z] = image.map(cell);
    let found = -1;
    let least = distance;
    for (let k = 0; k < 27; ++k) {
      for (let other = first[slot(x + (k % 3) - 1, y + (Math.floor(k / 3) % 3) - 1, z + Math.floor(k / 9) - 1)]; other >= 0; other = next[other]) {
        const away = Math.hypot(places[3 * other] - image[0], places[3 * other + 1] - image[1], places[3 * other + 2] - image[2]);
        if (away > least || (away === least && found >= 0)) continue;
        found = other;
        least = away;
      }
    }
    return found;
  });
}
