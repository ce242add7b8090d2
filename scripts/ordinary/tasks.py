"""A task, and the ways to fair a shape."""
import collections
import json
import math
import random

from ordinary.checks import CHECKS, inflections
from ordinary.files import csv_text, text_of
from ordinary.shapes import KINDS, REAL, edges_of, log_uniform, tree_of
from ordinary.vectors import add, cross, dot, scaled, sub, unit


class Task:
    """files: further input files. exact: nodes before noise. fixed: nodes that must not move, bit for bit. held: what
    holds normals or tangents. within, rms: distances that the points must keep. blur: a length; shorter details go."""

    def __init__(self, seed, number, shape):
        self.seed, self.number, self.shape = seed, number, shape
        self.exact, self.fixed = list(shape.nodes), set(shape.rim)
        self.noise, self.inner, self.inner_normals, self.held, self.exact_normals = 0.0, 0, False, False, False
        self.within = self.rms = self.points = None
        self.blur = 0.0
        self.how, self.options, self.files = "", [], {}
        self.drag, self.rules, self.check = None, [], None
        self.input, self.output, self.closed = "input.obj", "out.obj", []
        self.command = "curve" if shape.kind == "curve" else "fair"
        self.truth, self.other_inflections = shape.truth, 0
        self.checks = CHECKS


def kind_of(seed, number):
    return random.Random(f"{seed} {number}").choice(list(KINDS))


def draw_task(seed, number):
    draw = random.Random(f"{seed} {number}")
    shape = KINDS[draw.choice(list(KINDS))](draw)
    task = Task(seed, number, shape)
    everywhere = draw.random() < 0.25
    if draw.random() > 1 / 3:
        task.noise = draw.uniform(0, 0.005) * shape.size
    if shape.family in REAL:
        ways = ["region"] * 5 + ["within", "rms", "length", "weight"]
        around = draw.choice(shape.nodes)
        radius = draw.uniform(0.03, 0.2) * shape.size
        task.options += ["--region", "sphere:" + ",".join(f"{x!r}" for x in (*around, radius))]
        task.fixed.update(k for k, node in enumerate(shape.nodes) if math.dist(node, around) > radius)
        task.held = True
        everywhere = False
    elif shape.rim:
        ways = ["plain", "plain", "normals", "normals", "exact normals", "exact normals", "held", "within", "rms", "length", "weight",
                "fit", "fit"]
    else:
        ways = ["held", "held", "within", "rms", "length", "weight", "fit"]
    task.how = draw.choice(ways)
    if task.how == "exact normals":
        everywhere = False
    still = () if everywhere else task.fixed
    shape.nodes = [node if k in still else shaken(draw, node, task.noise, shape.planar) for k, node in enumerate(shape.nodes)]
    if shape.family in REAL and task.noise:
        # The nodes of the region must not change with the noise.
        task.options[-1] = "region.json"
        task.files["region.json"] = json.dumps([k for k in range(len(shape.nodes)) if k not in task.fixed])
    HOW[task.how](draw, task)
    if shape.kind == "surface" and task.points is None and random.Random(f"{seed} {number} drag").random() < 0.2:
        draw_drag(random.Random(f"{seed} {number} drag"), task)
    csv = shape.kind == "curve" and draw.random() < 0.6
    task.input = "input.csv" if csv else "input.obj"
    task.output = "out.csv" if csv else "out.obj"
    task.files[task.input] = text_of(shape, shape.nodes, task.input)
    task.closed = ["--closed"] if csv and shape.closed else []
    task.arguments = [task.command, task.input, "-o", task.output, *task.options, *task.closed, "--report", "report.json", "--quiet",
                      "--threads", "1"]
    if task.drag:
        task.arguments = [task.input, "constraints.json", "drag.json", task.output, "report.json"]
    return task


def shaken(draw, node, noise, planar):
    moved = tuple(x + noise * draw.uniform(-1, 1) for x in node)
    return (moved[0], moved[1], node[2]) if planar else moved


def along_surface(shape, node, way):
    normal = (0.0, 0.0, 0.0)
    for face in shape.faces:
        if node in face:
            k = face.index(node)
            before, after = (sub(shape.nodes[j], shape.nodes[node]) for j in (face[k - 1], face[(k + 1) % len(face)]))
            normal = add(normal, cross(after, before))
    normal = unit(normal)
    return sub(way, scaled(normal, dot(way, normal)))


def draw_drag(draw, task):
    """A session in which one to four neighbouring nodes are pulled along a line in steps, and in a third of the cases back again."""
    shape = task.shape
    neighbours = collections.defaultdict(set)
    for a, b in edges_of(shape):
        neighbours[a].add(b)
        neighbours[b].add(a)
    inside = [k for k in range(len(shape.nodes)) if k not in task.fixed and not neighbours[k] & task.fixed]
    if not inside:
        return
    chosen = {draw.choice(inside)}
    while len(chosen) < draw.randint(1, 4):
        chosen.add(draw.choice(sorted(set().union(*(neighbours[k] for k in chosen)))))
    chosen = sorted(chosen - task.fixed)
    room = min((math.dist(shape.nodes[k], shape.nodes[j]) for k in chosen for j in task.fixed), default=shape.size / 2)
    count, length = draw.randint(3, 20), log_uniform(draw, 0.05, 0.7) * room
    way = scaled(unit(tuple(draw.gauss(0, 1) for _ in range(3))), length)
    if draw.random() < 0.3:
        # One node along the surface, no further than the nodes around can make way.
        chosen, way = chosen[:1], scaled(unit(along_surface(shape, chosen[0], way)), min(length, 0.5 * room))
    shares = [(k + 1) / count for k in range(count)]
    if draw.random() < 1 / 3:
        shares += shares[-2::-1] + [0.0]
    task.drag = {"nodes": chosen, "moves": [scaled(way, share) for share in shares]}
    rules = [{"nodes": sorted(task.fixed), "position": "fixed"}]
    if "--fix-normals" in task.options:
        rules.append({"nodes": shape.rim, "normal": "fixed"})
    task.files = {"constraints.json": json.dumps({"rules": rules + task.rules}), "drag.json": json.dumps(task.drag)}
    task.how = "drag, " + task.how
    task.fixed |= set(chosen)
    task.ends = {k: add(shape.nodes[k], task.drag["moves"][-1]) for k in chosen}
    task.inner, task.truth, task.command = len(chosen), None, "drag"


