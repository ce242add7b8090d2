"""What a call tells of itself."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, NamedTuple

import numpy as np

from ._errors import Warning


@dataclass(frozen=True)
class Level:
    """The work on one level of the hierarchy."""

    moving_nodes: int
    iterations: int
    outcome: str
    strategy: str
    seconds: float


@dataclass(frozen=True, repr=False)
class Report:
    """How a run ended."""

    outcome: str
    """"converged", "iteration-limit", "work-limit", "stalled", "worse-than-input" or "cancelled"."""
    method: str
    """"equilibrium", "multigrid" or "sweep"."""
    springs: str
    """Of surfaces, in the end: "sphere" or "edge"."""
    fair_by: str
    """Of surfaces: "curvature" or "bending"."""
    iterations: int
    residual: float
    """The figure that the stopping test compares."""
    expected_error: float | None
    """Predicted largest distance of a node from its final place, as a share of the diagonal of the box around the
    moving nodes; None with "sweep", which cannot tell."""
    nodes: int
    faces: int
    moving_nodes: int
    fixed_positions: int
    fixed_normals: int
    fixed_tangents: int
    corners: int
    """Of curves: nodes at which direction and curvature may jump."""
    greatest_move: float
    """How far a node is from the input at most, in units of the input."""
    rms_move: float
    """The same as a root mean square over the moving nodes."""
    seconds: float
    threads: int
    history: tuple[float, ...]
    """The residual after every iteration, over all levels."""
    node_iterations: float
    """Work on all levels, in iterations on one moving node."""
    node_iteration_limit: float | None
    """The most that would have been done; None where iterations are limited instead."""
    levels: tuple[Level, ...]
    """Those that were worked on, the coarsest first."""
    warnings: tuple[Warning, ...]
    """Those that were given by Python's warnings, too."""
    boundary: Report | None
    """With fair_boundary: that of the boundary's own fairing."""

    @property
    def converged(self) -> bool:
        """Whether no node is expected to be further from its final place than the tolerance."""
        return self.outcome == "converged"

    def __repr__(self) -> str:
        return "\n".join(self._lines())

    def _lines(self) -> list[str]:
        error = "" if self.expected_error is None else f", expected error {100 * self.expected_error:.1g} % of the size"
        lines = [f"{type(self).__name__}: {self.outcome} after {self.iterations} iterations, {self.seconds:.2f} s{error}",
                 f"  {self.moving_nodes} of {self.nodes} nodes moved, by up to {self.greatest_move:.4g}, "
                 f"root mean square {self.rms_move:.4g}"]
        return lines + [f"  {warning.code}: {warning}" for warning in self.warnings]


def report_of(fields: Mapping[str, Any]) -> Report:
    return Report(**_typed(fields))


def _typed(fields: Mapping[str, Any]) -> dict[str, Any]:
    boundary = fields["boundary"]
    return {**fields,
            "history": tuple(fields["history"]),
            "levels": tuple(Level(**level) for level in fields["levels"]),
            "warnings": tuple(Warning(code, text) for code, text in fields["warnings"]),
            "boundary": None if boundary is None else report_of(boundary)}


class Result(NamedTuple):
    """A fair shape: `positions, report = vspring.fair(...)`."""

    positions: np.ndarray
    """One row a node, of the type that was given; fixed nodes bit for bit."""
    report: Report


class Figure(NamedTuple):
    """One measure of fairness."""

    value: float | int
    name: str
    unit: str
    definition: str


class Figures(dict[str, Figure]):
    """All figures of a shape by their keys: `figures["bending_energy"].value`, or `figures.bending_energy` for short."""

    def __getattr__(self, key: str) -> float | int:
        try:
            return self[key].value
        except KeyError:
            raise AttributeError(f"no figure {key!r}; there are {', '.join(self)}") from None

    def __repr__(self) -> str:
        return "\n".join(f"{one.name:<30} {one.value:>10.4g} {one.unit}" for one in self.values())
