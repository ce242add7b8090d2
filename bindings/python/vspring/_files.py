"""Reading and writing shapes."""
from __future__ import annotations

import os
from pathlib import PurePath
from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import _vspring
from ._errors import Error, warn
from ._shapes import Closed, Faces, columns_of, in_space, numbers_of, shape_of
from ._vspring import Curve, Surface

CURVES = ("csv", "dat", "xyz", "gpx")
"""Formats that have no surfaces."""


def read(path: str | os.PathLike[str], *, format: str | None = None, curve: bool | None = None,
         columns: Sequence[str] = ()) -> Surface | Curve:
    """Reads a surface (OBJ, OFF, PLY, STL) or a curve (OBJ with l elements and no faces, CSV, DAT, XYZ, GPX).

    format: such as "ply", if neither content nor extension show it. curve: whether it is one; by default found from the
    file. columns: of CSV and XYZ, those of x, y and z by their names or numbers from 1.

    fair(), fit(), measure() and Session accept the result in place of vertices and faces, and write() keeps all other
    data of the file. Its arrays are read-only views of the shape's memory: copy them to change them.

    Raises vspring.Error naming path and line (or byte). Cost: linear.
    """
    path = os.fspath(path)
    named = (format or PurePath(path).suffix).lower().lstrip(".")
    shape = _read(path, format, named in CURVES if curve is None else curve, columns)
    if curve is None and isinstance(shape, Surface) and shape.format == "obj" and not len(shape.faces):
        shape = _vspring.read_curve(path, "obj", [])
    warn(("reading", text) for text in shape._warnings)
    return shape


def _read(path: str, format: str | None, curve: bool, columns: Sequence[str]) -> Surface | Curve:
    if curve:
        return _vspring.read_curve(path, format or "", list(map(str, columns)))
    return _vspring.read_surface(path, format or "")


def write(path: str | os.PathLike[str], vertices: ArrayLike | Surface | Curve, faces: Faces | None = None, *,
          source: Surface | Curve | None = None, chains: Sequence[ArrayLike] | None = None,
          closed: Closed = None, format: str | None = None) -> None:
    """Writes a surface or, without faces, a curve; the format is that of the extension. The file appears whole or not at
    all.

    source: the result of read(), in place of faces. In its format everything but the coordinates of nodes that moved is
    written as it was read, byte for byte; normals that the file gave are computed anew where nodes moved. Curves may go
    to .svg, a picture with their curvature comb.
    vertices, faces, chains, closed: as for fair() and fair_curve().

    Warns, with the code "writing", of what the source carried and the output does not. Raises vspring.Error. Cost: linear.
    """
    path, format = os.fspath(path), format or ""
    whole = vertices if isinstance(vertices, (Surface, Curve)) else source
    if whole is None:
        given = shape_of(vertices, faces, chains, closed)
        if given.is_curve:
            _vspring.write_plain_curve(path, given.core, given.array.shape[1] == 2, format)
        else:
            _vspring.write_mesh(path, given.core, format)
        return
    if faces is not None or chains is not None or closed is not None:
        raise Error("invalid-argument", "write: faces, chains and closed are those of the source; leave them out")
    positions = vertices.vertices if isinstance(vertices, (Surface, Curve)) else numbers_of(vertices, "vertices", columns_of(whole.vertices))
    put: Any = _vspring.write_surface if isinstance(whole, Surface) else _vspring.write_curve
    warn(("writing", text) for text in put(path, whole, in_space(np.asarray(positions)), format))
