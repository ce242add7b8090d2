"""Fairing, fitting and measuring."""
from __future__ import annotations

from dataclasses import replace
from typing import Any, Mapping, Sequence, TypeVar, Unpack

from numpy.typing import ArrayLike

from . import _vspring
from ._errors import Error, Warning, warn
from ._holding import constraints_of, held_in
from ._options import CurveOptions, FitOptions, MeasureOptions, SurfaceOptions, spelled_out
from ._points import Points, arrays_of, is_drawn, refuse_auto, without_auto
from ._progress import Teller, TimeIsUp, teller
from ._reports import Figure, Figures, FitReport, Report, Result, fit_report_of, report_of
from ._shapes import Closed, Faces, Given, curve_of, shape_of, surface_of, threads_of

SomeReport = TypeVar("SomeReport", bound=Report)

OWN_NODES = (None, None, None)


@spelled_out(SurfaceOptions)
def fair(vertices: ArrayLike | _vspring.Surface, faces: Faces | None = None,
         **options: Unpack[SurfaceOptions]) -> Result[Report]:
    """Fairs a surface: curvature changes as gently as the constraints allow. Connectivity stays.

    vertices: (n, 3), float64 or float32, in any unit. float32 is returned as float32, rounded from doubles.
    faces: (m, 3) or (m, 4) node numbers, a list of lists or of such arrays, or a tuple of two arrays, corners and m + 1
    offsets. Or the result of read() in place of both. With weight, smoothing_length, within, rms or noise, the surface
    is fitted to its own nodes in the input.

    Returns new positions, (n, 3), and a report; arguments are unchanged. See outcome in the report: if it did not
    converge the positions are the best shape so far. Outcome or a warning says if they are worse than the input.

    Raises vspring.Error for input that cannot be faired, TypeError for arguments of a wrong type, and KeyboardInterrupt
    on Ctrl-C; this has the best shape so far as positions and report. Other threads of Python run meanwhile. Cost:
    linear in the nodes, some 10 to 15 µs a node; about 0.9 kB of memory for every moving node.

    Source: A. Yamada, K. Shimada, T. Furuhata, K.-H. Hou, "A Discrete Spring Model for Generating Fair Curves and
    Surfaces", Pacific Graphics 1999; docs/solver.md and docs/springs.md.
    """
    return _fair(surface_of(vertices, faces).welded_by(options.get("weld")).mirrored_about(options.get("symmetry")), options)


@spelled_out(CurveOptions)
def fair_curve(vertices: ArrayLike | _vspring.Curve, *, chains: Sequence[ArrayLike] | None = None,
               closed: Closed = None, **options: Unpack[CurveOptions]) -> Result[Report]:
    """Fairs a curve: between held nodes, curvature becomes linear in arc length.

    vertices: (n, 2) or (n, 3), float64 or float32, in any unit; positions are returned with as many columns.
    chains: node numbers of each chain in order; by default all nodes in a row are one chain.
    closed: whether the last node joins the first; one value for all chains, or one each. If the last row repeats the
    first, the two are one node, and both are returned at the same place; without closed the curve stays open there.
    Or the result of read() in place of vertices and chains; without closed its chains are closed as the file says. With
    weight, smoothing_length, within, rms or noise, the curve is fitted to its own nodes in the input.

    Returns and raises what fair() does. Cost: linear, 0.15 s for 100,000 nodes.

    Source: § 4.8 of the paper; docs/curves.md.
    """
    refuse_with_symmetry(options)
    return _fair(curve_of(vertices, chains, closed).mirrored_about(options.get("symmetry")), options)


@spelled_out(FitOptions)
def fit(vertices: ArrayLike | _vspring.Surface | _vspring.Curve, faces: Faces | None = None,
        points: ArrayLike | Points | None = None, *, weights: ArrayLike | None = None, normals: ArrayLike | None = None,
        chains: Sequence[ArrayLike] | None = None, closed: Closed = None,
        **options: Unpack[FitOptions]) -> Result[FitReport]:
    """Fairs a surface or, without faces, a curve, and fits it to scattered points.

    vertices, faces, chains, closed: as for fair() and fair_curve(), or the result of read(). points: (p, 3), of
    curves in a plane also (p, 2), in units of the shape, or the result of read_points(); by default the shape's own nodes.
    weights: (p,), 0 or more; by default those of the points, or 1 each. A point of weight 0 is only measured.
    normals: (p, 3), of the surface at each point, of unit length, zero if unknown; by default those of the points. A
    point pulls only at nodes whose normal is within 90° of its own.

    One of weight, smoothing_length, within, rms and noise must be given. Returns new positions and a report with
    distances of the points. Raises what fair() does. Cost: that of fair(), and linear in the points for every iteration;
    within and rms bring a surface to equilibrium ten to a hundred times. With fix="none" the boundary of a surface
    goes to where the points end; the report's boundary_of_points says how many nodes could.

    Source: § 4.5 and Eq. 9 of the paper; docs/fit.md.
    """
    refuse_with_symmetry(options)
    given = shape_of(vertices, faces, chains, closed).welded_by(options.get("weld")).mirrored_about(options.get("symmetry"))
    return _fit(given, arrays_of(points, weights, normals, given.columns), options)


