// A preview of the curve through the places drawn so far. One request runs at a time; of waiting ones only the newest
// is kept.

import type { Vector } from '../base/vectors';
import type { Ask } from '../library/protocol';

/** A curve of more nodes would come too late. */
const most = 2000;

export class Preview {
  private wanted: Ask<'draw'> | null = null;
  private busy = false;

  /** show: places of the curve, three numbers each, its first one again where it is closed. */
  constructor(private readonly ask: (curve: Ask<'draw'>) => Promise<Float64Array>, private readonly show: (curve: Float64Array) => void) {}

  /** perSpan: nodes to be between two places. Until the curve is there, and where there is none, the places are joined by lines. */
  through(places: readonly Vector[], closed: boolean, perSpan: number): void {
    const spans = places.length - (closed ? 0 : 1);
    this.wanted = spans > 0 ? { places: Float64Array.from(places.flat()), closed, nodes: Math.min(perSpan, Math.ceil(most / spans)) * spans + (closed ? 0 : 1) } : null;
    if (spans < 2) this.show(Float64Array.from(places.flat()));
    void this.next();
  }

  private async next(): Promise<void> {
    const { wanted } = this;
    if (!wanted || this.busy) return;
    this.busy = true;
    const { places, closed } = wanted;
    const curve = await this.ask(wanted).catch(() => Float64Array.of(...places, ...(closed ? places.subarray(0, 3) : [])));
    this.busy = false;
    if (this.wanted) this.show(curve);
    if (this.wanted === wanted) this.wanted = null;
    else void this.next();
  }
}
