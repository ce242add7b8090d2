"""Reports and results of calls."""
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
    kept_nodes: int  # of less bending: they stay, as faces would turn over there
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
    """Of surfaces: springs of the shape returned, "sphere" or "edge"."""
    fair_by: str
    """Of surfaces: "curvature" or "bending"."""
    continuity: str
    """"tangent" or "curvature", how the shape meets what is around it."""
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
    sliding_nodes: int
    fixed_normals: int
    fixed_tangents: int
    corners: int
    """Of curves: nodes at which direction and curvature may jump."""
    sharp_edges: int
    """Of surfaces: how many edges are kept sharp."""
    rounded_edges: np.ndarray
    """(k, 2) node numbers: fits by noise do not keep these of sharp_edges, as the surface would fold at them."""
    greatest_move: float
    """How far a node is from the input at most, in units of the input."""
    rms_move: float
    """The root mean square of these distances over the moving nodes."""
    seconds: float
    threads: int
    history: tuple[float, ...]
    """The residual after every iteration, over all levels."""
    node_iterations: float
    """Work on all levels, in iterations on one moving node."""
    node_iteration_limit: float | None
    """The limit of the work; None if iterations are limited instead."""
    levels: tuple[Level, ...]
    """The levels in the order of the work, the coarsest first."""
    warnings: tuple[Warning, ...]
    """The warnings, which Python's warnings show, too."""
    boundary: Report | None
    """With fair_boundary: the report of the boundary's own fairing."""
    origin: np.ndarray | None
    """With new nodes: the number of each node in the input; -1 for a new one. Else None."""
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
    """How the free boundary of a surface was fitted to points."""

    points: int
    """Points near the boundary at which the points end."""
    ends: int
    """Boundary nodes near which the points end: they move there."""
    inside: int
    """Boundary nodes beyond which the points go on: they move across, onto the points."""
    kept: int
    """Boundary nodes without points near enough to tell: they stay, with a warning."""


@dataclass(frozen=True, repr=False)
class FitReport(Report):
    """How a fit ended."""

    points: int
    pulling_points: int
    """Points tied to a moving node at the end."""
    pulled_nodes: int
    """Moving nodes with points tied to them, at the end."""
    most_points: int
    """The most points on one node."""
    outliers: int
    """Points left out."""
    outlying_points: np.ndarray
    """The numbers of the outliers."""
    outside_points: int
    """With within and rms: points further away than that, of those that count."""
    points_at_held: int
    """Surfaces: points nearest to something held, which nothing that moves comes nearer to; no figure counts them."""
    greatest_at_held: float
    """How far away they are at most."""
    active_points: np.ndarray
    """With within: the points at that distance, to 1 %, which prevent a fairer shape."""
    noise_leaves: float | None
    """With noise, of curves: the root mean square distance that the curve is drawn to."""
    smoothing_length: float | None
    """The smoothing length, given or, for a tolerance, found."""
    least_radius: float | None
    """With min_radius: the least radius of curvature of the new curve."""
    sharpest_node: int
    """The node of the least radius; -1 without."""
    greatest_slide: float
    """How far a node moved along the shape at most, if the points are its own nodes."""
    boundary_of_points: BoundaryOfPoints | None
    """Set if the boundary of a surface is fitted to scattered points, not to its nodes."""
    before: Distances | None
    after: Distances | None
    distances: np.ndarray
    """The distance of every point from the new shape, also of outliers."""

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
    """One row per node, of the given type; fixed nodes bit for bit."""
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
