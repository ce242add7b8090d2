"""Networks of curves to be spanned: lines on known surfaces, that meet or nearly meet, with pieces left out."""
import collections
import math
import types

from ordinary.checks import BASIC, QUALITY, figures_of, folds
from ordinary.distances import from_segment
from ordinary.shapes import log_uniform
from ordinary.tasks import Task, shaken
from ordinary.vectors import TAU, diagonal_of

# Of the noise in curves, what a surface through them may have more than they: it continues their slopes.
NOISE_TIMES = 6


class Surface:
    """at(u, v): a place, for u and v from 0 to 1. truth: the distance of a place from it. radius: about the least radius of
    curvature. around: whether u and v = 1 are 0 again. poles: whether v = 0 and 1 are points."""

    def __init__(self, family, at, truth, radius, around=(False, False), poles=False):
        self.family, self.at, self.truth, self.radius, self.around, self.poles = family, at, truth, radius, around, poles


def sphere(draw):
    width, height, tilt = draw.uniform(0.4, 2), draw.uniform(0.4, 2), draw.uniform(-0.4, 0.4)

    def at(u, v):
        a, b = width * (u - 0.5) + tilt * v, height * (v - 0.5)
        return math.cos(b) * math.cos(a), math.cos(b) * math.sin(a), math.sin(b)
    return Surface("sphere", at, lambda p: abs(math.hypot(*p) - 1), 1)


def torus(draw):
    r, begin, height, width = draw.uniform(0.2, 0.5), draw.uniform(0, TAU), draw.uniform(0.8, 3), draw.uniform(0.6, 3)

    def at(u, v):
        a, b = width * u, begin + height * v
        return (1 + r * math.cos(b)) * math.cos(a), (1 + r * math.cos(b)) * math.sin(a), r * math.sin(b)
    return Surface("torus", at, lambda p: abs(math.hypot(math.hypot(p[0], p[1]) - 1, p[2]) - r), r)


def height_field(draw):
    kind, a, b = draw.choice(("saddle", "bowl", "waves")), draw.uniform(0.1, 0.5), draw.uniform(0.6, 2)
    height, slopes, radius = {
        "saddle": (lambda x, y: a * x * y, lambda x, y: (a * y, a * x), 1 / a),
        "bowl": (lambda x, y: a * (x * x + y * y), lambda x, y: (2 * a * x, 2 * a * y), 0.5 / a),
        "waves": (lambda x, y: 0.3 * a * math.sin(3 * x) * math.cos(2 * y),
                  lambda x, y: (0.9 * a * math.cos(3 * x) * math.cos(2 * y), -0.6 * a * math.sin(3 * x) * math.sin(2 * y)), 1 / (2.7 * a))}[kind]

    def at(u, v):
        x, y = 2 * u - 1 + 0.2 * v, b * (2 * v - 1)
        return x, y, height(x, y)
    return Surface(kind, at, lambda p: abs(p[2] - height(p[0], p[1])) / math.hypot(1, *slopes(p[0], p[1])), radius)


def tube(draw):
    length, waist = draw.uniform(1, 6), draw.uniform(0, 0.2)

    def radius_at(z):
        return 1 - waist * math.sin(math.pi * z / length)

    def at(u, v):
        z = length * v
        return radius_at(z) * math.cos(TAU * u), radius_at(z) * math.sin(TAU * u), z
    slope = waist * math.pi / length
    return Surface("tube", at, lambda p: abs(math.hypot(p[0], p[1]) - radius_at(p[2])) / math.hypot(1, slope * math.cos(math.pi * p[2] / length)), 0.8,
                   around=(True, False))


def ring(draw):
    r = draw.uniform(0.2, 0.5)

    def at(u, v):
        return (1 + r * math.cos(TAU * v)) * math.cos(TAU * u), (1 + r * math.cos(TAU * v)) * math.sin(TAU * u), r * math.sin(TAU * v)
    return Surface("ring", at, lambda p: abs(math.hypot(math.hypot(p[0], p[1]) - 1, p[2]) - r), r, around=(True, True))


def globe(draw):
    def at(u, v):
        b = math.pi * (v - 0.5)
        return math.cos(b) * math.cos(TAU * u), math.cos(b) * math.sin(TAU * u), math.sin(b)
    return Surface("globe", at, lambda p: abs(math.hypot(*p) - 1), 1, around=(True, False), poles=True)


def lines_between(draw, count, around):
    """Parameters of lines, not quite even."""
    at = [(k + (draw.uniform(-0.25, 0.25) if 0 < k < count else 0)) / count for k in range(count + 1)]
    return at[:-1] if around else at


