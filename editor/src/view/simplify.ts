// Fewer triangles for pictures of a drag without a graphics card, where each costs as much as its pixels.

import type { MeshoptSimplifier } from 'meshoptimizer/simplifier';

let simplifier: typeof MeshoptSimplifier | null = null;

/** To be called once by who will want fewer triangles: what it takes is not small. Where it cannot be loaded there are as many as ever. */
export async function loadSimplifier(): Promise<void> {
  const loaded = (await import('meshoptimizer/simplifier')).MeshoptSimplifier;
  await loaded.ready;
  simplifier = loaded;
}

/**
 * Triangles of some of the same vertices, of about one size and along the same boundaries and sharp edges; about as many as asked for, or
 * more where those allow no less. places: three numbers a vertex. Null until it is loaded.
 */
export function simplified(triangles: Uint32Array, places: Float32Array, count: number): Uint32Array | null {
  if (!simplifier?.supported) return null;
  // Else nearly flat parts would get huge triangles, which become visible when bent.
  return simplifier.simplify(triangles, places, 3, 3 * count, 1, ['Regularize', 'LockBorder'])[0];
}
