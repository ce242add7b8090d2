"""Two patches that meet in a sharp edge."""
import math

from ordinary.checks import QUALITY
from ordinary.distances import from_segment
from ordinary.shapes import SURFACES, Shape, cells_between, tree_of
from ordinary.tasks import Task, shaken
from ordinary.vectors import TAU, add, cross, dot, root_mean_square, scaled, sub, unit


def turned_about(point, axis, angle):
    """About the origin (Rodrigues)."""
    turned = add(scaled(point, math.cos(angle)), scaled(cross(axis, point), math.sin(angle)))
    return add(turned, scaled(axis, dot(axis, point) * (1 - math.cos(angle))))


def draw_crease(draw):
    """Two patches that meet in a sharp edge: a row of nodes of one, about whose chord the other is turned. Noise is to
    be taken off all of it."""
    while True:
        family = draw.choice([name for name in SURFACES if name != "tube"])
        values_of, patch_of, _ = SURFACES[family]
        values = values_of(draw)
        patch = patch_of(values)
        wide, long = patch.lengths()
        columns, rows = draw.randint(10, 40), draw.randint(8, 24)
        cells = draw.choice(("quads", "triangles", "alternating", "mixed"))
        if values.get("turn") == TAU or not 0.6 <= wide / columns / (long / rows) <= 1.6:
            continue
        first = [[patch.at(i / columns, j / rows) for i in range(columns + 1)] for j in range(rows + 1)]
        axis = unit(sub(first[0][-1], first[0][0]))
        angle = draw.choice((-1, 1)) * math.radians(draw.uniform(50, 130))
        second = [[add(rim, turned_about(sub(node, rim), axis, angle)) for node, rim in zip(row, first[0])] for row in first]
        nodes = [node for row in (*reversed(second[1:]), *first) for node in row]
        crease = [rows * (columns + 1) + i for i in range(columns + 1)]
        across = columns + 1
        turns = [math.degrees(math.acos(max(-1, min(1, dot(unit(cross(sub(nodes[b], nodes[a]), sub(nodes[a + across], nodes[a]))),
                                                             unit(cross(sub(nodes[b], nodes[a]), sub(nodes[a], nodes[a - across]))))))))
                 for a, b in zip(crease, crease[1:])]
        # More than a right angle would count as folds.
        if min(turns) > 55 and max(turns) < 85:
            break
    faces = cells_between(columns, 2 * rows, False, cells)
    exact = Shape("surface", "creases", nodes, faces, radius=patch.radius(), detail=f"{family}, {columns} x {2 * rows} {cells}, turn {min(turns):.0f} to {max(turns):.0f}")
    tree = tree_of(exact, nodes)
    noise = draw.uniform(0.05, 0.3) * exact.edge
    places = [shaken(draw, node, 0 if k in set(exact.rim) else noise, False) for k, node in enumerate(nodes)]
    shape = Shape("surface", "creases", places, faces, truth=tree.distance, radius=exact.radius, detail=exact.detail)
    task = Task("", 0, shape)
    task.exact, task.noise, task.how, task.points = nodes, noise, "noise auto", list(places)
    task.options = ["--noise", "auto", "--sharp", "40"]
    true_edges = set(zip(crease, crease[1:]))

    def check(result):
        chains = result.report.get("sharp", {}).get("chains", [])
        found = {tuple(sorted(pair)) for chain in chains for pair in zip(chain["nodes"], chain["nodes"][1:] + chain["nodes"][:chain["closed"]])}
        if len(found & true_edges) < 0.9 * len(true_edges) or len(found - true_edges) > 0.1 * len(true_edges):
            result.blame(QUALITY, f"{len(found & true_edges)} of {len(true_edges)} sharp edges found, and {len(found - true_edges)} others")
        off, was = (root_mean_square(min(from_segment(at[k], nodes[a], nodes[b]) for a, b in true_edges) for k in crease)
                    for at in (result.nodes, places))
        result.figures["crease"] = [was / exact.edge, off / exact.edge]
        if off > 0.8 * was:
            result.blame(QUALITY, f"the crease is {off / exact.edge:.3g} edges off, {was / exact.edge:.3g} before")
    task.check = check
    return task
