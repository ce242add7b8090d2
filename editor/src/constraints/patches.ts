// Patches of filled holes: their nodes and faces follow those of the file, and keep their numbers.

import type { Patches } from '../library/protocol';

export interface Filled {
  readonly patches: Patches;
  /** What was said as they were made. */
  readonly warnings: readonly string[];
}

function followed<Numbers extends Int32Array | Float64Array>(first: Numbers, then: Numbers): Numbers {
  const all = new (first.constructor as new (count: number) => Numbers)(first.length + then.length);
  all.set(first);
  all.set(then, first.length);
  return all;
}

/** Those that were there, if any, and behind them newer ones, which are numbered on from them. */
export function withMore(before: Filled | undefined, { patches, warnings }: Filled): Filled {
  if (!before) return { patches, warnings };
  const { positions, corners, nodeLike, faceLike, groupBegin, groupNames } = before.patches;
  return {
    patches: {
      positions: followed(positions, patches.positions),
      corners: followed(corners, patches.corners),
      nodeLike: followed(nodeLike, patches.nodeLike),
      faceLike: followed(faceLike, patches.faceLike),
      groupBegin: followed(groupBegin, patches.groupBegin),
      groupNames: [...groupNames, ...patches.groupNames],
    },
    warnings: [...before.warnings, ...warnings],
  };
}
