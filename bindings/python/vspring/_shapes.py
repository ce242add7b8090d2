"""Turns arrays of a caller into shapes of the library, and positions back into arrays like those."""
from __future__ import annotations

import os
from dataclasses import dataclass, replace
from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import _vspring
from ._errors import Error

Faces = ArrayLike | Sequence[Sequence[int]] | tuple[np.ndarray, np.ndarray] | list[np.ndarray]
"""(m, 3) or (m, 4) node numbers, a list of lists, a list of such arrays one after the other, or a tuple of two arrays: all
corners, and m + 1 offsets into them."""

Closed = bool | Sequence[bool] | None
"""Whether the last node of each chain joins the first: of all or each; None: as in the file, without one not."""


def _refuse(message: str) -> Error:
    return Error("invalid-argument", message)


@dataclass(frozen=True)
class Given:
    """A shape of the library, the array that it was made of, and other data of its file."""

    core: Any
    """A Mesh or a PlainCurve."""
    array: np.ndarray
    file: _vspring.Surface | _vspring.Curve | None = None
    welded: _vspring.Welded | None = None
    """Of a surface whose core is welded; numbers stay."""
    ends: _vspring.JoinedEnds | None = None
    """Of a curve that closed joins: nodes at the ends of chains that follow the first ones."""
    symmetric: Any = None
    """A SymmetricMesh or SymmetricCurve of the core; its whole has the core's nodes first."""

    @property
    def whole(self) -> Any:
        """What constraints are for: the core, or the whole of a symmetric shape."""
        return self.core if self.symmetric is None else self.symmetric.whole

    @property
    def solved(self) -> Any:
        """What the library is given to be faired."""
        return self.core if self.symmetric is None else self.symmetric

    @property
    def is_curve(self) -> bool:
        return isinstance(self.core, _vspring.PlainCurve)

    @property
    def columns(self) -> tuple[int, ...]:
        return columns_of(self.array)

    def like_given(self, positions: np.ndarray) -> np.ndarray:
        """Positions with the columns and the precision of the input."""
        dtype = np.float32 if self.array.dtype == np.float32 else np.float64
        if self.welded is not None:
            positions = self.welded.positions(positions)
        if self.ends is not None:
            positions = self.ends.follow(positions)
        if self.array.shape[1] == 2 and positions[:, 2].any():
            raise _refuse(f"node {np.flatnonzero(positions[:, 2])[0]} left the plane z = 0, and the vertices have only x and y; give them a third column, "
                          "or points and constraints in that plane")
        return np.ascontiguousarray(positions[:, :self.array.shape[1]], dtype)

    def nodes_of(self, selection: ArrayLike, name: str) -> np.ndarray:
        """The numbers of nodes that a mask or their numbers select; for welded and joined ones those that represent them."""
        nodes = nodes_of(selection, self.core.node_count, name)
        if self.ends is not None:
            for follower, first in self.ends.followers:
                nodes = np.where(nodes == follower, first, nodes)
        if self.welded is None:
            return nodes
        if len(nodes) and not 0 <= nodes.min() <= nodes.max() < self.core.node_count:
            raise _refuse(f"{name}: nodes have the numbers 0 to {self.core.node_count - 1}")
        return np.unique(self.welded.representative[nodes])

    def with_images(self, nodes: np.ndarray) -> np.ndarray:
        """The nodes and, of a symmetric shape, their mirror images."""
        if self.symmetric is None or not len(nodes):
            return nodes
        if not 0 <= nodes.min() <= nodes.max() < self.core.node_count:
            raise _refuse(f"nodes have the numbers 0 to {self.core.node_count - 1}")
        images = self.symmetric.partner[nodes]
        return np.unique(np.concatenate([nodes, images[images >= 0]])).astype(np.int32)

    def mirrored_about(self, plane: str | None) -> Given:
        """The shape as one that is symmetric about a plane."""
        return self if plane is None else replace(self, symmetric=_vspring.find_symmetry(self.core, plane_of(plane, "symmetry")))

    def welded_by(self, tolerance: float | None) -> Given:
        """The shape with nodes welded that are at most this share of the diagonal apart."""
        if tolerance is None:
            return self
        if self.is_curve:
            raise _refuse("weld: that is for surfaces; of curves, closed joins the ends")
        welded = _vspring.weld(self.core, number_of(tolerance, "weld"))
        return Given(welded.mesh, self.array, self.file, welded)


def array_of(values: Any, name: str) -> np.ndarray:
    if hasattr(values, "positions") and hasattr(values, "report"):
        raise TypeError(f"{name}: that is a result; give its positions")
    try:
        return np.asarray(values)
    except (TypeError, ValueError) as error:
        raise _refuse(f"{name}: not an array: {error}") from None