def draw_network(draw):
    surface = draw.choice((sphere, torus, height_field, height_field, tube, ring, globe))(draw)
    columns, rows = draw.randint(3 if surface.around[0] else 1, 6), draw.randint(3 if surface.around[1] or surface.poles else 1, 6)
    us, vs = lines_between(draw, columns, surface.around[0]), lines_between(draw, rows, surface.around[1])
    # Pieces of lines by where they begin: (along u?, column, row).
    pieces = [(True, i, j) for i in range(columns) for j in range(len(vs)) if not (surface.poles and j in (0, rows))]
    pieces += [(False, i, j) for i in range(len(us)) for j in range(rows)]
    inner = [(along, i, j) for along, i, j in pieces
             if (0 < j < rows or surface.around[1] if along else 0 < i < columns or surface.around[0]) and not surface.poles]
    gone = set()
    if len(inner) > 4 and draw.random() < 0.4:
        gone.add(draw.choice(inner))
    exact = draw.random() < 0.5
    next_of = lambda lines, k: lines[k + 1] if k + 1 < len(lines) else 1.0
    steps = draw.randint(4, 12)
    curves = []
    for along, first, second in {(True, None, j) for along, _, j in pieces if along} | {(False, i, None) for along, i, _ in pieces if not along}:
        runs = [[]]
        for k in range(columns if along else rows):
            piece = (True, k, second) if along else (False, first, k)
            lines, other = (us, vs[second]) if along else (vs, us[first])
            begin, end = lines[k], next_of(lines, k)
            if piece in gone:
                runs.append([])
                continue
            runs[-1] += [(begin + (end - begin) * t / steps, other) for t in range(0 if not runs[-1] else 1, steps + 1)]
        for run in runs:
            if not run:
                continue
            if not exact:  # nodes of their own, so that lines meet between them
                count = len(run) + draw.randint(0, 5)
                run = [(run[0][0] + (run[-1][0] - run[0][0]) * t / count, run[0][1]) for t in range(count + 1)]
            curves.append([surface.at(*(place if along else place[::-1])) for place in run])
    curves.sort()
    draw.shuffle(curves)
    curves = [curve if draw.random() < 0.5 else curve[::-1] for curve in curves]
    everywhere = [node for curve in curves for node in curve]
    size = diagonal_of(everywhere)
    noise = draw.uniform(0, 5e-4) * size if draw.random() < 0.4 else 0.0
    # How far lines that meet between their nodes are from there: where pieces of both lines begin or end.
    sag = 0.0
    for i, u in enumerate(us):
        for j, v in enumerate(vs):
            before = (i - 1) % columns if i > 0 or surface.around[0] else None, (j - 1) % rows if j > 0 or surface.around[1] else None
            beside = ((True, i, j), (True, before[0], j), (False, i, j), (False, i, before[1]))
            if len({piece[0] for piece in beside if piece in pieces and piece not in gone}) < 2:
                continue
            place = surface.at(u, v)
            near = sorted(min(from_segment(place, a, b) for a, b in zip(curve, curve[1:])) for curve in curves)
            sag = max(sag, near[1])
    curves = [[shaken(draw, node, noise, False) for node in curve] for curve in curves]
    nodes = [node for curve in curves for node in curve]
    shape = types.SimpleNamespace(kind="surface", family=surface.family, nodes=nodes, faces=[], rim=[], size=size, truth=surface.truth,
                                  detail=f"{columns} x {rows} loops, {len(curves)} curves of {len(nodes)} nodes")
    task = Task(None, None, shape)
    task.command, task.how, task.noise, task.checks = "span", "networks", noise, (check_crossings_of_output,)
    task.files[task.input] = "".join("v " + " ".join(map(repr, node)) + "\n" for node in nodes)
    first = 1
    for curve in curves:
        task.files[task.input] += "l " + " ".join(str(first + k) for k in range(len(curve))) + "\n"
        first += len(curve)
    apart = 2 * sag + 4 * noise
    if apart > 1e-3 * size:
        task.options += ["--join", repr(apart)]
    length = log_uniform(draw, size / 150, size / 40)
    if draw.random() < 0.5:
        task.options += ["--length", repr(length)]
    if draw.random() < 0.2:
        task.options += ["--fair-by", "bending"]
    widest = max(math.dist(surface.at(us[i], vs[j]), surface.at(next_of(us, i), next_of(vs, j)))
                 for i in range(columns) for j in range(rows)) * (2 if gone else 1)
    loops = columns * rows - len(gone)
    task.check = lambda result: check_span(result, loops, widest ** 2 / (8 * surface.radius), apart)
    return task


def check_span(result, loops, bulge, apart):
    """Checks the loops, and how far the surface is from the true one: as compared with how far a loop bulges."""
    task = result.task
    if result.report["spanned_loops"] != loops:
        result.blame(QUALITY, f"{result.report['spanned_loops']} loops are spanned, {loops} were drawn")
    times = collections.Counter(frozenset(edge) for face in result.faces for edge in zip(face, face[1:] + face[:1]))
    crowded = sum(count > 2 for count in times.values())
    if crowded:
        result.blame(BASIC, f"{crowded} edges of more than two faces")
    edge = math.fsum(math.dist(*(result.nodes[k] for k in pair)) for pair in times) / max(len(times), 1)
    turned_over, empty = folds(types.SimpleNamespace(faces=result.faces, edge=edge, family=task.shape.family), result.nodes)
    if turned_over or empty:
        result.blame(BASIC, f"{turned_over} folds, {empty} faces without area")
    used = {node for face in result.faces for node in face}
    far = max((task.shape.truth(result.nodes[node]) for node in used), default=math.inf)
    most = 0.3 * bulge + NOISE_TIMES * task.noise + apart
    result.figures["off"] = [far / task.shape.size, most / task.shape.size]
    if far > most:
        result.blame(QUALITY, f"{100 * far / task.shape.size:.3g} % of the size from the true surface, {100 * most / task.shape.size:.3g} allowed")


def check_crossings_of_output(result, context):
    if not result.faces:
        return
    crossing = figures_of(result, context, result.task.output)["self_intersections"]
    if crossing:
        result.blame(BASIC, f"{crossing} pairs of faces cross")
