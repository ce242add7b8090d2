// Regions: only some nodes move. The others stay as shown, and next to them the shape keeps the tangents of the part
// outside.

import type { Vector } from '../base/vectors';
import type { Region } from '../library/protocol';
import { isUntouched, ownRules, type Constraints, type Rule } from './constraints';
import type { Renumbered } from './nodes';

/** In place of what another region held: what that one has moved stays as it is seen. start: the positions from which all is solved. */
export function restricted(constraints: Constraints, nodes: Iterable<number>, { fixed, rim, normals, tangents }: Region, start: Float64Array, seen: Float64Array): Constraints {
  const place = (node: number): Vector => [...seen.subarray(3 * node, 3 * node + 3)] as Vector;
  const moved = (node: number): boolean => [0, 1, 2].some((i) => seen[3 * node + i] !== start[3 * node + i]);
  const inside = new Set(nodes);
  const outside = [...Array(start.length / 3).keys()].filter((node) => !inside.has(node));
  const held = new Set(fixed);
  const region: Rule[] = [];
  const still = outside.filter((node) => held.has(node) && !moved(node));
  const kept = outside.filter(moved);
  if (still.length > 0) region.push({ nodes: still, position: 'fixed' });
  if (kept.length > 0) region.push({ nodes: kept, position: kept.map(place) });
  for (const [part, directions] of [['normal', normals], ['tangent', tangents]] as const) {
    if (directions?.length) region.push({ nodes: [...rim], [part]: Array.from(rim, (_, k) => [...directions.subarray(3 * k, 3 * k + 3)]) });
  }
  return { ...constraints, rules: ownRules(constraints), region, edits: {} };
}

/** A new node between two that a region keeps is kept too, where it is seen. */
export function keepingAdded(constraints: Constraints, { added }: Renumbered, seen: Float64Array): Constraints {
  const { region } = constraints;
  if (!region || isUntouched(constraints)) return constraints;
  const kept = added.filter(({ between }) => between.every((node) => keepsSome(region, [node]))).map(({ node }) => node);
  return kept.length > 0 ? { ...constraints, region: [...region, { nodes: kept, position: kept.map((node) => [...seen.subarray(3 * node, 3 * node + 3)]) }] } : constraints;
}

/** Whether the rules of a region keep one of those nodes where it is. */
export function keepsSome(region: readonly Rule[], nodes: readonly number[]): boolean {
  const wanted = new Set<unknown>(nodes);
  return region.some((rule) => rule.position !== undefined && Array.isArray(rule.nodes) && rule.nodes.some((node) => wanted.has(node)));
}
