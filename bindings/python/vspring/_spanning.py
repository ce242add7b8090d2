"""Surfaces from curves."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, NamedTuple, Sequence, Unpack

import numpy as np
from numpy.typing import ArrayLike

from . import _vspring
from ._errors import Error
from ._fairing import ended
from ._options import SpanOptions, spelled_out
from ._progress import teller
from ._reports import Report, report_of
from ._shapes import curve_of, indices_of, nodes_of, numbers_of


@dataclass(frozen=True)
class NetworkCurve:
    """A curve of a network, from one junction or corner to the next."""

    origin: np.ndarray
    """Nodes of the input along it; -1 where curves cross between nodes."""
    nodes: np.ndarray
    """Vertices of the surface along it, the first again at the end if it is closed; empty if no surface meets it."""
    length: float
    """In units of the input."""
    sharp: bool
    loops: int
    """How many spanned loops run along it."""


@dataclass(frozen=True)
class NetworkLoop:
    """A closed loop of curves, and what became of it."""

    curves: np.ndarray
    """Their numbers, in order."""
    junctions: np.ndarray
    """The node of the input where each begins; -1 where curves cross between nodes."""
    length: float
    """In units of the input."""
    turn: float
    """By how many degrees it turns from the loops beside it, before fairing."""
    state: str
    """"spanned", "outer", "lid", "left-out", "unspannable" or "cancelled"."""
    grid: bool
    """Whether its faces are quads in a grid."""
    first_node: int
    """Of a spanned one: the vertices within it and its faces, which follow each other from these on; else -1."""
    node_count: int
    first_face: int
    face_count: int


class Spanned(NamedTuple):
    """A surface through curves: `vertices, faces, report, curves, loops, sharp_edges = vspring.span(...)`."""

    vertices: np.ndarray
    """(n, 3); those of curves first."""
    faces: np.ndarray | tuple[np.ndarray, np.ndarray]
    """(m, 4) or (m, 3) if all are quads or triangles, or else corners and m + 1 offsets, as fair() takes them."""
    report: Report
    curves: list[NetworkCurve]
    loops: list[NetworkLoop]
    sharp_edges: np.ndarray
    """(k, 2): along sharp curves between two faces, as fair() takes them."""


@spelled_out(SpanOptions)
def span(curves: Sequence[ArrayLike] | _vspring.Curve, **options: Unpack[SpanOptions]) -> Spanned:
    """Spans a network of curves with a fair surface: a hull from its lines, a body from its profiles and sections.

    curves: a sequence of arrays (n, 3), one for each curve, in any unit; a closed one has its first row again at the
    end. Or the result of read(). They meet where they come near each other.

    The surface passes through all curves and is smooth across them, but along sharp ones. Outer rims of sheets and lids,
    such as the ends of tubes, stay open.

    Raises what fair() raises, and vspring.Error where no curves make a loop. Cost: that of fair() for the vertices, and
    a second for a loop of 500 edges that gets triangles.

    Source: docs/span.md.
    """
    if isinstance(curves, _vspring.Curve):
        given = curve_of(curves, None, None)
    else:
        rows = [numbers_of(curve, f"curve {k}", (3,)) for k, curve in enumerate(curves)]
        begin = np.cumsum([0, *(len(one) for one in rows)])
        chains = [np.arange(a, b, dtype=np.int32) for a, b in zip(begin[:-1], begin[1:])]
        given = curve_of(np.concatenate(rows) if rows else np.zeros((0, 3)), chains, None)
    tell = teller(options)
    positions, corners, offsets, found, loops, sharp, fields, stopped_by = _vspring.span(given.core, _settled(given.core, options), tell)
    result = ended(given, positions, report_of(fields), tell, stopped_by)
    sizes = np.diff(offsets)
    is_even = len(sizes) > 0 and bool(np.all(sizes == sizes[0]))
    made = corners.reshape(-1, int(sizes[0])) if is_even else (corners, offsets)
    return Spanned(result.positions, made, result.report, [NetworkCurve(**curve) for curve in found],
                   [NetworkLoop(**loop) for loop in loops], sharp.reshape(-1, 2))


def _settled(curves: _vspring.PlainCurve, options: Mapping[str, Any]) -> dict[str, Any]:
    """The options for the library, with numbers of curves and loops in lists. Loops are counted only by the call itself,
    so that they have no masks."""
    settled = dict(options)
    if (sharp := options.get("sharp")) is not None:
        settled["sharp"] = nodes_of(sharp, len(curves.chains), "sharp", "curves").tolist()
    for name in ("loops", "also", "without"):
        if options.get(name) is not None:
            settled[name] = indices_of(options[name], name).ravel().tolist()
    if settled.get("loops") == []:
        raise Error("invalid-argument", "loops: no loop is named; leave it out to span all but outer rims and lids")
    return settled
