// Only some nodes move: the others are fixed, and next to them the shape keeps the tangents of what lies outside.

import { allRules, type Constraints, type Rule } from './constraints';
import type { Region } from './protocol';

/** As --region holds it, as rules of their own after all others. */
export function restricted(constraints: Constraints, { fixed, rim, normals, tangents }: Region): Constraints {
  const added: Rule[] = [];
  if (fixed.length > 0) added.push({ nodes: [...fixed], position: 'fixed' });
  for (const [part, directions] of [['normal', normals], ['tangent', tangents]] as const) {
    if (directions?.length) added.push({ nodes: [...rim], [part]: Array.from(rim, (_, k) => [...directions.subarray(3 * k, 3 * k + 3)]) });
  }
  return { ...constraints, rules: [...allRules(constraints), ...added], edits: {} };
}
