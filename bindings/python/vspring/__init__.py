"""Fair curves and surfaces: vspring moves the nodes of a polygon mesh or a polygonal curve until curvature changes as
gently as the constraints allow.

    positions, report = vspring.fair(vertices, faces)

Arguments have the names of the command line. Lengths are in units of the input. See docs/python.md.
"""
from ._chains import Chains, chains_of, order
from ._curvature import Curvatures, colours, curvatures
from ._errors import Error, Warning
from ._fairing import fair, fair_curve, fit, measure
from ._files import read, write
from ._filling import Filled, Hole, fill
from ._points import Points, read_points
from ._progress import Bar, Progress
from ._refining import Refined, Remeshed, refine, remesh
from ._reports import BoundaryOfPoints, Distances, Figure, Figures, FitReport, Level, Report, Result
from ._session import Session
from ._spanning import NetworkCurve, NetworkLoop, Spanned, span
from ._sharp import SharpEdges, find_sharp_edges
from ._symmetry import Symmetry, find_symmetry
from ._vspring import Curve, Surface
from ._vspring import version as _version

__version__: str = _version()

__all__ = ["Bar", "BoundaryOfPoints", "Chains", "Curvatures", "Curve", "Distances", "Error", "Figure", "Figures", "Filled", "FitReport", "Hole",
           "Level", "NetworkCurve", "NetworkLoop", "Points", "Progress", "Refined", "Remeshed", "Report", "Result", "Session", "SharpEdges", "Spanned", "Surface", "Symmetry", "Warning", "chains_of",
           "colours", "curvatures", "fair", "fair_curve", "fill", "find_sharp_edges", "find_symmetry", "fit", "measure", "order", "read",
           "read_points", "refine", "remesh", "span", "write"]