def rim_normals(draw, task):
    task.options += ["--fix-normals", "boundary"]
    task.held = True


def exact_normals(draw, task):
    give_directions(task, task.shape.rim)
    task.files["rules.json"] = json.dumps({"rules": task.rules})
    task.options += ["--constraints", "rules.json"]
    task.exact_normals = True


def give_directions(task, nodes):
    what = "tangent" if task.shape.kind == "curve" else "normal"
    width = 2 if task.shape.planar else 3
    task.rules = [{"nodes": nodes, what: [task.shape.directions[k][:width] for k in nodes]}]
    task.held = True


def held_nodes(draw, task):
    """Some nodes inside stay where they are, some of them with their normal."""
    shape = task.shape
    inside = [k for k in range(len(shape.nodes)) if k not in task.fixed]
    if shape.kind == "curve" and draw.random() < 0.6:
        every = draw.randint(3, max(4, len(shape.nodes) // 4))
        chosen = inside[every // 2::every]
    else:
        chosen = sorted(draw.sample(inside, min(len(inside) // 3, draw.randint(1, 12))))
    if shape.closed and len(chosen) < 4:
        chosen = inside[::max(1, len(inside) // 4)]
    task.rules = []
    way = draw.choice(("free", "free", "fixed", "exact"))
    if way == "exact":
        give_directions(task, chosen)
    task.rules.insert(0, {"nodes": chosen, "position": "fixed"})
    if way == "fixed":
        task.rules[0]["tangent" if shape.kind == "curve" else "normal"] = "fixed"
    task.inner, task.inner_normals = len(chosen), way != "free"
    task.held = task.held or way != "free"
    task.fixed.update(chosen)
    task.files["rules.json"] = json.dumps({"rules": task.rules})
    task.options += ["--constraints", "rules.json"]
    if shape.rim and draw.random() < 0.3:
        rim_normals(draw, task)


def tolerance(draw, task):
    """1 to 4 times the noise; without noise a usual tolerance."""
    return draw.uniform(1, 4) * task.noise if task.noise else log_uniform(draw, 3e-4, 5e-3) * task.shape.size


def fit_within(draw, task, more=0.0):
    task.within = tolerance(draw, task) + more
    task.options += ["--within", repr(task.within)]


def fit_rms(draw, task, more=0.0):
    task.rms = tolerance(draw, task) / 2 + more
    task.options += ["--rms", repr(task.rms)]


def fit_length(draw, task):
    task.blur = min(log_uniform(draw, 2, 20) * task.shape.edge, task.shape.size / 8)
    task.options += ["--smoothing-length", repr(task.blur)]


def fit_weight(draw, task):
    weight = log_uniform(draw, 0.01, 1)
    task.blur = 2 * (0.01 / weight) ** 0.25 * task.shape.edge
    task.options += ["--weight", repr(weight)]


def own_points(fit):
    """The nodes of the input are the points."""
    def draw_options(draw, task):
        fit(draw, task)
        task.points = list(task.shape.nodes)
        if task.shape.rim and task.shape.family not in REAL and draw.random() < 0.2:
            rim_normals(draw, task)
    return draw_options


def fit_points(draw, task):
    """Points from elsewhere: from the true shape at other places, or from another of its family."""
    shape = task.shape
    way = draw.choice((fit_within, fit_rms, fit_length, fit_weight))
    sample = shape.sample
    count = min(round(draw.uniform(0.7, 4) * len(shape.nodes)), 4000)
    task.command = "fit"
    if way in (fit_length, fit_weight) and draw.random() < 0.6:
        task.truth, sample, nodes = shape.another(draw)
        task.other_inflections = inflections(shape, nodes) if shape.planar else 0
    points = [sample(draw) for _ in range(count)]
    if way in (fit_within, fit_rms):
        # How far they lie above edges and faces, or beyond the rim; smaller tolerances cannot be met.
        tree = tree_of(shape, task.exact)
        way(draw, task, max(map(tree.distance, points)))
    else:
        way(draw, task)
    task.points = [shaken(draw, point, task.noise, shape.planar) for point in points]
    task.files["points.csv"] = csv_text(task.points, shape.planar)
    task.options += ["--points", "points.csv"]
    if shape.rim and draw.random() < 0.2:
        rim_normals(draw, task)


HOW = {"plain": lambda draw, task: None, "normals": rim_normals, "exact normals": exact_normals, "held": held_nodes,
       "region": lambda draw, task: None, "within": own_points(fit_within), "rms": own_points(fit_rms),
       "length": own_points(fit_length), "weight": own_points(fit_weight), "fit": fit_points}
