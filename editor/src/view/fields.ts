// Fields that colours can show on a surface: numbers at its nodes, the range of the colours, and names.

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

function titleOf(name: FieldName, fromInput: boolean): string {
  const unit = unitOf();
  if (name === 'mean') return `Mean curvature, 1 / ${unit || 'unit of the file'}`;
  return name === 'gaussian' ? `Gaussian curvature, 1 / ${unit || 'unit'}²` : `Deviation from ${fromInput ? 'the input' : 'what was applied last'}, ${unit || 'units of the file'}`;
}
// How long the library may take for a field during a drag, in milliseconds.
const cheap = 12;

/** Keeps up with the shape that is seen; its colours have the range of the result, so that input and result can be compared. */
export class Fields {
  private name: FieldName | null = null;
  private shape: Shape | null = null;
  /** What deviation is from, and its normals once they are asked for. */
  private from: Float64Array = new Float64Array();
  private normals: Float32Array | null = null;
  private seen: Float64Array = new Float64Array();
  private result: Float64Array = new Float64Array();
  private range: [number, number] | null = null;
  private busy = false;
  private settled = true;
  private cost = 0;
  share = 0.96;
  private field: Field | null = null;
  private readonly waiting: (() => void)[] = [];

  constructor(private readonly events: FieldEvents) {}

  open(shape: Shape): void {
    Object.assign(this, { shape, from: shape.input, normals: null, seen: shape.input, result: shape.input, range: null, settled: true });
    if (this.name) this.events.show(null);
    void this.update();
  }

  /** Deviation is from there. */
  compareWith(from: Float64Array): void {
    if (from === this.from) return;
    Object.assign(this, { from, normals: null, range: null });
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

  /** What is seen once all that was asked for has been told; null where no colours are. */
  async rest(): Promise<Field | null> {
    while (this.name && this.busy) await new Promise<void>((done) => this.waiting.push(done));
    return this.name ? this.field : null;
  }

  private async update(): Promise<void> {
    const { name, shape, seen, result, settled, from } = this;
    if (!name || !shape || shape.curve || this.busy || (!settled && name !== 'deviation' && this.cost > cheap)) return;
    this.busy = true;
    const begin = performance.now();
    const { share } = this;
    try {
      const values = await this.valuesOf(name, shape, seen);
      this.cost = performance.now() - begin;
      const known = this.range ?? rangeOf(name, seen === result ? values : await this.valuesOf(name, shape, result), 1 / shape.scale, share);
      if (name === this.name && shape === this.shape) {
        if (result === this.result && share === this.share && from === this.from) this.range = known;
        this.field = { name, title: titleOf(name, from === shape.input), map: name === 'mean' ? sequential : diverging, range: known, values };
        this.events.show(this.field);
      }
    } catch (error) {
      this.events.failed((error as Error).message);
    }
    this.busy = false;
    if (name !== this.name || seen !== this.seen || result !== this.result || share !== this.share || from !== this.from) void this.update();
    if (!this.busy) for (const done of this.waiting.splice(0)) done();
  }

  private async valuesOf(name: FieldName, shape: Shape, positions: Float64Array): Promise<Values> {
    if (name === 'deviation') {
      this.normals ??= normalsOf(shape.faces, this.from, shape.edges) as Float32Array;
      return deviationsOf(positions, this.from, this.normals) as Float32Array;
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
