// The constraints of the surface, as plain data: the rules of a constraints file, then changes by hand, node by node.

import type { Vector } from '../base/vectors';
import { parts, type CurveNodes, type Part, type SharpEdges } from '../library/protocol';
import type { Filled } from './patches';
import type { Fit } from './points';

export type Hold<Given> = 'fixed' | 'free' | Given;

/** One rule of a constraints file; what the editor does not know of it is kept as it is. */
export interface Rule {
  nodes: unknown;
  position?: unknown;
  normal?: unknown;
  tangent?: unknown;
  /** "tangent_in", "tangent_out" and "corner" of curves, and what else there may be. */
  [key: string]: unknown;
}

export interface Edit {
  position?: Hold<Vector>;
  normal?: Hold<Vector>;
  /** Of curves. */
  tangent?: Hold<Vector>;
}

/** Edges of a surface that stay sharp: those that turn by more than an angle, in degrees, and the rules that name them. */
export interface Sharp {
  readonly angle: number;
  readonly rules: readonly Rule[];
}

export interface Constraints {
  readonly rules: readonly Rule[];
  /** What keeps all outside a region where it is; null where all may move. It comes before the edits, and another region has others. */
  readonly region?: readonly Rule[] | null;
  readonly edits: Readonly<Record<number, Edit>>;
  readonly sharp?: Sharp;
  /** Of surfaces, and in no file: boundary nodes whose position is free are faired first, as curves. */
  readonly fairBoundary?: boolean;
  /** Nodes that were fixed for that, as loops are faired between nodes that are. */
  readonly loopNodes?: readonly number[];
  /** In no file either: points that the shape is drawn towards. */
  readonly fit?: Fit;
  /** In no file either: the shape that was applied, which all is solved from in place of the input. */
  readonly start?: Float64Array;
  /** In no file either: the nodes of a curve, which all else here numbers, where some were inserted or deleted. */
  readonly curve?: CurveNodes;
  /** In no file either: the patches of holes, whose nodes and faces follow those of the file. */
  readonly filled?: Filled;
}

export const initial: Constraints = { rules: [{ nodes: 'boundary', position: 'fixed' }], edits: {} };
/** As a file is opened: nothing moves, until it is said what is to. */
export const untouched: Constraints = { ...initial, region: [{ nodes: 'all', position: 'fixed' }] };

/** A shape that has come about is the one that all starts from; what drew it there does so no longer. */
export function baked(constraints: Constraints, start: Float64Array | undefined): Constraints {
  return { ...constraints, region: untouched.region, fit: undefined, start };
}

export function isUntouched({ region }: Constraints): boolean {
  return region === untouched.region || region?.[0]?.nodes === 'all';
}

/** Throws where the text is no constraints file; what its rules say is checked by the library. */
export function fromFile(text: string): Constraints {
  const rules = (JSON.parse(text) as { rules?: unknown }).rules;
  if (!Array.isArray(rules)) throw new Error('A constraints file has a list "rules"');
  return { rules: rules as Rule[], edits: {} };
}

export function allRules({ rules, region, edits, sharp }: Constraints): Rule[] {
  return [...rules, ...(region ?? []), ...byHand(edits), ...(sharp?.rules ?? [])];
}

/** Without those of the region. */
export function ownRules({ rules, edits, sharp }: Constraints): Rule[] {
  return [...rules, ...byHand(edits), ...(sharp?.rules ?? [])];
}

/** A path for each chain; one that is closed ends where it began by a path of its own. */
export function sharpRules({ chainBegin, chainNodes, closed }: Pick<SharpEdges, 'chainBegin' | 'chainNodes' | 'closed'>): Rule[] {
  return Array.from(closed, (loop, c) => {
    const nodes = [...chainNodes.subarray(chainBegin[c], chainBegin[c + 1])];
    return [nodes, ...(loop ? [[nodes[nodes.length - 1], nodes[0]]] : [])];
  }).flat().map((nodes) => ({ nodes, sharp: 'path' }));
}

function byHand(edits: Constraints['edits']): Rule[] {
  const nodes = Object.keys(edits).map(Number);
  const found: Rule[] = [];
  for (const part of parts) {
    for (const hold of ['fixed', 'free'] as const) {
      const these = nodes.filter((node) => edits[node][part] === hold);
      if (these.length > 0) found.push({ nodes: these, [part]: hold });
    }
    const given = nodes.filter((node) => Array.isArray(edits[node][part]));
    if (given.length > 0) found.push({ nodes: given, [part]: given.map((node) => edits[node][part]) });
  }
  return found;
}

/** The same for whoever has only the file of the input: what is fixed as it is where all starts is said by numbers. directions: of normals or tangents that are held. */
export function byInput(constraints: Constraints, { input, boundary }: { input: Float64Array; boundary: Uint8Array }, directions: ReadonlyMap<number, Vector>): Constraints {
  const { start } = constraints;
  if (!start) return constraints;
  const place = (node: number): Vector => [...start.subarray(3 * node, 3 * node + 3)] as Vector;
  const moved = (node: number): boolean => place(node).some((part, i) => part !== input[3 * node + i]);
  const spelled = (rule: Rule): Rule[] => {
    const among = [...(nodesOf(rule.nodes, boundary) ?? [])];
    const pieces: Rule[] = [];
    const rest: Rule = { ...rule };
    for (const part of parts) {
      const given = among.filter((node) => (part === 'position' ? moved(node) : directions.has(node)));
      if (rule[part] !== 'fixed' || given.length === 0) continue;
      delete rest[part];
      const numbered = new Set(given);
      const others = among.filter((node) => !numbered.has(node));
      pieces.push({ nodes: given, [part]: given.map((node) => (part === 'position' ? place(node) : directions.get(node))) });
      if (others.length > 0) pieces.push({ nodes: others, [part]: 'fixed' });
    }
    return Object.keys(rest).length > 1 ? [rest, ...pieces] : pieces;
  };
  return { rules: allRules(constraints).flatMap(spelled), edits: {} };
}

