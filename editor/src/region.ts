// Only some nodes move: the others are fixed, and next to them the surface keeps the tangent planes of what lies outside.

import { allRules, type Constraints, type Rule } from './constraints';
import type { Region } from './protocol';

/** As --region holds it, as rules of their own after all others. */
export function restricted(constraints: Constraints, { fixed, rim, normals }: Region): Constraints {
  const added: Rule[] = [];
  if (fixed.length > 0) added.push({ nodes: [...fixed], position: 'fixed' });
  if (rim.length > 0) added.push({ nodes: [...rim], normal: Array.from(rim, (_, k) => [...normals.subarray(3 * k, 3 * k + 3)]) });
  return { rules: [...allRules(constraints), ...added], edits: {} };
}
