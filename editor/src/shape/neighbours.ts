// Sets of nodes by neighbourhood along edges. Linear in the size of the surface.

import { partsOf } from './joined';
import type { Shape } from './shape';

type Joined = Pick<Shape, 'edges' | 'input'>;
type Nodes = ReadonlySet<number>;

/** For every edge that has one end among the nodes: that end, and the other. */
function forRim({ edges, input }: Joined, nodes: Iterable<number>, call: (inside: number, outside: number) => void): void {
  const among = new Uint8Array(input.length / 3);
  for (const node of nodes) among[node] = 1;
  for (let e = 0; e < edges.count; ++e) {
    const [a, b] = [edges.ends[2 * e], edges.ends[2 * e + 1]];
    if (among[a] !== among[b]) call(among[a] ? a : b, among[a] ? b : a);
  }
}

/** One ring of neighbours more. */
export function grown(shape: Joined, nodes: Nodes): Set<number> {
  const more = new Set(nodes);
  forRim(shape, nodes, (_, outside) => more.add(outside));
  return more;
}

/** Without the nodes that have a neighbour outside. */
export function shrunk(shape: Joined, nodes: Nodes): Set<number> {
  const fewer = new Set(nodes);
  forRim(shape, nodes, (inside) => fewer.delete(inside));
  return fewer;
}

/** Those that have a neighbour outside. */
export function rim(shape: Joined, nodes: readonly number[]): Set<number> {
  const found = new Set<number>();
  forRim(shape, nodes, (inside) => found.add(inside));
  return found;
}

/** All nodes of the connected parts on which some of those nodes lie. */
export function withParts(shape: Joined, nodes: Nodes): Set<number> {
  const root = partsOf(shape.edges, shape.input.length / 3, () => true);
  const wanted = new Set([...nodes].map(root));
  return new Set([...Array(shape.input.length / 3).keys()].filter((node) => wanted.has(root(node))));
}

/** Of those nodes the ones whose part, as far as they are joined, has no neighbour but those around. */
export function enclosed(shape: Joined, nodes: Nodes, around: Pick<Nodes, 'has'>): Set<number> {
  if (nodes.size === 0) return new Set();
  const { edges, input } = shape;
  const root = partsOf(edges, input.length / 3, (e) => nodes.has(edges.ends[2 * e]) && nodes.has(edges.ends[2 * e + 1]));
  const open = new Set<number>();
  forRim(shape, nodes, (inside, outside) => { if (!around.has(outside)) open.add(root(inside)); });
  return new Set([...nodes].filter((node) => !open.has(root(node))));
}

export function all({ input }: Pick<Shape, 'input'>): Set<number> {
  return new Set(Array(input.length / 3).keys());
}

export function inverted(shape: Pick<Shape, 'input'>, nodes: Nodes): Set<number> {
  const rest = all(shape);
  for (const node of nodes) rest.delete(node);
  return rest;
}
