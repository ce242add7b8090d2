// Scattered points that the shape is drawn towards, and how.

import type { FitSettings } from '../library/protocol';

/** Of a file; without bytes the nodes of the input. */
export interface PointSource {
  name: string;
  bytes: Uint8Array | null;
}

/** Points as the worker knows them by their number. */
export interface Cloud extends PointSource {
  number: number;
  positions: Float64Array;
}

/** Part of what holds: undo takes it back. */
export interface Fit extends FitSettings {
  readonly cloud: Cloud;
}
