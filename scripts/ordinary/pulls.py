"""Shapes of which some nodes are given another place."""
import json
import math
import pathlib
import random
import subprocess

from ordinary.checks import BASIC, QUALITY, check_box, check_crossings, folds, links_of
from ordinary.files import parse_csv, parse_obj, text_of
from ordinary.shapes import KINDS, REAL, edges_of
from ordinary.tasks import Task, shaken
from ordinary.vectors import add, cross, dot, scaled, sub, unit


def normal_at(shape, node, neighbours):
    """Of a curve across its chord there, of a surface by its faces; from the nodes as they are."""
    here = shape.nodes[node]
    if shape.faces is None:
        a, b = (shape.nodes[k] for k in neighbours[node])
        along = unit(sub(b, a))
        if shape.planar:
            return (-along[1], along[0], 0.0)
        across = sub(scaled(add(a, b), 0.5), here)
        across = sub(across, scaled(along, dot(across, along)))
        return unit(across) if math.hypot(*across) > 1e-6 * shape.edge else unit(cross(along, (0.3, 0.5, 0.8)))
    total = (0.0, 0.0, 0.0)
    for face in shape.faces:
        if node in face:
            k = face.index(node)
            before, after = (sub(shape.nodes[j], here) for j in (face[k - 1], face[(k + 1) % len(face)]))
            total = add(total, cross(after, before))
    return unit(total)


def pulled_nodes(draw, inside, neighbours, kind):
    """One node, one with its neighbours, or up to five anywhere."""
    first = draw.choice(inside)
    if kind == "one":
        return [[first]]
    if kind == "patch":
        return [sorted({first, *neighbours[first]} & set(inside))]
    chosen = []
    for _ in range(draw.randint(2, 5)):
        node = draw.choice(inside)
        if all(node != other and node not in neighbours[other] for [other] in chosen):
            chosen.append([node])
    return chosen


