"""Chains of nodes from edges."""
from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _vspring
from ._errors import Error
from ._shapes import array_of, in_space, indices_of, numbers_of


class Chains(NamedTuple):
    """The arguments of fair_curve() besides the vertices."""

    chains: list[np.ndarray]
    """Node numbers of each chain, in order."""
    closed: list[bool]
    """Whether the last node of each chain joins the first."""


def order(points: ArrayLike, *, closed: bool = False) -> np.ndarray:
    """Finds the order of points along their curve: vspring.fair_curve(points[vspring.order(points)]).

    points: (n, 2) or (n, 3). closed: whether the last one joins the first.

    Returns their numbers, (n,). The order is right if neighbours along the curve are nearer to each other than to other
    parts of it. Raises vspring.Error naming a point that is not finite. Cost: n log n, 0.1 s for 20,000 points.

    Source: I. K. Lee, Computer Aided Geometric Design 17 (2000), for the spanning tree; docs/curves.md.
    """
    return _vspring.order_along_curve(in_space(numbers_of(points, "points", (2, 3))), closed)


def chains_of(edges: ArrayLike) -> Chains:
    """Joins edges in any order to chains: vspring.fair_curve(vertices, **vspring.chains_of(edges)._asdict()).

    edges: (m, 2) node numbers; a repeated edge counts once. Chains end where the number of edges is not two.

    Returns open chains first, each from the end with the lesser number. Raises vspring.Error. Cost: m log m.
    """
    table = indices_of(array_of(edges, "edges"), "edges")
    if table.ndim != 2 or table.shape[1] != 2:
        raise Error("invalid-argument", f"edges: whole numbers of the shape (m, 2) are needed, not of {table.shape}")
    if table.size and table.min() < 0:
        raise Error("invalid-argument", f"edges: nodes count from 0, so there is none of the number {table.min()}")
    around: dict[int, list[int]] = {}
    for one, other in np.unique(np.sort(table, axis=1), axis=0).tolist():
        if one == other:
            raise Error("unusable-shape", f"edges: an edge joins node {one} to itself; leave it out")
        around.setdefault(one, []).append(other)
        around.setdefault(other, []).append(one)
    walked: set[tuple[int, int]] = set()

    def walk(node: int, to: int) -> list[int]:
        chain = [node]
        while (node, to) not in walked:
            walked.update([(node, to), (to, node)])
            chain.append(to)
            if len(around[to]) != 2:
                break
            node, to = to, next(other for other in around[to] if other != node)
        return chain

    found = Chains([], [])
    for is_end in (True, False):
        for node in sorted(around):
            for to in around[node] if (len(around[node]) != 2) == is_end else ():
                if (node, to) in walked:
                    continue
                chain = walk(node, to)
                closed = chain[0] == chain[-1]
                found.chains.append(np.array(chain[:-1] if closed else chain, np.int32))
                found.closed.append(closed)
    return found
