"""The keyword arguments of calls: their types, and what they mean. Names are those of the command line."""
from __future__ import annotations

import functools
import inspect
import os
from typing import Any, Callable, Literal, Mapping, Sequence, TypedDict, TypeVar

from numpy.typing import ArrayLike

from ._progress import Bar, Progress
from ._sharp import SharpEdges

Nodes = Literal["boundary", "none"] | ArrayLike
"""Nodes of a shape: a mask of n booleans, or an array of their numbers."""


Rules = str | os.PathLike[str] | Mapping[str, Any] | Sequence[Mapping[str, Any]]
"""The path of a file of rules, its contents, or a list of rules."""


class Holding(TypedDict, total=False):
    fix: Nodes
    fix_normals: Nodes
    constraints: Rules
    region: str | ArrayLike


class Pulling(TypedDict, total=False):
    weight: float
    smoothing_length: float
    within: float | Literal["auto"]
    rms: float | Literal["auto"]
    noise: float | Literal["auto"]
    outliers: float


class Mirroring(TypedDict, total=False):
    symmetry: str


class Sharpness(TypedDict, total=False):
    sharp_edges: ArrayLike | SharpEdges
    sharp_curves: Literal["fit", "hold"]
    sharp: float


class CurvePulling(TypedDict, total=False):
    min_radius: float
    sharp: float
    move: str | Sequence[str]


class Resampling(TypedDict, total=False):
    resample: int
    spacing: float
    resample_by: Literal["length", "cosine", "curvature"]


class Solving(TypedDict, total=False):
    paper: bool
    method: Literal["equilibrium", "multigrid", "sweep"]
    tolerance: float
    step_tolerance: float
    levels: int
    pre_smoothing: int
    max_iterations: int
    distribution: Literal["smooth", "even", "keep"]
    strength: float


class Running(TypedDict, total=False):
    threads: int
    time_limit: float
    progress: Callable[[Progress], object] | Bar


class Welding(TypedDict, total=False):
    weld: float


class SurfaceOptions(Holding, Mirroring, Pulling, Sharpness, Welding, Solving, Running, total=False):
    springs: Literal["sphere", "edge"]
    fair_by: Literal["curvature", "bending"]
    continuity: Literal["tangent", "curvature"]
    pseudo_normals: Literal["link", "average", "area", "angle"]
    fair_boundary: bool


class CurveOptions(Holding, Mirroring, Pulling, CurvePulling, Resampling, Solving, Running, total=False):
    continuity: Literal["tangent", "curvature"]
    normal_plane: Literal["full", "principal"]


class FitOptions(Holding, Mirroring, Pulling, CurvePulling, Sharpness, Welding, Solving, Running, total=False):
    boundary_reach: float


class SessionOptions(Holding, Sharpness, Solving, total=False):
    threads: int
    springs: Literal["sphere", "edge"]
    fair_by: Literal["curvature", "bending"]
    continuity: Literal["tangent", "curvature"]
    pseudo_normals: Literal["link", "average", "area", "angle"]
    fair_boundary: bool
    normal_plane: Literal["full", "principal"]


class FillOptions(Running, total=False):
    at: ArrayLike
    max_size: float
    max_edges: int
    outer_rims: bool
    flat: bool
    tolerance: float
    fair_by: Literal["curvature", "bending"]
    continuity: Literal["tangent", "curvature"]


class SpanOptions(Running, total=False):
    length: float
    join: float
    fair_curves: bool
    sharp: ArrayLike
    symmetry: str
    loops: ArrayLike
    also: ArrayLike
    without: ArrayLike
    flat: bool
    tolerance: float
    fair_by: Literal["curvature", "bending"]


class RefineOptions(Holding, total=False):
    length: float
    turn: float


class RemeshOptions(Holding, total=False):
    length: float
    sharp_edges: ArrayLike | SharpEdges


class MeasureOptions(Holding, Welding, total=False):
    threads: int


