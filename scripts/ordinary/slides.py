"""Surfaces of which one end slides on a support."""
import json
import math

from ordinary.checks import CHECKS, QUALITY, check_fairness
from ordinary.shapes import Shape, cells_between, draw_patch
from ordinary.tasks import Task, shaken
from ordinary.vectors import add, cross, dot, root_mean_square, scaled, sub, unit


def support_of(draw, patch, values):
    """What the end v = 1 lies on, as in rules; and a way along it, by which the end may start off, per place."""
    outwards = lambda place: unit((place[0], place[1], 0.0))
    if "skew" in values:
        return {"plane": {"point": patch.at(0.5, 1), "normal": (0.0, 1.0, 0.0)}}, lambda place: (0.0, 0.0, 1.0)
    at = patch.at(0.3, 1)
    if "thick" in values:
        normal = (-math.sin(values["bend"]), math.cos(values["bend"]), 0.0)
        middle = (math.cos(values["bend"]), math.sin(values["bend"]), 0.0)
        return {"plane": {"point": middle, "normal": normal}}, lambda place: unit(sub(place, middle))
    normal = patch.normal(0.3, 1)
    # Along a support on which it lies a surface has no end.
    kinds = ("plane",) * (abs(normal[2]) < 0.95) + ("cylinder",) * (abs(normal[2]) > 0.3) + ("circle",)
    kind = draw.choice(kinds)
    if kind == "plane":
        return {"plane": {"point": (0.0, 0.0, at[2]), "normal": (0.0, 0.0, 1.0)}}, outwards
    if kind == "cylinder":
        return ({"cylinder": {"point": (0.0, 0.0, 0.0), "direction": (0.0, 0.0, 1.0), "radius": math.hypot(at[0], at[1])}},
                lambda place: (0.0, 0.0, 1.0))
    return ({"circle": {"centre": (0.0, 0.0, at[2]), "normal": (0.0, 0.0, 1.0), "radius": math.hypot(at[0], at[1])}},
            lambda place: cross((0.0, 0.0, 1.0), outwards(place)))


def off_support(support, place):
    """How far a place is away from a plane, a cylinder or a circle."""
    (kind, what), = support.items()
    if kind == "plane":
        return abs(dot(sub(place, what["point"]), unit(what["normal"])))
    if kind == "cylinder":
        return abs(math.hypot(place[0], place[1]) - what["radius"])
    return math.hypot(math.hypot(place[0], place[1]) - what["radius"], place[2] - what["centre"][2])


def draw_slide(draw):
    """A patch of which one end slides with its normals, from up to a twentieth of the size beside its place. The other
    ends are held."""
    family, values, patch, fair, around, columns, rows = draw_patch(draw, 6, 12, 48, (6, 32), 5)
    cells = draw.choice(("quads", "triangles", "alternating", "mixed", "bricks"))
    if cells == "bricks" and around:
        columns += columns % 2
    across = columns + (not around)
    exact = [patch.at(i / columns, j / rows) for j in range(rows + 1) for i in range(across)]
    directions = [patch.normal(i / columns, j / rows) for j in range(rows + 1) for i in range(across)]
    faces = cells_between(columns, rows, around, cells)
    shape = Shape("surface", family, exact, faces, directions=directions, truth=patch.truth, fair=fair, radius=patch.radius())
    end = list(range(rows * across, (rows + 1) * across))
    # Of an end that is not closed the corners are held.
    end = end if around else end[1:-1]
    support, way = support_of(draw, patch, values)
    noise = draw.choice((0.0, draw.uniform(0, 0.005))) * shape.size
    # Around a circle each node would leave its exact normal behind.
    begin = draw.choice((0.0, draw.uniform(-0.05, 0.05))) * shape.size * ("circle" not in support)
    offset = {k: scaled(way(exact[k]), begin * (1 if around else math.sin(math.pi * n / (len(end) - 1)))) for n, k in enumerate(end)}
    held = set(shape.rim) - set(end)
    shape.nodes = [node if k in held else add(node, offset[k]) if k in offset else shaken(draw, node, noise, False) for k, node in enumerate(exact)]
    task = Task("", 0, shape)
    task.exact, task.noise, task.fixed, task.held = exact, noise, held, True
    given = draw.choice(("exact", "exact", "fixed"))
    others = draw.choice(("none", "exact"))
    task.rules = [{"nodes": end, "slide": support, "normal": [directions[k] for k in end] if given == "exact" else "fixed"}]
    if others == "exact":
        task.rules.append({"nodes": sorted(held), "normal": [directions[k] for k in sorted(held)]})
    task.how = f"slides, {next(iter(support))}"
    shape.detail = (f"{columns} x {rows} {cells}, {'full turn, ' if around else ''}normals {given}, others {others}, "
                    f"starts {100 * begin / shape.size:.2g} % off")
    task.files["rules.json"] = json.dumps({"rules": task.rules})
    task.options = ["--constraints", "rules.json"]
    if given == "fixed":
        # The true shape may have other normals there.
        task.checks = [check for check in CHECKS if check is not check_fairness]
    task.exact_normals = given == others == "exact"

    def check(result):
        off = max(off_support(support, result.nodes[k]) for k in end)
        if off > 1e-9 * shape.size:
            result.blame(QUALITY, f"{off / shape.size:.3g} of the size off the support")
        apart = root_mean_square(patch.truth(node) for node in result.nodes) / shape.size
        result.figures["truth"] = apart
        if fair and task.exact_normals and apart > 0.005:
            result.blame(QUALITY, f"{100 * apart:.3g} % of the size from the fair shape that the end may reach")
    task.check = check
    return task
