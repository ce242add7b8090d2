// Nodes of a curve that are inserted or deleted. All others keep their order, so numbers only move up or down.

import { minus } from '../../../page/vectors.js';
import type { CurveNodes } from '../library/protocol';
import type { Shape } from '../shape/shape';

/** Between a node of a chain, by its place there, and the next one: at that share of the way. */
export interface Gap {
  chain: number;
  at: number;
  share: number;
}

export interface Renumbered {
  curve: CurveNodes;
  /** By the number before; -1 where the node is gone. */
  now: Int32Array;
  /** Numbers of new nodes, and of the two between which each was put. */
  added: { node: number; between: [number, number] }[];
  /** Three numbers a node before, such as another shape of the curve has, as three numbers a node now. */
  carried: (positions: Float64Array) => Float64Array;
}

type Chain = { nodes: number[]; closed: boolean };

/** The nodes that are open, where some may have been inserted or deleted since they were read. */
export function nodesOf({ curve, input }: Shape, changed: CurveNodes | undefined): CurveNodes {
  const { runs, closed } = curve!;
  return changed ?? { positions: input, chainBegin: runs.begin, chainNodes: runs.nodes, closed: Uint8Array.from(closed, Number), from: Int32Array.from({ length: input.length / 3 }, (_, node) => node) };
}

function chainsOf({ chainBegin, chainNodes, closed }: CurveNodes): Chain[] {
  return [...closed].map((loop, c) => ({ nodes: [...chainNodes.subarray(chainBegin[c], chainBegin[c + 1])], closed: loop !== 0 }));
}

function joined(chains: Chain[], positions: Float64Array, from: Int32Array): CurveNodes {
  const begin = [0];
  for (const { nodes } of chains) begin.push(begin.at(-1)! + nodes.length);
  return { positions, from, chainBegin: Int32Array.from(begin), chainNodes: Int32Array.from(chains.flatMap(({ nodes }) => nodes)), closed: Uint8Array.from(chains, (chain) => Number(chain.closed)) };
}

/** The gaps in which every edge between two of those nodes has its middle; of a single node the edge behind it, or else before it. */
export function gapsBetween(curve: CurveNodes, among: ReadonlySet<number>): Gap[] {
  const gaps: Gap[] = [];
  const beside: Gap[] = [];
  chainsOf(curve).forEach(({ nodes, closed }, chain) => {
    for (let at = 0; at + (closed ? 0 : 1) < nodes.length; ++at) {
      const ends = [nodes[at], nodes[(at + 1) % nodes.length]].map((node) => among.has(node));
      const gap = { chain, at, share: 0.5 };
      if (ends[0] && ends[1]) gaps.push(gap);
      else if (ends[0]) beside.unshift(gap);
      else if (ends[1]) beside.push(gap);
    }
  });
  return gaps.length > 0 || among.size !== 1 ? gaps : beside.slice(0, 1);
}

/** A new node in each gap, numbered behind the one before it. */
export function inserted(curve: CurveNodes, gaps: readonly Gap[]): Renumbered {
  const chains = chainsOf(curve);
  const count = curve.from.length;
  const news = gaps
    .map((gap) => ({ ...gap, before: chains[gap.chain].nodes[gap.at], after: chains[gap.chain].nodes[(gap.at + 1) % chains[gap.chain].nodes.length] }))
    .sort((a, b) => a.before - b.before || a.chain - b.chain || a.share - b.share);
  const now = new Int32Array(count);
  let passed = 0;
  for (let node = 0; node < count; ++node) {
    now[node] = node + passed;
    while (passed < news.length && news[passed].before === node) ++passed;
  }
  const added = news.map(({ before, after }, k) => ({ node: before + 1 + k, between: [now[before], now[after]] as [number, number] }));
  const longer = chains.map(({ nodes, closed }) => ({ closed, nodes: nodes.map((node) => [now[node]]) }));
  news.forEach(({ chain, at }, k) => longer[chain].nodes[at].push(added[k].node));
  const from = new Int32Array(count + news.length).fill(-1);
  now.forEach((node, before) => { from[node] = curve.from[before]; });
  const carried = (positions: Float64Array): Float64Array => {
    const places = new Float64Array(3 * from.length);
    now.forEach((node, before) => places.set(positions.subarray(3 * before, 3 * before + 3), 3 * node));
    news.forEach(({ chain, at, share }, k) => places.set(placeIn(chains[chain], positions, at, share), 3 * added[k].node));
    return places;
  };
  return { curve: joined(longer.map(({ nodes, closed }) => ({ closed, nodes: nodes.flat() })), carried(curve.positions), from), now, added, carried };
}

/** On the cubic that joins the nodes around smoothly, so that a fair curve stays fair. */
function placeIn({ nodes, closed }: Chain, positions: Float64Array, at: number, share: number): number[] {
  const count = nodes.length;
  const place = (k: number): number[] | null => {
    const node = nodes[closed ? (k + count) % count : k];
    return node === undefined ? null : [...positions.subarray(3 * node, 3 * node + 3)];
  };
  const [a, b] = [place(at)!, place(at + 1)!];
  const [previous, next] = [place(at - 1), place(at + 2)];
  const length = Math.hypot(...minus(b, a));
  if (!(length > 0)) return a;
  const chord = scaled(minus(b, a), 1 / length);
  const [before, after] = [previous && slope(previous, a, b), next && slope(a, b, next)];
  // At an open end, the tangent of the parabola through the last three nodes.
  const leave = before ?? (after ? minus(scaled(chord, 2), after) : chord);
  const arrive = after ?? minus(scaled(chord, 2), leave);
  const rest = 1 - share;
  return a.map((part, i) => part * rest * rest * (1 + 2 * share) + b[i] * share * share * (1 + 2 * rest) + length * share * rest * (leave[i] * rest - arrive[i] * share));
}

/** By arc length, of the parabola through three places in the middle one. */
function slope(before: number[], here: number[], after: number[]): number[] | null {
  const [back, on] = [minus(here, before), minus(after, here)];
  const [long, longer] = [Math.hypot(...back), Math.hypot(...on)];
  return long > 0 && longer > 0 ? back.map((part, i) => ((part / long) * longer + (on[i] / longer) * long) / (long + longer)) : null;
}

function scaled(vector: number[], factor: number): number[] {
  return vector.map((part) => factor * part);
}

/** Without those nodes. Throws where too little would be left of a chain of which something is. */
export function without(curve: CurveNodes, gone: ReadonlySet<number>): Renumbered {
  const chains = chainsOf(curve).map(({ nodes, closed }) => ({ closed, nodes: nodes.filter((node) => !gone.has(node)) })).filter(({ nodes }) => nodes.length > 0);
  if (chains.length === 0 || chains.some(({ nodes, closed }) => nodes.length < (closed ? 3 : 2))) throw new Error('An open curve keeps at least two nodes, and a closed one three');
  const now = new Int32Array(curve.from.length).fill(-1);
  let left = 0;
  for (let node = 0; node < now.length; ++node) if (!gone.has(node)) now[node] = left++;
  const from = new Int32Array(left);
  now.forEach((node, before) => { if (node >= 0) from[node] = curve.from[before]; });
  const carried = (positions: Float64Array): Float64Array => positions.filter((_, k) => now[Math.floor(k / 3)] >= 0);
  return { curve: joined(chains.map(({ nodes, closed }) => ({ closed, nodes: nodes.map((node) => now[node]) })), carried(curve.positions), from), now, added: [], carried };
}
