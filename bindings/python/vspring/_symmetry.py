"""Symmetric shapes."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import _vspring
from ._shapes import Closed, Faces, plane_of, shape_of


@dataclass(frozen=True)
class Symmetry:
    """How a shape is symmetric about a plane."""

    is_half: bool
    """Whether the shape was one half, rather than the whole."""
    vertices: np.ndarray
    """Those of the whole, (w, 3), exactly symmetric: of a half its own, and behind them those of its mirror image."""
    faces: tuple[np.ndarray, np.ndarray] | None
    """Of a surface, those of the whole: corners and offsets, as fair() takes them. Else None."""
    chains: list[np.ndarray] | None
    """Of a curve, the nodes of each chain of the whole. Else None."""
    closed: list[bool] | None
    """Of a curve, whether the last node of each chain joins the first. Else None."""
    partner: np.ndarray
    """(w,) the mirror image of each node of the whole: a node on the plane has itself, one of no face or edge -1."""
    pairs: int
    """Pairs of nodes of the whole."""
    on_plane: int
    """Nodes on the plane."""


def find_symmetry(vertices: ArrayLike | _vspring.Surface | _vspring.Curve, faces: Faces | None = None, *, plane: str,
                  chains: Sequence[ArrayLike] | None = None, closed: Closed = None) -> Symmetry:
    """Finds how a surface or, without faces, a curve is symmetric about a plane, as symmetry of fair(), fair_curve() and
    fit() does.

    vertices, faces, chains, closed: as for fair() and fair_curve(), or the result of read(). plane: "x", "y" or "z" (where
    that is 0), "x=2.5", or "plane:px,py,pz,nx,ny,nz" by a point and a normal; units of the input. A half lies on one side
    and has a boundary (ends) in the plane, to 1e-6 of its diagonal; each node of a whole has a mirror image no further
    from the exact place than half the mean length of its edges.

    Raises vspring.Error naming the node or face of a shape that is neither. Cost: n log n.

    Source: docs/constraints.md, "Symmetry".
    """
    given = shape_of(vertices, faces, chains, closed)
    found = _vspring.find_symmetry(given.core, plane_of(plane, "plane"))
    whole = found.whole
    is_curve = isinstance(whole, _vspring.PlainCurve)
    return Symmetry(found.is_half, found.positions, None if is_curve else (whole.corners, whole.face_begin),
                    whole.chains if is_curve else None, whole.closed if is_curve else None, found.partner, found.pairs,
                    found.on_plane)