@spelled_out(MeasureOptions)
def measure(vertices: ArrayLike | _vspring.Surface | _vspring.Curve, faces: Faces | None = None, *,
            chains: Sequence[ArrayLike] | None = None, closed: Closed = None, **options: Unpack[MeasureOptions]) -> Figures:
    """Measures how fair a surface is or, without faces, a curve.

    vertices, faces: as for fair(); chains, closed: as for fair_curve(). With fix or fix_normals, only faces and edges
    at moving nodes are measured.

    Returns figures by their keys, each with name, unit and definition. Raises vspring.Error, also for a node of these
    that is not finite. Cost: n log n, some
    microseconds a node. Definitions and sources: docs/fairness.md.
    """
    given = shape_of(vertices, faces, chains, closed).welded_by(options.pop("weld", None))
    threads = threads_of(options.pop("threads", None))
    held = constraints_of(given, options) if options else None
    return Figures({key: Figure(value, name, unit, definition)
                    for key, name, unit, definition, value in _vspring.measure(given.core, held, threads)})


def _fair(given: Given, options: Mapping[str, Any]) -> Result[Report]:
    if is_drawn(options):
        return _fit(given, OWN_NODES, options)
    held = held_in(given, options)
    tell = teller(options)
    call = _vspring.fair_resampled if has_new_nodes(options) else _vspring.fair
    positions, fields, stopped_by = call(given.solved, held.constraints, held.settled(options), tell)
    return ended(_as_returned(given, options), positions, report_of(fields), tell, stopped_by)


def _fit(given: Given, points: tuple[Any, Any, Any], options: Mapping[str, Any]) -> Result[FitReport]:
    if points[0] is not None:
        refuse_auto(options)
    for name in ("min_radius", "move"):
        if options.get(name) and not given.is_curve:
            raise Error("invalid-argument", f"{name}: that is for curves")
    settled = dict(options)
    if isinstance(settled.get("move"), str):
        settled["move"] = [settled["move"]]
    settled["planar"] = given.array.shape[1] == 2
    if points[0] is None:
        settled = without_auto(settled, given)
    if points[0] is not None and not given.is_curve and options.get("method") in (None, "equilibrium") and not options.get("paper"):
        # A boundary that is free goes to where the points end.
        settled["fair_boundary"] = True
        if isinstance(fix := options.get("fix"), str) and fix == "none":
            options = {**options, "fair_boundary": True}
    held = held_in(given, options)
    settled = held.settled(settled)
    tell = teller(options)
    if has_new_nodes(options):
        positions, fields, stopped_by = _vspring.fit_resampled(given.core, held.constraints, settled, given.file, tell)
    else:
        positions, fields, stopped_by = _vspring.fit(given.solved, held.constraints, *points, settled, given.file, tell)
    return ended(_as_returned(given, options), positions, fit_report_of(fields), tell, stopped_by)


def _as_returned(given: Given, options: Mapping[str, Any]) -> Given:
    """Of new nodes none follows another."""
    return replace(given, ends=None) if has_new_nodes(options) else given


def has_new_nodes(options: Mapping[str, Any]) -> bool:
    asked = any(options.get(name) is not None for name in ("resample", "spacing"))
    if options.get("resample_by") is not None and not asked:
        raise Error("invalid-argument", "resample_by is for resample and spacing")
    return asked


def refuse_with_symmetry(options: Mapping[str, Any]) -> None:
    for name in ("resample", "spacing", "move"):
        if options.get("symmetry") is not None and options.get(name) is not None:
            raise Error("invalid-argument", f"symmetry keeps the nodes of the curve and moves them in all coordinates; leave {name} "
                        "out, or give it in a call of its own")


def ended(given: Given, positions: Any, report: SomeReport, tell: Teller | None,
          stopped_by: BaseException | None) -> Result[SomeReport]:
    """The result of a call; raises the exception that ended it early, with the best shape so far."""
    if tell is not None and isinstance(stopped_by, TimeIsUp):
        stopped_by = None
        if report.outcome == "cancelled":
            told = Warning("time-limit", f"the time limit of {tell.time_limit:g} s has ended it: this is the best shape so far; allow "
                           "more time, or let a smaller part move")
            report = replace(report, outcome="work-limit", warnings=(*report.warnings, told))
    result = Result(given.like_given(positions), report)
    if stopped_by is not None:
        vars(stopped_by).update(positions=result.positions, report=result.report)
        raise stopped_by
    if tell is not None:
        tell.done()
    warn((warning.code, str(warning)) for warning in report.warnings)
    return result