def number_of(value: Any, name: str) -> float:
    """A real number. A truth value is none: it would be 0 or 1."""
    return float(_single(value, name, "fiu", "a number"))


def whole_number_of(value: Any, name: str) -> int:
    """A whole number, such as that of a node."""
    number = int(_single(value, name, "iu", "a whole number"))
    if abs(number) >= 2**31:
        raise _refuse(f"{name}: {number} is out of range")
    return number


def threads_of(threads: int | None) -> int:
    """The number of threads for the library; 0: all cores."""
    return 0 if threads is None else whole_number_of(threads, "threads")


def _single(value: Any, name: str, kinds: str, what: str) -> np.ndarray:
    array = array_of(value, name)
    if array.ndim or array.dtype.kind not in kinds:
        raise TypeError(f"{name}: {what} is needed, not {value!r}")
    return array


def plane_of(plane: Any, name: str) -> str:
    if not isinstance(plane, str):
        raise TypeError(f'{name}: "x", "x=2.5" or "plane:px,py,pz,nx,ny,nz" is needed, not {plane!r}')
    return plane


def numbers_of(values: ArrayLike, name: str, columns: Sequence[int]) -> np.ndarray:
    """Real numbers in rows of a given length."""
    array = array_of(values, name)
    if array.dtype.kind not in "fiu" or array.ndim != 2 or array.shape[1] not in columns:
        shapes = " or ".join(f"(n, {count})" for count in columns)
        raise _refuse(f"{name}: real numbers of the shape {shapes} are needed, not {array.dtype} of {array.shape}")
    return array


def columns_of(array: np.ndarray) -> tuple[int, ...]:
    """How many columns positions may have beside those of a shape: with fewer than these they would lose their z."""
    return tuple(range(array.shape[1], 4))


def coordinates_of(values: ArrayLike, name: str) -> np.ndarray:
    """Three doubles a row; not copied if they are so already."""
    array = numbers_of(values, name, (3,))
    return np.ascontiguousarray(array, np.float64)


def in_space(array: np.ndarray) -> np.ndarray:
    """Three doubles a row; z = 0 if there are two."""
    positions = np.zeros((len(array), 3))
    positions[:, :array.shape[1]] = array
    return positions


def indices_of(values: ArrayLike, name: str) -> np.ndarray:
    """Numbers of nodes, or of other things, for the library."""
    array = array_of(values, name)
    if array.size and array.dtype.kind not in "iu":
        raise _refuse(f"{name}: whole numbers are needed, not {array.dtype}")
    narrow = np.asarray(array, np.int32, order="C")
    if array.dtype.itemsize >= 4 and array.dtype != np.int32 and not np.array_equal(narrow, array):
        raise _refuse(f"{name}: a number is out of the range of node numbers")
    return narrow


def nodes_of(selection: ArrayLike, count: int, name: str, kind: str = "nodes") -> np.ndarray:
    """The numbers of nodes, or of other things, that a mask or their numbers select; a single number is one of them."""
    array = array_of(selection, name)
    if array.dtype == bool:
        if array.shape != (count,):
            raise _refuse(f"{name}: a mask of {count} {kind} is needed, not of {array.shape}")
        return np.flatnonzero(array).astype(np.int32)
    numbers = indices_of(array, name).ravel()
    if len(numbers) == count > 2 and numbers.min() >= 0 and numbers.max() <= 1:
        raise _refuse(f"{name}: 0 and 1 alone are the numbers of two {kind}; a mask has the type bool, as {name}.astype(bool) does")
    return numbers


def _refuse_other_kinds(vertices: Any, faces: Any = None) -> None:
    """What is no array, but may be meant as one."""
    if isinstance(vertices, (str, os.PathLike)):
        raise TypeError(f"vertices: {os.fspath(vertices)!r} is a path; give read({os.fspath(vertices)!r})")
    if isinstance(faces, (_vspring.Surface, _vspring.Curve)):
        raise TypeError("faces: a shape of read(); give its faces, or the shape alone as vertices; write() takes it as source=")


