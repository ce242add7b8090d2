"""Sharp edges of surfaces."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from . import _vspring
from ._errors import Error
from ._shapes import Faces, number_of, surface_of, threads_of


@dataclass(frozen=True)
class SharpEdges:
    """Edges at which each side of a surface has its own tangent plane."""

    edges: np.ndarray
    """(k, 2) node numbers, ascending, the smaller one first."""
    chains: list[np.ndarray]
    """The nodes of each chain, in order: between corners, ends and places where a crease runs out, or closed."""
    closed: list[bool]
    """Whether the last node of each chain joins the first."""
    lengths: np.ndarray
    """Of each chain, in units of the input."""
    corners: np.ndarray
    """The nodes at which three sharp edges or more meet."""


def find_sharp_edges(vertices: ArrayLike | _vspring.Surface, faces: Faces | None = None, *, angle: float,
                     noise: float | Literal["auto"] = 0, weld: float | None = None, threads: int | None = None) -> SharpEdges:
    """Finds the sharp edges of a surface, for sharp_edges of fair() and fit(): edges of two faces whose normals differ by
    more than an angle.

    vertices, faces: as for fair(), or the result of read(). angle: degrees, more than 0 and less than 180. noise: the
    standard deviation of the nodes in each coordinate, units of the input, or "auto" for the estimated one; edges are
    then those of the surface without it, and short chains of noise are left out. weld: as for fair(); nodes are those
    that represent the joined ones. threads: all cores by default.

    Raises vspring.Error. Cost: n log n; with noise that of fair(noise=...).

    Source: docs/sharp-edges.md.
    """
    given = surface_of(vertices, faces).welded_by(weld)
    count = threads_of(threads)
    if isinstance(noise, str):
        if noise != "auto":
            raise Error("invalid-argument", f"noise: a number or \"auto\" is needed, not {noise!r}")
        deviation, _, voxels = _vspring.estimate_noise(given.core, np.zeros(0, np.int32), {"threads": count}, given.file)
        noise = 0 if voxels is not None else deviation
    return SharpEdges(*_vspring.find_sharp_edges(given.core, number_of(angle, "angle"), number_of(noise, "noise"), count))
