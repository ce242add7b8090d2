"""Points that shapes are fitted to, and how they pull."""
from __future__ import annotations

import os
from typing import Any, Mapping, NamedTuple, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import _vspring
from ._errors import Error, warn
from ._holding import region_of
from ._options import Pulling
from ._shapes import Given, array_of, in_space, numbers_of

CRITERIA = [name for name in Pulling.__annotations__ if name != "outliers"]


class Points(NamedTuple):
    """Scattered points, from read_points() and for fit()."""

    positions: np.ndarray
    """(n, 3)."""
    weights: np.ndarray | None = None
    """(n,), 0 or more; None: 1 each."""
    normals: np.ndarray | None = None
    """(n, 3), unit length, zero where not known; None: nowhere known."""


def read_points(path: str | os.PathLike[str], *, columns: Sequence[str] = ()) -> Points:
    """Reads scattered points, with weights and normals if the file has them: the nodes of OBJ, OFF, PLY, STL, CSV, XYZ,
    DAT.

    columns: of CSV and XYZ, those of x, y and z by their names or numbers from 1; found where not given.

    Raises vspring.Error naming path and line. Cost: linear.
    """
    positions, weights, normals, warnings = _vspring.read_points(os.fspath(path), list(map(str, columns)))
    warn(("reading", text) for text in warnings)
    return Points(positions, weights, normals)


def is_drawn(options: Mapping[str, Any]) -> bool:
    """Whether the shape is fitted to points, perhaps its own nodes."""
    drawn = any(options.get(name) is not None for name in CRITERIA)
    for name in ("outliers", "min_radius", "move"):
        if options.get(name) and not drawn:
            raise Error("invalid-argument", f"{name} needs one of {', '.join(CRITERIA)}")
    return drawn


def arrays_of(points: ArrayLike | Points | None, weights: ArrayLike | None, normals: ArrayLike | None,
              columns: Sequence[int]) -> tuple[Any, Any, Any]:
    """Positions, weights and normals for the library; None for those not given. Those of Points are replaced by others.
    columns: that positions may have."""
    if isinstance(points, Points):
        points, weights, normals = (points.positions, points.weights if weights is None else weights,
                                    points.normals if normals is None else normals)
    if isinstance(points, (str, os.PathLike)):
        raise TypeError(f"points: {os.fspath(points)!r} is a path; give read_points({os.fspath(points)!r})")
    if isinstance(points, (_vspring.Surface, _vspring.Curve)):
        raise TypeError("points: a shape of read(); give its vertices, or the result of read_points()")
    if weights is not None:
        weights = array_of(weights, "weights")
        if weights.dtype.kind not in "fiu" or weights.ndim != 1:
            raise Error("invalid-argument", f"weights: one number a point is needed, not {weights.dtype} of {weights.shape}")
        weights = np.ascontiguousarray(weights, np.float64)
    return (None if points is None else in_space(numbers_of(points, "points", columns)), weights,
            None if normals is None else in_space(numbers_of(normals, "normals", (3,))))


def refuse_auto(options: Mapping[str, Any]) -> None:
    """Points that are given tell nothing of the noise of the shape's own nodes."""
    for name in CRITERIA:
        if isinstance(options.get(name), str):
            raise Error("invalid-argument", f"{name}: a number is needed where points are given, not {options[name]!r}; "
                        "\"auto\" is for the shape's own nodes")


def without_auto(options: Mapping[str, Any], given: Given) -> dict[str, Any]:
    """Replaces "auto" as on the command line: by the estimated noise of the nodes, of those of the region if there is one."""
    settled = dict(options)
    asked = [name for name in CRITERIA if isinstance(settled.get(name), str)]
    if not asked:
        return settled
    name = asked[0]
    if name not in ("within", "rms", "noise") or settled[name] != "auto":
        raise Error("invalid-argument", f"{name}: a number is needed, or \"auto\" of within, rms and noise")
    deviation, furthest, voxels = _vspring.estimate_noise(given.core, region_of(given, options), settled, given.file)
    if not deviation > 0:
        if not given.is_curve and given.welded is None and len(given.core.corners) <= given.core.node_count:
            raise Error("unusable-shape", f"{name}: no two faces share a node, so they show no noise; weld=0 joins nodes at the same place")
        raise Error("unusable-shape", f"{name}: the numbers of this shape show no noise, or it has too few nodes; "
                    "give a number, or smooth by a length (smoothing_length)")
    del settled[name]
    if voxels is not None:
        return {**settled, "voxels": voxels}
    if name == "within":
        return {**settled, "within": furthest}
    return {**settled, "noise" if name == "noise" or given.is_curve else "rms": deviation}
