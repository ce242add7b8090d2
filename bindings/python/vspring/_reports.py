"""What a call tells of itself."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Generic, Mapping, NamedTuple, TypeVar

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
    usable: bool
    """Whether the shape is an answer to what was asked, as with exit status 0 of the command line: it converged, and no
    hole that was to be filled is left open. Else it is a shape on the way, or the input in place of a worse one."""
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
    origin: np.ndarray | None
    """With new nodes, for each of them the number that it had in the input; -1 for a new one. Else None."""
    chains: list[np.ndarray] | None
    """With new nodes, the numbers of each chain's nodes in order. Else None."""

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


@dataclass(frozen=True)
class Distances:
    """Distances of points from a shape, in units of the input."""

    greatest: float
    point: int
    """The number of the furthest point."""
    rms: float
    median: float
    percentile90: float
    percentile99: float


@dataclass(frozen=True)
class BoundaryOfPoints:
    """What points tell of the boundary of a surface that is not held."""

    points: int
    """Those at which the points end, near the boundary."""
    ends: int
    """Nodes of the boundary near which the points end: they go there."""
    inside: int
    """Nodes beyond which the points go on: they go across to the points, and no further."""
    kept: int
    """Nodes without points near enough to tell: they stay, with a warning."""


@dataclass(frozen=True, repr=False)
class FitReport(Report):
    """How a run ended that drew a shape to points."""

    points: int
    pulling_points: int
    """Those tied to a node that moves, at the end."""
    pulled_nodes: int
    """Moving nodes with points tied to them, at the end."""
    most_points: int
    """The most points on one of these."""
    outliers: int
    """Points left out."""
    outlying_points: np.ndarray
    """Their numbers."""
    outside_points: int
    """With within and rms: those further away than that."""
    active_points: np.ndarray
    """With within: the points at that distance, to 1 %, which keep the shape from becoming fairer."""
    noise_leaves: float | None
    """With noise, of curves: the root mean square distance that it leaves."""
    smoothing_length: float | None
    """The one given or, for a tolerance, found."""
    least_radius: float | None
    """With min_radius: the least one of the new curve."""
    sharpest_node: int
    """The node that has it; -1 without."""
    greatest_slide: float
    """The greatest way of a node along the shape, where the points are its own nodes."""
    boundary_of_points: BoundaryOfPoints | None
    """Where the boundary of a surface is drawn to points of its own, not to its nodes."""
    before: Distances | None
    after: Distances | None
    distances: np.ndarray
    """Of every point from the new shape, outliers too."""

    def _lines(self) -> list[str]:
        lines = super()._lines()
        told = "" if self.after is None else f", rms {self.after.rms:.4g} away, {self.after.greatest:.4g} at most"
        lines.insert(2, f"  {self.points} points, of which {self.pulling_points} pull{told}")
        return lines


def fit_report_of(fields: Mapping[str, Any]) -> FitReport:
    distances = {name: None if fields[name] is None else Distances(**fields[name]) for name in ("before", "after")}
    told = fields["boundary_of_points"]
    boundary = None if told is None else BoundaryOfPoints(**told)
    return FitReport(**{**_typed(fields), **distances, "boundary_of_points": boundary})


AnyReport = TypeVar("AnyReport", bound=Report, covariant=True)


class Result(NamedTuple, Generic[AnyReport]):
    """A fair shape: `positions, report = vspring.fair(...)`."""

    positions: np.ndarray
    """One row a node, of the type that was given; fixed nodes bit for bit."""
    report: AnyReport


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
