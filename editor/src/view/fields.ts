// What colours can show of a surface: numbers at its nodes, the range of the colours, and what they are called.

import { diverging, sequential } from '../../../page/colours.js';
import { deviationsOf, normalsOf } from '../../../page/mesh.js';
import { aboutMiddle, aboutZero } from '../../../page/surface_fields.js';
import { unitOf } from '../base/units';
import type { Curvatures } from '../library/protocol';
import type { Shape } from '../shape/shape';

export const fieldNames = ['mean', 'gaussian', 'deviation'] as const;
export type FieldName = (typeof fieldNames)[number];

export interface Field {
  name: FieldName;
  title: string;
  /** Nine colours. */
  map: number[][];
  range: [number, number];
  values: ArrayLike<number>;
}

type Values = Float64Array | Float32Array;

export interface FieldEvents {
  ask: (positions: Float64Array) => Promise<Curvatures>;
  /** What is to be seen: null where no colours are asked for. */
  show: (field: Field | null) => void;
  failed: (message: string) => void;
}

function titleOf(name: FieldName): string {
  const unit = unitOf();
  if (name === 'mean') return `Mean curvature, 1 / ${unit || 'unit of the file'}`;
  return name === 'gaussian' ? `Gaussian curvature, 1 / ${unit || 'unit'}²` : `Deviation from the input, ${unit || 'units of the file'}`;
}
// What may be asked of the library before the next shape of a drag, in milliseconds.
const cheap = 12;

/** Keeps up with the shape that is seen; its colours have the range of the result, so that input and result can be compared. */
export class Fields {
  private name: FieldName | null = null;
  private shape: Shape | null = null;
  private normals: Float32Array | null = null;
  private seen: Float64Array = new Float64Array();
  private result: Float64Array = new Float64Array();
  private range: [number, number] | null = null;
  private busy = false;
  private settled = true;
  private cost = 0;
  private share = 0.96;

  constructor(private readonly events: FieldEvents) {}

  open(shape: Shape): void {
    Object.assign(this, { shape, normals: null, seen: shape.input, result: shape.input, range: null, settled: true });
    if (this.name) this.events.show(null);
    void this.update();
  }

  choose(name: FieldName | null): void {
    if (name === this.name) return;
    Object.assign(this, { name, range: null, settled: true });
    this.events.show(null);
    void this.update();
  }

  /** settled: it is not one of many during a drag, whose range of colours stays. */
  move(seen: Float64Array, result: Float64Array, settled: boolean): void {
    Object.assign(this, { seen, result, settled });
    if (settled) this.range = null;
    void this.update();
  }

  /** The share of the nodes whose values the colours are spread over; others have the colours of the ends. */
  setShare(share: number): void {
    Object.assign(this, { share, range: null, settled: true });
    void this.update();
  }

  private async update(): Promise<void> {
    const { name, shape, seen, result, settled } = this;
    if (!name || !shape || shape.curve || this.busy || (!settled && name !== 'deviation' && this.cost > cheap)) return;
    this.busy = true;
    const begin = performance.now();
    const { share } = this;
    try {
      const values = await this.valuesOf(name, shape, seen);
      this.cost = performance.now() - begin;
      const known = this.range ?? rangeOf(name, seen === result ? values : await this.valuesOf(name, shape, result), 1 / shape.scale, share);
      if (name === this.name && shape === this.shape) {
        if (result === this.result && share === this.share) this.range = known;
        this.events.show({ name, title: titleOf(name), map: name === 'mean' ? sequential : diverging, range: known, values });
      }
    } catch (error) {
      this.events.failed((error as Error).message);
    }
    this.busy = false;
    if (name !== this.name || seen !== this.seen || result !== this.result || share !== this.share) void this.update();
  }

  private async valuesOf(name: FieldName, shape: Shape, positions: Float64Array): Promise<Values> {
    if (name === 'deviation') {
      this.normals ??= normalsOf(shape.faces, shape.input, shape.edges) as Float32Array;
      return deviationsOf(positions, shape.input, this.normals) as Float32Array;
    }
    const { k1, k2 } = await this.events.ask(positions);
    return k1.map((first, node) => (name === 'mean' ? (first + k2[node]) / 2 : first * k2[node]));
  }
}

/** size: of the shape, for the least range, as in the page of --html. */
function rangeOf(name: FieldName, values: Values, size: number, share: number): [number, number] {
  if (name === 'mean') return aboutMiddle(values, 0.01 / size, share) as [number, number];
  return aboutZero(values, name === 'gaussian' ? 0.01 / size ** 2 : 1e-6 * size, share) as [number, number];
}