def surface_of(vertices: ArrayLike | _vspring.Surface, faces: Faces | None) -> Given:
    _refuse_other_kinds(vertices, faces)
    if isinstance(vertices, _vspring.Curve):
        raise TypeError("a curve has no faces; fair_curve(), fit(), measure() and Session() take curves")
    if isinstance(vertices, _vspring.Surface):
        if faces is not None:
            raise _refuse("faces: those of a surface from read() are its own; leave them out (points of fit() go by points=), or give its "
                          "vertices alone with others")
        return _from_file(vertices)
    if faces is None:
        raise TypeError("faces are missing; curves have fair_curve()")
    array = numbers_of(vertices, "vertices", (3,))
    positions = coordinates_of(array, "vertices")
    if isinstance(faces, tuple) and len(faces) == 2 and all(isinstance(one, np.ndarray) for one in faces):
        corners, offsets = (indices_of(one, "faces") for one in faces)
        return Given(_vspring.Mesh(positions, corners, offsets), array)
    if isinstance(faces, list) and faces and all(isinstance(one, np.ndarray) and one.ndim == 2 for one in faces):
        corners = indices_of(np.concatenate([block.ravel() for block in faces]), "faces")
        sizes = np.concatenate([np.full(len(block), block.shape[1]) for block in faces])
        return Given(_vspring.Mesh(positions, corners, indices_of(np.append(0, np.cumsum(sizes)), "faces")), array)
    if isinstance(faces, np.ndarray):
        table = faces
    else:
        rows = [np.atleast_1d(array_of(face, "faces")) for face in faces]  # type: ignore[union-attr]
        if len({len(row) for row in rows}) != 1:
            corners = np.concatenate(rows) if rows else np.zeros(0, np.int32)
            offsets = np.cumsum([0, *map(len, rows)])
            return Given(_vspring.Mesh(positions, indices_of(corners, "faces"), indices_of(offsets, "faces")), array)
        table = np.stack(rows)
    if table.ndim != 2 or (table.size and table.shape[1] < 1):
        raise _refuse(f"faces: (m, 3) or (m, 4) node numbers, a list of lists or of such arrays, or (corners, offsets) are needed, "
                      f"not {table.dtype} of {table.shape}")
    return Given(_vspring.Mesh.of_sides(positions, indices_of(table, "faces"), max(table.shape[1], 1)), array)


def curve_of(vertices: ArrayLike | _vspring.Curve, chains: Sequence[ArrayLike] | None, closed: Closed) -> Given:
    _refuse_other_kinds(vertices)
    if isinstance(vertices, _vspring.Surface):
        raise TypeError("vertices: a surface of read(); fair() fairs it, and chains= of its vertices are curves")
    if isinstance(vertices, _vspring.Curve):
        return _curve_from_file(vertices, chains, closed)
    array = numbers_of(vertices, "vertices", (2, 3))
    core, ends = _plain_curve(array, [np.arange(len(array), dtype=np.int32)] if chains is None else chains, closed)
    return Given(core, array, ends=ends)


def _curve_from_file(file: _vspring.Curve, chains: Sequence[ArrayLike] | None, closed: Closed) -> Given:
    if chains is not None:
        raise _refuse("chains: those of a curve from read() are its own; leave them out, or give its vertices alone with others")
    if closed is None:
        return _from_file(file)
    core, ends = _plain_curve(file.vertices, file.chains, closed)
    return Given(core, file.vertices, file, ends=ends)


def _plain_curve(array: np.ndarray, chains: Sequence[ArrayLike], closed: Closed) -> tuple[_vspring.PlainCurve, _vspring.JoinedEnds]:
    nodes = [indices_of(chain, "chains") for chain in chains]
    if any(chain.ndim != 1 for chain in nodes):
        raise _refuse("chains: a list of chains is needed, each a list of node numbers; of a single chain [nodes]")
    if isinstance(closed, str):
        raise _refuse(f"closed: True or False, or one of them for each chain, not {closed!r}")
    loops = [bool(one) for one in np.broadcast_to(False if closed is None else closed, len(nodes) if np.ndim(closed) == 0 else np.shape(closed))]
    if len(loops) != len(nodes):
        raise _refuse(f"closed: {len(loops)} values for {len(nodes)} chains")
    return _vspring.curve_of(in_space(array), nodes, loops)


def shape_of(vertices: ArrayLike | _vspring.Surface | _vspring.Curve, faces: Faces | None,
             chains: Sequence[ArrayLike] | None, closed: Closed) -> Given:
    """The shape; a curve if there are no faces."""
    if faces is None and not isinstance(vertices, _vspring.Surface):
        return curve_of(vertices, chains, closed)
    for name, given in (("chains", chains), ("closed", closed)):
        if given is not None and given is not False:
            raise _refuse(f"{name}: that is for curves")
    return surface_of(vertices, faces)


def _from_file(file: _vspring.Surface | _vspring.Curve) -> Given:
    return Given(file._core, file.vertices, file)
