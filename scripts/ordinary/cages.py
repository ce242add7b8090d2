"""Coarse meshes that are refined and drawn onto scans."""
import math
import types

from ordinary.checks import BASIC, QUALITY, folds, vector_area
from ordinary.files import csv_text
from ordinary.shapes import Shape, cells_between, draw_patch, log_uniform
from ordinary.tasks import Task, shaken
from ordinary.vectors import root_mean_square


def draw_cage(draw):
    """A coarse mesh near a scan, drawn onto it with finer edges."""
    family, _, patch, _, around, columns, rows = draw_patch(draw, 3, 8, 12, (3, 10), 2.5)
    cells = draw.choice(("quads", "triangles", "alternating", "mixed"))
    exact = [patch.at(i / columns, j / rows) for j in range(rows + 1) for i in range(columns + (not around))]
    faces = cells_between(columns, rows, around, cells)
    shape = Shape("surface", family, exact, faces, truth=patch.truth, radius=patch.radius(),
                  detail=f"{columns} x {rows} {cells}{', full turn' if around else ''}")
    is_free = draw.random() < 0.6
    off = draw.uniform(0, 0.3) * shape.edge
    shape.nodes = [node if k in set(shape.rim) and not is_free else shaken(draw, node, off, False) for k, node in enumerate(exact)]
    task = Task("", 0, shape)
    task.exact, task.how, task.command = exact, "cages", "fit"
    if is_free:
        task.fixed = set()
    length = shape.edge / draw.uniform(1.5, 6)
    # Two points or more for each square of a new edge, so that the boundary is told.
    area = math.fsum(math.hypot(*vector_area(exact, face)) for face in faces)
    side = min(70, math.ceil(math.sqrt(draw.uniform(2, 6) * area / length ** 2)) + 1)
    task.noise = draw.uniform(0, 0.003) * shape.size
    evenly = draw.random() < 0.5
    task.points = [shaken(draw, patch.at(*((i / (side - 1), j / (side - 1)) if evenly else (draw.random(), draw.random()))), task.noise, False)
                   for i in range(side) for j in range(side)]
    way = draw.choice(("weight", "length", "within", "rms"))
    if way == "weight":
        task.options = ["--weight", repr(log_uniform(draw, 0.01, 1))]
    elif way == "length":
        task.blur = draw.uniform(1, 4) * length
        task.options = ["--smoothing-length", repr(task.blur)]
    else:
        # What edges of this length leave of the shape, and the noise. A rim that is held stays as coarse as it was.
        most = draw.uniform(1.2, 3) * (2 * task.noise + (length if is_free else shape.edge) ** 2 / shape.radius / 4)
        task.options = ["--" + way, repr(most if way == "within" else most / 2)]
        task.within = most
    shape.detail += f", {way}, {'free' if is_free else 'held'}, edges / {shape.edge / length:.1f}, {len(task.points)} points"
    task.options += ["--points", "points.csv", "--refine", repr(length), "--fix", "none" if is_free else "boundary"]
    task.files["points.csv"] = csv_text(task.points, False)
    task.checks = ()
    blur = max(task.blur, 2 * length) if way != "weight" else 3 * length
    # At a rim that is free to turn curvature falls to zero over such a length.
    most = 2e-3 * shape.size + 1.5 * task.noise + (task.within or 0) + min(blur ** 2 / shape.radius, 0.04 * shape.size)

    def check(result):
        grown = types.SimpleNamespace(faces=result.faces, family=family, edge=shape.edge)
        came, found = folds(shape, shape.nodes), folds(grown, result.nodes)
        # A divided edge counts once for each of its parts.
        parts = math.ceil(2 * shape.edge / length)
        if found[0] > parts * came[0] or found[1] > came[1]:
            result.blame(BASIC, f"folds {came[0]} to {found[0]}, faces without area {came[1]} to {found[1]}")
        before, after = (root_mean_square(map(patch.truth, nodes)) for nodes in (shape.nodes, result.nodes))
        result.figures["truth"] = [before / shape.size, after / shape.size, most / shape.size]
        if after > most:
            result.blame(QUALITY, f"{100 * after / shape.size:.3g} % of the size from the true shape, {100 * before / shape.size:.3g} % before, "
                                  f"{100 * most / shape.size:.3g} % allowed")
    task.check = check
    return task