/** Numbers come out so that they are read as the same ones. */
export function toFile(constraints: Constraints): string {
  return `{"rules": [\n${allRules(constraints).map((rule) => '  ' + JSON.stringify(rule)).join(',\n')}\n]}\n`;
}

export function edited(constraints: Constraints, nodes: Iterable<number>, change: (node: number) => Edit): Constraints {
  const edits = { ...constraints.edits };
  for (const node of nodes) edits[node] = { ...edits[node], ...change(node) };
  return { ...constraints, edits };
}

/** Holds positions at places, or normals in directions, three numbers each. */
export function placed(constraints: Constraints, nodes: readonly number[], vectors: Float64Array, part: Part = 'position'): Constraints {
  const given = new Map(nodes.map((node, k) => [node, [...vectors.subarray(3 * k, 3 * k + 3)] as Vector]));
  return edited(constraints, nodes, (node) => ({ [part]: given.get(node) }));
}

export function boundaryFixed({ rules }: Constraints, part: Part): boolean {
  return rules.some((rule) => rule.nodes === 'boundary' && rule[part] === 'fixed');
}

export function withBoundary(constraints: Constraints, part: Part, fixed: boolean): Constraints {
  const rest = constraints.rules
    .map((rule) => {
      if (rule.nodes !== 'boundary' || rule[part] !== 'fixed') return rule;
      const { [part]: _, ...kept } = rule;
      return kept as Rule;
    })
    .filter((rule) => Object.keys(rule).length > 1);
  return { ...constraints, rules: fixed ? [{ nodes: 'boundary', [part]: 'fixed' }, ...rest] : rest };
}

/** In place of a boundary that is fixed, and the other way round. held: nodes to fix for it; those that were before are free again. */
export function withFairBoundary(constraints: Constraints, fairBoundary: boolean, held: readonly number[]): Constraints {
  const edits = { ...constraints.edits };
  for (const node of constraints.loopNodes ?? []) {
    const { position, ...others } = edits[node] ?? {};
    if (position === 'fixed') edits[node] = others;
  }
  for (const node of held) edits[node] = { ...edits[node], position: 'fixed' };
  return { ...withBoundary({ ...constraints, edits }, 'position', !fairBoundary), fairBoundary, loopNodes: held };
}

/** What holds, by other numbers of nodes. now: by the old ones; -1: the node is gone, and what held it. */
export function renumbered(constraints: Constraints, now: Int32Array): Constraints {
  const rules = (all: readonly Rule[]): Rule[] => all.flatMap((rule) => renumberedRule(rule, now) ?? []);
  const edits = Object.entries(constraints.edits).map(([node, edit]) => [now[Number(node)], edit] as const).filter(([node]) => node >= 0);
  // Constraints that leave a file unchanged need no numbers.
  const region = isUntouched(constraints) ? constraints.region : constraints.region && rules(constraints.region);
  return { ...constraints, rules: rules(constraints.rules), region, edits: Object.fromEntries(edits) };
}

function renumberedRule(rule: Rule, now: Int32Array): Rule | null {
  if (!Array.isArray(rule.nodes)) return rule;
  const nodes = rule.nodes as number[];
  const left = nodes.flatMap((node, k) => (now[node] >= 0 ? [k] : []));
  if (left.length === 0) return null;
  const parted = Object.keys(rule).filter((part) => part !== 'nodes' && Array.isArray(rule[part]) && Array.isArray((rule[part] as unknown[])[0]));
  return { ...rule, nodes: left.map((k) => now[nodes[k]]), ...Object.fromEntries(parted.map((part) => [part, left.map((k) => (rule[part] as unknown[])[k])])) };
}

export const heldPosition = 1;
export const heldNormal = 2;
export const heldTangent = 4;
const bits: Record<Part, number> = { position: heldPosition, normal: heldNormal, tangent: heldTangent };

export interface Held {
  /** Sums of heldPosition, heldNormal and heldTangent, by node. */
  nodes: Uint8Array;
  /** Rules whose nodes only the library knows, such as groups and regions: they hold, but are not marked. */
  unmarked: number;
}

export function heldNodes(constraints: Constraints, boundary: Uint8Array): Held {
  const nodes = new Uint8Array(boundary.length);
  let unmarked = 0;
  // Constraints that only keep a file unchanged were not asked for.
  for (const rule of isUntouched(constraints) ? ownRules(constraints) : allRules(constraints)) {
    const among = nodesOf(rule.nodes, boundary);
    if (!among) {
      ++unmarked;
      continue;
    }
    const said = parts.filter((part) => rule[part] !== undefined);
    for (const node of among) {
      for (const part of said) nodes[node] = rule[part] === 'free' ? nodes[node] & ~bits[part] : nodes[node] | bits[part];
    }
  }
  return { nodes, unmarked };
}

function nodesOf(which: unknown, boundary: Uint8Array): Iterable<number> | null {
  if (Array.isArray(which)) return (which as number[]).filter((node) => node >= 0 && node < boundary.length);
  const all = Array.from(boundary.keys());
  if (which === 'all') return all;
  if (which === 'boundary') return all.filter((node) => boundary[node]);
  if (which === 'interior') return all.filter((node) => !boundary[node]);
  return null;
}
