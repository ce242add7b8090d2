// The nodes of a part connected by edges.

export interface JoinedEdges {
  count: number;
  ends: Uint32Array;
}

/** joins: which edges count, by number. Returns for each node one that stands for all of its part. */
export function partsOf({ count, ends }: JoinedEdges, nodes: number, joins: (edge: number) => boolean): (node: number) => number {
  const parent = Int32Array.from({ length: nodes }, (_, node) => node);
  const root = (node: number): number => {
    while (parent[node] !== node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (let e = 0; e < count; ++e) if (joins(e)) parent[root(ends[2 * e])] = root(ends[2 * e + 1]);
  return root;
}