def draw_pull_task(seed, number):
    """Without noise, as in design: one or more nodes are given places up to a third of the way to what is held aside
    of the shape; what pulls along the shape is no more than two edges."""
    draw = random.Random(f"{seed} {number} pulls")
    while True:
        shape = KINDS[draw.choice(list(KINDS))](draw)
        if shape.kind == "surface" and not shape.rim and shape.family not in REAL:
            continue
        task = Task(seed, number, shape)
        if shape.family in REAL:
            around = draw.choice(shape.nodes)
            radius = draw.uniform(0.05, 0.2) * shape.size
            task.fixed.update(k for k, node in enumerate(shape.nodes) if math.dist(node, around) > radius)
        if shape.kind == "curve":
            # As whoever designs a curve holds it: the ends say little of what is between.
            every = draw.randint(max(3, len(shape.nodes) // 8), max(4, len(shape.nodes) // 3))
            task.fixed.update(range(0, len(shape.nodes), every))
        links = links_of(shape) if shape.faces else None
        neighbours = {k: set() for k in range(len(shape.nodes))}
        for a, b in edges_of(shape):
            neighbours[a].add(b)
            neighbours[b].add(a)
        inside = [k for k in neighbours if k not in task.fixed and not (links[k] if links else neighbours[k]) & task.fixed]
        if len(inside) > 8:
            break
    if shape.family in REAL:
        task.files["region.json"] = json.dumps([k for k in range(len(shape.nodes)) if k not in task.fixed])
        task.options = ["--region", "region.json"]
    elif shape.rim and draw.random() < 0.6:
        task.options, task.held = ["--fix-normals", "boundary"], True
    kind = draw.choice(("one", "one", "patch", "some"))
    places = {}
    most = 0.0
    for nodes in pulled_nodes(draw, inside, neighbours, kind):
        room = min(math.dist(shape.nodes[nodes[0]], shape.nodes[j]) for j in task.fixed)
        # Not through another part of the curve.
        count = len(shape.nodes)
        apart = lambda k: min(abs(k - nodes[0]), count - abs(k - nodes[0]) if shape.closed else count)
        room = min([room, *(math.dist(shape.nodes[nodes[0]], shape.nodes[k]) for k in range(count)
                            if shape.kind == "curve" and apart(k) * shape.edge > room)])
        way = scaled(normal_at(shape, nodes[0], neighbours), draw.choice((-1, 1)) * draw.uniform(0.02, 0.33) * room)
        aside = min(2 * shape.edge, math.hypot(*way)) if draw.random() < 0.4 else 0.0
        way = shaken(draw, way, aside / math.sqrt(3), shape.planar)
        places.update((k, add(shape.nodes[k], way)) for k in nodes)
        most = max(most, math.hypot(*way))
    task.how = "pulls, " + kind
    shape.detail += f", {100 * most / shape.size:.2g} % of the size"
    width = 2 if shape.planar else 3
    held = sorted(task.fixed - set(shape.rim)) if shape.kind == "curve" else []
    task.rules = [{"nodes": held, "position": "fixed"}] * bool(held)
    task.rules.append({"nodes": sorted(places), "position": [places[k][:width] for k in sorted(places)]})
    with_normal = kind == "one" and draw.random() < 0.3
    if with_normal:
        task.rules[-1]["tangent" if shape.kind == "curve" else "normal"] = "fixed"
    task.files["rules.json"] = json.dumps({"rules": task.rules})
    task.options += ["--constraints", "rules.json"]
    csv = shape.kind == "curve"
    task.input, task.output = ("input.csv", "out.csv") if csv else ("input.obj", "out.obj")
    task.files[task.input] = text_of(shape, shape.nodes, task.input)
    task.closed = ["--closed"] if csv and shape.closed else []
    task.arguments = [task.command, task.input, "-o", task.output, *task.options, *task.closed, "--report", "report.json", "--quiet",
                      "--threads", "1"]

    def check_pull(result, context):
        off = max(math.dist(result.nodes[k], place) for k, place in places.items())
        if off > 1e-9 * shape.size:
            result.blame(QUALITY, f"a node is {off / shape.size:.3g} of the size from the place that it was given")
        before, after = (folds(shape, nodes, places) for nodes in (shape.nodes, result.nodes))
        if after[0] > before[0] or after[1] > before[1]:
            result.blame(BASIC, f"folds {before[0]} to {after[0]}, without area or length {before[1]} to {after[1]}")
        # Few places that hold a curve may well ask for another one; a normal turns what is about it; and shapes of least
        # bending may stay near the input or not.
        has_other = "other-fairness" in result.report["warning_codes"]
        plain = without_pull(task, result, context) if shape.kind == "surface" and not with_normal and not has_other else None
        if plain is None:
            return
        moves = [math.dist(a, b) for a, b in zip(plain, result.nodes)]
        asked = max(math.dist(plain[k], place) for k, place in places.items())
        result.figures["move"] = [asked / shape.size, max(moves) / shape.size]
        if max(moves) > 2 * asked + 0.02 * shape.size:
            result.blame(QUALITY, f"moves by {100 * max(moves) / shape.size:.3g} % of the size for {100 * asked / shape.size:.3g} %")

    task.checks = (check_box, check_crossings, check_pull)
    return task


def without_pull(task, result, context):
    """The nodes that the same options give where no node is pulled; None if that is no equilibrium."""
    options = [word for k, word in enumerate(task.options) if "--constraints" not in (word, task.options[k - 1])]
    name = "plain" + pathlib.Path(task.output).suffix
    arguments = [task.command, task.input, "-o", name, *options, *task.closed, "--report", "plain.json", "--quiet", "--threads", "1"]
    run = subprocess.run([context.program, *arguments], cwd=result.folder, capture_output=True, timeout=10 * context.limit)
    if run.returncode != 0 or "other-fairness" in json.loads((result.folder / "plain.json").read_text())["warning_codes"]:
        return None
    text = (result.folder / name).read_text()
    return parse_csv(text) if name.endswith(".csv") else parse_obj(text)[0]
