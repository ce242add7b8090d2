"""The curvatures of a surface at its nodes, and colours for them."""
from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _vspring
from ._errors import Error
from ._shapes import Faces, numbers_of, surface_of, threads_of

SEQUENTIAL = "440154 472d7b 3b528b 2c728e 21908c 27ad81 5dc863 aadc32 fde725"
"""viridis, Stéfan van der Walt and Nathaniel Smith 2015 (matplotlib, CC0)."""

DIVERGING = "542788 8073ac b2abd2 d8daeb f7f7f7 fee0b6 fdb863 e08214 b35806"
"""PuOr, Cynthia Brewer (colorbrewer2.org, Apache 2), turned round."""

SHARE = 0.96
"""Of the values, that colours are spread over."""


class Curvatures(NamedTuple):
    """The curvatures of a surface at its nodes, 1/length, positive where the surface bends away from its normal, as on
    a sphere with outward normals."""

    k1: np.ndarray
    """(n,): the greater principal curvature."""
    k2: np.ndarray
    """(n,): the lesser one."""
    normals: np.ndarray
    """(n, 3): unit length, in the sense of the faces; zero where no face has the node."""
    directions1: np.ndarray
    """(n, 3): along which the curvature is k1, unit length, of either sense; zero where too few nodes are around."""
    directions2: np.ndarray
    """(n, 3): the same of k2."""

    @property
    def mean(self) -> np.ndarray:
        """(n,): (k1 + k2) / 2."""
        return (self.k1 + self.k2) / 2

    @property
    def gaussian(self) -> np.ndarray:
        """(n,): k1 k2, 1/length²."""
        return self.k1 * self.k2


def curvatures(vertices: ArrayLike | _vspring.Surface, faces: Faces | None = None, *, threads: int | None = None) -> Curvatures:
    """Computes the curvatures of a surface at its nodes: by a polynomial of fourth degree through each node, fitted to
    the nodes around.

    vertices, faces: as for fair(), or the result of read(). threads: their number; the same bits for every number.

    On smooth surfaces the error is of third order in the spacing, also at boundaries. Zero where too few nodes are
    around. Raises vspring.Error. Cost: linear, some microseconds a node. Source: Cazals and Pouget 2005;
    docs/fairness.md.
    """
    return Curvatures(*_vspring.curvatures(surface_of(vertices, faces).core, threads_of(threads)))


def colours(values: ArrayLike, *, about: float | None = None, over: ArrayLike | None = None) -> tuple[np.ndarray, tuple[float, float]]:
    """Colours for numbers at nodes, perceptually uniform and safe for the colour-blind.

    values: (n,), finite. about: the value that is white, with violet below and orange above; without it colours go from
    dark blue to yellow. over: values that determine the range, such as those of another shape or of a part; by default
    `values`. The range is their middle 96 %; values beyond have the colours of the ends.

    Returns (n, 3), sRGB from 0 to 1, and the values of the first and the last colour. Raises vspring.Error.
    """
    numbers = _finite(values, "values")
    low, high = _range(numbers if over is None else _finite(over, "over"), about)
    points = np.array([[int(code[k:k + 2], 16) for k in (0, 2, 4)] for code in (SEQUENTIAL if about is None else DIVERGING).split()]) / 255
    place = np.clip((numbers - low) / (high - low), 0, 1)
    at = np.linspace(0, 1, len(points))
    return np.column_stack([np.interp(place, at, part) for part in points.T]), (low, high)


def _finite(values: ArrayLike, name: str) -> np.ndarray:
    numbers = numbers_of(np.reshape(np.asarray(values), (-1, 1)), name, (1,))[:, 0].astype(float)
    if not np.isfinite(numbers).all():
        raise Error("invalid-argument", f"{name}: number {int(np.argmin(np.isfinite(numbers)))} is not finite")
    return numbers


def _range(numbers: np.ndarray, about: float | None) -> tuple[float, float]:
    """A sphere has one curvature except in the last digits, so it gets one colour."""
    if not len(numbers):
        numbers = np.zeros(1)
    if about is None:
        low, high = np.quantile(numbers, [(1 - SHARE) / 2, (1 + SHARE) / 2])
        middle, reach = (low + high) / 2, max((high - low) / 2, 0.01 * abs(low + high)) or 1.0
    else:
        middle, reach = about, np.quantile(np.abs(numbers - about), (1 + SHARE) / 2) or 1.0
    return float(middle - reach), float(middle + reach)
