// Sets of nodes by what the edges join. Linear in the size of the surface.

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
export function withParts({ edges, input }: Joined, nodes: Nodes): Set<number> {
  const parent = Int32Array.from({ length: input.length / 3 }, (_, node) => node);
  const root = (node: number): number => {
    while (parent[node] !== node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (let k = 0; k < 2 * edges.count; k += 2) parent[root(edges.ends[k])] = root(edges.ends[k + 1]);
  const wanted = new Set([...nodes].map(root));
  return new Set([...parent.keys()].filter((node) => wanted.has(root(node))));
}

export function all({ input }: Pick<Shape, 'input'>): Set<number> {
  return new Set(Array(input.length / 3).keys());
}

export function inverted(shape: Pick<Shape, 'input'>, nodes: Nodes): Set<number> {
  const rest = all(shape);
  for (const node of nodes) rest.delete(node);
  return rest;
}
