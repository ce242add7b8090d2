// Scattered points that the shape is fitted to, and how.

import type { NamedBytes } from '../base/files';
import type { FitSettings } from '../library/protocol';
import type { Stay } from '../shape/stays';

/** Points as the worker knows them by their number; without bytes they were nodes of the shape itself. */
export interface Cloud {
  number: number;
  name: string;
  bytes: Uint8Array | null;
  positions: Float64Array;
}

export type PointSource = NamedBytes | Float64Array;

export function sourceOf({ name, bytes, positions }: Cloud): PointSource {
  return bytes ? { name, bytes } : positions;
}

/** Part of what holds: undo takes it back. */
export interface Fit extends FitSettings {
  readonly cloud: Cloud;
  /** What its nodes keep of their places along the shape. */
  readonly stay?: Stay;
}