MEANINGS = {
    "fix": 'nodes whose positions are fixed: "boundary" (the default; of curves the ends), "none", a mask of n booleans, '
           "or node numbers",
    "fix_normals": 'nodes whose normals (curves: tangents) are fixed as they are in the input, to second order: "none" '
                   '(the default), "boundary", a mask or node numbers',
    "constraints": 'rules for positions, normals and tangents, as in docs/constraints.md: the path of a JSON file, its '
                   'contents as a dict, or a list of rules; "nodes" may be a mask or an array',
    "region": 'only these nodes move; they meet the rest smoothly: "sphere:x,y,z,r", "box:x0,y0,z0,x1,y1,z1" (units of '
              'the input), "group:NAME", the path of a JSON file, a mask or node numbers',
    "symmetry": 'half a shape, whose boundary (of curves ends) is in this plane, becomes half of what the whole comes to, '
                'and a whole one comes out symmetric: "x", "y" or "z" (where that is 0), "x=2.5", or '
                '"plane:px,py,pz,nx,ny,nz" by a point and a normal; units of the input. Of span(): where the surface ends in it, it '
                "is at right angles to it, but not along sharp curves",
    "sharp_edges": "surfaces: edges along which the surface may turn sharply, (k, 2) node numbers, or what "
                   "find_sharp_edges() returns. Rules may name more",
    "sharp_curves": 'surfaces: sharp edges stay where they are ("hold"), or are made fair as curves in space, drawn to their '
                    'own nodes where these pull ("fit"); by default "fit" with weight, smoothing_length, within, rms or noise '
                    'of fair(), else "hold"',
    "weight": "the paper's k: the weight of a point against the springs of its node, 0 or more",
    "smoothing_length": "remove details shorter than about 6 times this, on any mesh; units of the input",
    "within": 'the fairest shape with no point further away than this, units of the input; "auto": from the estimated '
              "noise of the nodes",
    "rms": 'the fairest shape whose root mean square distance from the points is this, units of the input; "auto" as for '
           "within",
    "noise": 'remove noise of this standard deviation in each coordinate, units of the input; "auto" as for within',
    "boundary_reach": "surfaces with a free boundary and scattered points: how far from it points may be to tell where it is, "
                      "units of the input; by default two of its edges; of a refined surface Refined.boundary_reach",
    "outliers": "leave out points that are far off, at most this share of all: 0 to less than 1",
    "min_radius": "curves fitted to points: the least radius of curvature, units of the input",
    "sharp": "curves, and chains of sharp edges that are fitted: keep corners where they turn by more than this; degrees, less "
             "than 180. Of span(): curves along which the surface may have an edge, a mask of them or their numbers",
    "move": 'curves fitted to their own nodes: only these coordinates change, letters such as "y" or "yz", or names of '
            "columns",
    "weld": "surfaces: join nodes at most this share of the diagonal of the box around the faces apart; 0: those at the "
            "same place. The result has positions for all of them",
    "resample": "curves: this many nodes in all, new ones between held ones; the report has their origin",
    "spacing": "curves: new nodes about this far apart on average, units of the input",
    "resample_by": 'spacing of new nodes: even by "length" (the default), by "cosine", closer at the ends and the nose, '
                   'or closer where "curvature" is greater',
    "paper": "the paper's own choices throughout, its equations as printed, for comparison; with its sweep unless method "
             "is given. It sets springs, pseudo_normals and normal_plane",
    "method": '"equilibrium" (the default), or the paper\'s "multigrid" or "sweep"',
    "tolerance": "equilibrium: end when no node is expected to be further from its final place than this share of the "
                 "diagonal of the box around the moving nodes; 1e-5 by default",
    "step_tolerance": "multigrid, sweep: end when no node moves further in an iteration than this share of its mean edge "
                      "length; 0.001 by default",
    "levels": "multigrid: the number of levels",
    "pre_smoothing": "multigrid: iterations on each level on the way down; 5 by default",
    "max_iterations": "most iterations on each level",
    "distribution": 'along the shape, nodes keep the spacing of the input without its noise ("smooth"), go to the mean of '
                    'their neighbours ("even"), or keep their shares between neighbours ("keep")',
    "strength": "result = input + strength × (fair − input), 0 to 1; 1 by default",
    "springs": '"sphere" (the default): the same shape on every mesh; "edge": as in the paper',
    "fair_by": '"curvature" (the default): mean curvature changes as evenly as it can; "bending": least bending energy',
    "continuity": 'how a shape meets what is beside it and does not move: with its tangents or tangent planes ("tangent", '
                  'the default), or with its curvature, too ("curvature"); curves also at ends with fix_normals',
    "pseudo_normals": '"link" (the default), "average", "area" or "angle"',
    "fair_boundary": "fair the boundary loops first, as curves, then the surface; replaces fix=\"boundary\"",
    "normal_plane": '"full" (the default): forces of curves in space act in the whole normal plane; "principal": along '
                    "the principal normal only, as in the paper",
    "at": "fill only holes through these boundary nodes, also outer rims: a mask of n booleans, or node numbers",
    "max_size": "fill only holes whose rim is at most this long, units of the input",
    "max_edges": "fill only holes whose rim has at most this many edges",
    "outer_rims": "fill the outer rims of sheets, too: rims whose normal is less than 60° from that of the faces there",
    "flat": "do not fair patches; they have creases at the rim, or along curves",
    "length": "divide edges until none is longer than this, units of the input. Of remesh(): about the length of edges; by "
              "default their median. Of span(): the length of edges; by default an 80th of the diagonal of the box around "
              "the curves",
    "join": "curves that come nearer to each other than this meet there, units of the input; by default a thousandth of that "
            "diagonal",
    "fair_curves": "first fair the curves in space; they keep their junctions and the tangents at their ends",
    "loops": "span only these loops, by their numbers in the result",
    "also": "span these loops, too: outer rims and lids",
    "without": "leave these loops open",
    "turn": "divide edges until the surface turns by at most this along each; degrees, less than 180",
    "time_limit": "end after this many seconds with the best shape so far and a warning",
    "threads": "number of threads; all cores by default. The same bits for every number",
    "progress": "called at most about 20 times a second with a vspring.Progress, or a bar such as tqdm(total=1); an "
                "exception from it ends the call, and has positions and report of the best shape so far",
}

Call = TypeVar("Call", bound=Callable[..., Any])


def spelled_out(options: type) -> Callable[[Call], Call]:
    """Lists the keyword arguments of a call in its signature and its documentation, and refuses others."""
    hints = {name: hint.__forward_arg__ for name, hint in options.__annotations__.items()}

    def decorate(call: Call) -> Call:
        def check(*given: Any, **named: Any) -> Any:
            for name in named:
                if name not in own and name not in hints:
                    raise TypeError(f"{call.__name__}() has no argument {name!r}; it has {', '.join([*own, *hints])}")
            return call(*given, **named)

        signature = inspect.signature(call)
        own = {name: one for name, one in signature.parameters.items() if one.kind is not one.VAR_KEYWORD}
        more = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=hint)
                for name, hint in hints.items()]
        checked: Any = functools.wraps(call)(check)
        checked.__signature__ = signature.replace(parameters=[*own.values(), *more])
        lines = [f"{name}: {MEANINGS[name]}." for name in hints]
        checked.__doc__ = inspect.cleandoc(call.__doc__ or "") + "\n\nKeyword arguments:\n\n" + "\n".join(lines)
        return checked

    return decorate
