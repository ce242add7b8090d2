"""Refining and remeshing surfaces."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike

from . import _vspring
from ._holding import constraints_of, held_in
from ._options import RefineOptions, RemeshOptions, spelled_out
from ._shapes import Faces, Given, array_of, indices_of, number_of, surface_of


@dataclass(frozen=True)
class Refined:
    """A surface with more nodes where it moves."""

    vertices: np.ndarray
    """Those of the input, bit for bit, and behind them the new ones."""
    faces: np.ndarray | tuple[np.ndarray, np.ndarray]
    """In the order of the input's: (m, 3) where all are triangles, or else corners and m + 1 offsets, as fair() takes
    them."""
    face_from: np.ndarray
    """Per face the number of the input's face that it is, or is a part of."""
    free: np.ndarray
    """The numbers of the nodes that may move, for fair(..., region=free)."""
    boundary_reach: float
    """Two median edges of the boundary before, for fit(); 0 without a boundary."""
    surface: _vspring.Surface | None
    """Of a result of read(): the refined surface with all that its file carried, for fair() and write()."""
    _core: _vspring.Refined

    def parts_of(self, edges: ArrayLike) -> np.ndarray:
        """Edges, such as sharp ones, given those of the input, (k, 2) node numbers: the parts of divided ones in their
        place. Raises vspring.Error naming a node that the input does not have."""
        return self._core.parts_of(indices_of(edges, "edges").reshape(-1, 2))

    def at_nodes(self, values: ArrayLike) -> np.ndarray:
        """Numbers at the nodes, such as colours, given those at the nodes of the input, (n,) or (n, k): new nodes get
        means."""
        given = np.ascontiguousarray(array_of(values, "values"), np.float64)
        return self._core.at_nodes(given).reshape(len(self.vertices), *given.shape[1:])


@spelled_out(RefineOptions)
def refine(vertices: ArrayLike | _vspring.Surface, faces: Faces | None = None, **options: Unpack[RefineOptions]) -> Refined:
    """Divides the part of a surface that moves, for surfaces too coarse to be fair. One of length and turn is needed.

    vertices, faces: as for fair(), or the result of read(). Arguments are unchanged. Triangles and quads stay such.

    Raises vspring.Error for what cannot be refined, and for more than 10,000,000 new nodes. Cost: linear, some 2 µs for
    every new node.

    Source: M.-C. Rivara, "Algorithms for refining triangular grids suitable for adaptive and multigrid techniques", 1984;
    docs/refine.md.
    """
    given = surface_of(vertices, faces)
    length, turn = (None if options.get(name) is None else number_of(options[name], name) for name in ("length", "turn"))
    core = _vspring.refine(given.core, constraints_of(given, options), length, turn)
    return Refined(*_parts_of(given, core), core)


@dataclass(frozen=True)
class Remeshed:
    """A surface with even triangles where it moves."""

    vertices: np.ndarray
    """Those of the input that stay, bit for bit and in their order, and behind them the new ones."""
    faces: np.ndarray | tuple[np.ndarray, np.ndarray]
    """(m, 3) where all are triangles, or else corners and m + 1 offsets, as fair() takes them."""
    face_from: np.ndarray
    """Per face the number of the input's face that it is, or from which it comes; ascending."""
    free: np.ndarray
    """The numbers of the nodes that may move, for fair(..., region=free)."""
    boundary_reach: float
    """Two median edges of the boundary before, for fit(); 0 without a boundary."""
    surface: _vspring.Surface | None
    """Of a result of read(): the remeshed surface with all that its file carried, for fair() and write()."""
    node_from: np.ndarray
    """Per node its number in the input, −1 for new ones."""
    sharp_edges: np.ndarray
    """(k, 2): those of the input, in their new parts."""
    length: float
    """About that of edges: the one given, or the median edge."""
    _core: _vspring.Remeshed

    def at_nodes(self, values: ArrayLike) -> np.ndarray:
        """Numbers at the nodes, such as colours, given those at the nodes of the input, (n,) or (n, k): new nodes get
        means."""
        given = np.ascontiguousarray(array_of(values, "values"), np.float64)
        return self._core.at_nodes(given).reshape(len(self.vertices), *given.shape[1:])


@spelled_out(RemeshOptions)
def remesh(vertices: ArrayLike | _vspring.Surface, faces: Faces | None = None, **options: Unpack[RemeshOptions]) -> Remeshed:
    """Gives the part of a surface that moves even triangles, for surfaces with needles or edges of very different lengths.

    vertices, faces: as for fair(), or the result of read(). Arguments are unchanged.

    Raises vspring.Error for what cannot be remeshed, and for more than 10,000,000 new nodes. Cost: n log n, some 100 µs for
    every new node.

    Source: M. Botsch and L. Kobbelt, "A remeshing approach to multiresolution modeling", 2004; docs/refine.md.
    """
    given = surface_of(vertices, faces)
    length = None if options.get("length") is None else number_of(options["length"], "length")
    held = held_in(given, options)
    core = _vspring.remesh(given.core, held.constraints, length, held.sharp_edges)
    return Remeshed(*_parts_of(given, core), core.node_from, core.lines, core.length, core)


def _parts_of(given: Given, core: _vspring.Refined) -> tuple:
    """What both kinds of results begin with."""
    corners, offsets = core.corners, core.face_begin
    is_triangles = len(corners) == 3 * (len(offsets) - 1) and bool(np.all(np.diff(offsets) == 3))
    surface = None if given.file is None else _vspring.refined_file(given.file, core)
    return (given.like_given(core.positions), corners.reshape(-1, 3) if is_triangles else (corners, offsets),
            core.face_from, core.free, core.boundary_reach, surface)
