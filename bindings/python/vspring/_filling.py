"""Filling holes."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, Unpack

import numpy as np
from numpy.typing import ArrayLike

from . import _vspring
from ._errors import Error
from ._fairing import ended
from ._options import FillOptions, spelled_out
from ._progress import teller
from ._reports import Report, report_of
from ._shapes import Faces, nodes_of, surface_of


@dataclass(frozen=True)
class Hole:
    """A closed loop of boundary edges, and what became of it."""

    rim: np.ndarray
    """Its nodes, the least first, in the order in which faces that fill it run along it."""
    length: float
    """Of the rim, in units of the input."""
    state: str
    """"filled", "outer-rim", "too-large", "elsewhere", "unfillable" or "cancelled"."""
    fault: str
    """Of one that cannot be filled: why, where, and what to do; else empty."""
    first_node: int
    """Of a filled one: its new nodes and faces, which follow each other from these on; else -1."""
    node_count: int
    first_face: int
    face_count: int
    outcome: str | None
    """How its fairing ended, as in Report; None where it has no new node, and with flat."""


class Filled(NamedTuple):
    """A surface with its holes filled: `vertices, faces, report, holes = vspring.fill(...)`."""

    vertices: np.ndarray
    """Those of the input, bit for bit, and behind them the new ones."""
    faces: np.ndarray | tuple[np.ndarray, np.ndarray]
    """Those of the input, and behind them the new ones: (m, 3) where all are triangles, or else corners and m + 1
    offsets, as fair() takes them."""
    report: Report
    """Of the fairing of all patches: the worst outcome, sums of work."""
    holes: list[Hole]


@spelled_out(FillOptions)
def fill(vertices: ArrayLike | _vspring.Surface, faces: Faces | None = None, **options: Unpack[FillOptions]) -> Filled:
    """Fills the holes of a surface with fair patches that meet the faces around smoothly.

    vertices, faces: as for fair(), or the result of read(). Arguments are unchanged. A surface without holes is
    returned unchanged.

    Raises what fair() raises. If Ctrl-C or the time limit end it, holes stay open or patches are not faired. Cost:
    linear in the nodes, cubic in the edges of a rim, a second for 500; then that of fair() for each patch.

    Source: G. Barequet, M. Sharir, "Filling gaps in the boundary of a polyhedron", 1995; P. Liepa, "Filling holes in
    meshes", 2003; docs/fill.md.
    """
    given = surface_of(vertices, faces)
    settled: dict[str, Any] = dict(options)
    if options.get("at") is not None:
        nodes = nodes_of(options["at"], given.core.node_count, "at")
        if len(nodes) == 0:
            raise Error("invalid-argument", "at: no node is named; leave it out to fill all holes")
        settled["at"] = nodes.tolist()
    tell = teller(options)
    positions, corners, offsets, holes, fields, stopped_by = _vspring.fill(given.core, settled, tell)
    result = ended(given, positions, report_of(fields), tell, stopped_by)
    is_triangles = len(corners) == 3 * (len(offsets) - 1) and bool(np.all(np.diff(offsets) == 3))
    made = corners.reshape(-1, 3) if is_triangles else (corners, offsets)
    return Filled(result.positions, made, result.report, [Hole(**hole) for hole in holes])
