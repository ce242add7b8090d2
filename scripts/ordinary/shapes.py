"""Shapes of tasks: curves, patches of surfaces, real meshes."""
import bisect
import collections
import functools
import itertools
import math
import pathlib
import struct

from ordinary.distances import Tree, pieces_of
from ordinary.files import parse_obj
from ordinary.vectors import TAU, cross, diagonal_of, scaled, sub, unit


ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


class Shape:
    """Nodes, on the true shape until noise comes, and faces, or None for a curve.

    directions: exact normals at nodes (curves: tangents), or None. truth: the distance of a point from the true shape, or None.
    fair: whether the true shape is fair where its rim is held with exact normals. radius: about the least radius of curvature.
    sample(draw): a point somewhere on the true shape. another(draw): the truth, the sampling and, of a curve, nodes of a shape that
    differs moderately."""

    def __init__(self, kind, family, nodes, faces=None, closed=False, planar=False, directions=None, truth=None, fair=False,
                 radius=math.inf, sample=None, another=None, detail=""):
        self.kind, self.family, self.nodes, self.faces, self.closed, self.planar = kind, family, nodes, faces, closed, planar
        self.directions, self.truth, self.fair, self.radius = directions, truth, fair, radius
        self.sample, self.another, self.detail = sample, another, detail
        self.size = diagonal_of(nodes)
        self.rim = boundary_nodes(self)
        lengths = [math.dist(nodes[a], nodes[b]) for a, b in edges_of(self)]
        self.edge = math.fsum(lengths) / len(lengths)


def edges_of(shape):
    if shape.faces is None:
        count = len(shape.nodes)
        return [(k, (k + 1) % count) for k in range(count if shape.closed else count - 1)]
    return sorted({(min(a, b), max(a, b)) for face in shape.faces for a, b in zip(face, face[1:] + face[:1])})


def boundary_nodes(shape):
    if shape.faces is None:
        return [] if shape.closed else [0, len(shape.nodes) - 1]
    count = collections.Counter(frozenset(edge) for face in shape.faces for edge in zip(face, face[1:] + face[:1]))
    return sorted({node for edge, faces in count.items() if faces == 1 for node in edge})


def varied(draw, values, by=0.12):
    """Values of the same family, moderately changed: counts stay, lengths and angles change."""
    return {key: value * draw.uniform(1 - by, 1 + by) if isinstance(value, float) else value for key, value in values.items()}


def log_uniform(draw, low, high):
    return math.exp(draw.uniform(math.log(low), math.log(high)))


def steps(draw, count, closed=False):
    """Lengths of edges with sum 1: even, uneven or graded; and which of these."""
    kind = draw.choice(("even", "uneven", "graded"))
    if kind == "even":
        lengths = [1.0] * count
    elif kind == "uneven":
        most = draw.uniform(1.5, 4)
        lengths = [log_uniform(draw, 1, most) for _ in range(count)]
    else:
        ratio = log_uniform(draw, 1.5, 10)
        height = (lambda k: 0.5 - 0.5 * math.cos(TAU * k / count)) if closed else (lambda k: k / max(count - 1, 1))
        lengths = [ratio ** height(k) for k in range(count)]
        if draw.random() < 0.5:
            lengths.reverse()
    total = math.fsum(lengths)
    return [length / total for length in lengths], kind


class Path:
    """A curve at(t) for t from 0 to 1, by arc length: dense enough for the distance from a polyline to be that from the curve."""

    DENSE = 3000

    def __init__(self, at):
        self.at = at
        self.points = [at(k / self.DENSE) for k in range(self.DENSE + 1)]
        self.lengths = list(itertools.accumulate((math.dist(a, b) for a, b in zip(self.points, self.points[1:])), initial=0.0))
        self.length = self.lengths[-1]

    def parameter(self, share):
        """t at a share of the arc length."""
        s = min(max(share, 0), 1) * self.length
        k = min(max(bisect.bisect_right(self.lengths, s) - 1, 0), self.DENSE - 1)
        width = self.lengths[k + 1] - self.lengths[k]
        return (k + ((s - self.lengths[k]) / width if width > 0 else 0)) / self.DENSE

    def tangent(self, t):
        # Formulas continue beyond both ends, except the aerofoil's, which turns back there.
        ahead = sub(self.at(t + 1e-5), self.at(t - 1e-5))
        if math.hypot(*ahead) > 1e-7 * self.length:
            return unit(ahead)
        return unit(sub(self.at(t + 1e-4), self.at(t)) if t < 0.5 else sub(self.at(t), self.at(t - 1e-4)))

    def radius(self):
        return least_radius(self.points[::15])

    @functools.cached_property
    def tree(self):
        return Tree([(a, b) for a, b in zip(self.points, self.points[1:])])


def least_radius(points):
    """Of the circles through successive points; straight: infinite."""
    least = math.inf
    for a, b, c in zip(points, points[1:], points[2:]):
        area = math.hypot(*cross(sub(b, a), sub(c, a)))
        if area > 1e-12 * math.dist(a, c) ** 2:
            least = min(least, math.dist(a, b) * math.dist(b, c) * math.dist(c, a) / (2 * area))
    return least


def from_curvature(knots, total=1.0):
    """The planar curve whose curvature is linear between these knots, even along its length."""
    cells = len(knots) - 1
    per_cell = 400 // cells
    count = cells * per_cell

    def angle(s):
        x = s / total * cells
        k = min(max(int(x), 0), cells - 1)
        before = math.fsum((knots[i] + knots[i + 1]) / 2 for i in range(k))
        f = x - k
        return (before + knots[k] * f + (knots[k + 1] - knots[k]) * f * f / 2) * total / cells

    def simpson(a, b):
        middle = (a + b) / 2
        return [(b - a) / 6 * (turned(angle(a)) + 4 * turned(angle(middle)) + turned(angle(b))) for turned in (math.cos, math.sin)]

    table = [(0.0, 0.0)]
    for k in range(count):
        step = simpson(k * total / count, (k + 1) * total / count)
        table.append((table[-1][0] + step[0], table[-1][1] + step[1]))

    def at(t):
        k = min(max(int(t * count), 0), count - 1)
        rest = simpson(k * total / count, t * total)
        return (table[k][0] + rest[0], table[k][1] + rest[1], 0.0)
    return at


def rounded_rectangle(p):
    width, height = 1.0, p["height"]
    r = p["corner"] * min(width, height) / 2
    sides = [width - 2 * r, height - 2 * r] * 2
    total = sum(sides) + TAU * r

    def at(t):
        s = t % 1 * total
        centre, angle = (width - r, r), -math.pi / 2
        start = (r, 0.0)
        for side in sides:
            along = (math.cos(angle + math.pi / 2), math.sin(angle + math.pi / 2))
            if s <= side:
                return (start[0] + along[0] * s, start[1] + along[1] * s, 0.0)
            s -= side
            if s <= r * math.pi / 2:
                a = angle + s / r
                return (centre[0] + r * math.cos(a), centre[1] + r * math.sin(a), 0.0)
            s -= r * math.pi / 2
            angle += math.pi / 2
            start = (centre[0] + r * math.cos(angle), centre[1] + r * math.sin(angle))
            along = (math.cos(angle + math.pi / 2), math.sin(angle + math.pi / 2))
            after = sides[1] if side == sides[0] else sides[0]
            centre = (centre[0] + along[0] * after, centre[1] + along[1] * after)
        return (r, 0.0, 0.0)
    return at


def aerofoil(p):
    """NACA of four digits with a blunt trailing edge: over the nose from the upper to the lower end, cosine spacing for even t."""
    m, at_most, thick = p["camber"], p["place"], p["thickness"]

    def at(t):
        x = (1 + math.cos(TAU * t)) / 2
        # Odd in √x, so that the nose is smooth in t.
        root = math.cos(math.pi * t)
        half = 5 * thick * (0.2969 * root - (0.1260 * x + 0.3516 * x ** 2 - 0.2843 * x ** 3 + 0.1015 * x ** 4) * (1 if root > 0 else -1))
        back = x > at_most
        scale = m / (1 - at_most) ** 2 if back else m / at_most ** 2
        line = scale * ((1 - 2 * at_most if back else 0) + 2 * at_most * x - x * x)
        slope = math.atan(scale * 2 * (at_most - x))
        return (x - half * math.sin(slope), line + half * math.cos(slope), 0.0)
    return at


def polynomial(p):
    terms = [p[key] for key in sorted(p)]
    return lambda t: (t, 0.4 * math.fsum(c * (2 * t - 1) ** k for k, c in enumerate(terms)), 0.0)


def spiral(p):
    return lambda t: ((1 + p["grows"] * t) * math.cos(p["turn"] * t), (1 + p["grows"] * t) * math.sin(p["turn"] * t), 0.0)


def trefoil(p):
    return lambda t: (math.sin(TAU * t) + p["wide"] * math.sin(2 * TAU * t), math.cos(TAU * t) - p["wide"] * math.cos(2 * TAU * t),
                      -p["high"] * math.sin(3 * TAU * t))


# name: (its values, its formula from them, closed, planar, fair)
CURVES = {
    "arc": (lambda d: {"turn": math.radians(d.uniform(10, 330))},
            lambda p: lambda t: (math.cos(p["turn"] * t), math.sin(p["turn"] * t), 0.0), False, True, True),
    "ellipse": (lambda d: {"b": d.uniform(0.2, 1)}, lambda p: lambda t: (math.cos(TAU * t), p["b"] * math.sin(TAU * t), 0.0),
                True, True, False),
    "elliptic arc": (lambda d: {"b": d.uniform(0.2, 1), "from": d.uniform(0, TAU), "turn": d.uniform(1, 5)},
                     lambda p: lambda t: (math.cos(p["from"] + p["turn"] * t), p["b"] * math.sin(p["from"] + p["turn"] * t), 0.0),
                     False, True, False),
    "sine": (lambda d: {"waves": d.uniform(0.5, 3), "high": log_uniform(d, 0.02, 0.3)},
             lambda p: lambda t: (t, p["high"] * math.sin(TAU * p["waves"] * t), 0.0), False, True, False),
    "spiral": (lambda d: {"grows": d.uniform(0.3, 3), "turn": d.uniform(2, 12)}, spiral, False, True, False),
    "helix": (lambda d: {"turn": d.uniform(2, 2 * TAU), "high": d.uniform(0.5, 4)},
              lambda p: lambda t: (math.cos(p["turn"] * t), math.sin(p["turn"] * t), p["high"] * t), False, False, False),
    "figure eight": (lambda d: {"high": d.uniform(0.4, 1.2)},
                     lambda p: lambda t: (math.sin(TAU * t), p["high"] * math.sin(TAU * t) * math.cos(TAU * t), 0.0), True, True, False),
    "clothoid": (lambda d: {"a": d.uniform(-2.5, 2.5), "b": d.uniform(-4, 4)}, lambda p: from_curvature([p["a"], p["b"]]),
                 False, True, True),
    "road": (lambda d: {f"k{i}": d.uniform(-3, 3) * d.choice((0, 1, 1)) for i in range(d.randint(4, 7))},
             lambda p: from_curvature([p[key] for key in sorted(p)]), False, True, False),
    "trefoil": (lambda d: {"wide": d.uniform(1.5, 2.5), "high": d.uniform(0.5, 1.5)}, trefoil, True, False, False),
    "aerofoil": (lambda d: {"camber": d.choice((0.0, 0.02, 0.04)), "place": d.choice((0.3, 0.4, 0.5)), "thickness": d.uniform(0.06, 0.2)},
                 aerofoil, False, True, False),
    "polynomial": (lambda d: {f"c{i}": d.uniform(-1, 1) for i in range(d.randint(4, 6))}, polynomial, False, True, False),
    "rounded rectangle": (lambda d: {"height": d.uniform(0.4, 1), "corner": d.uniform(0.15, 0.8)}, rounded_rectangle,
                          True, True, False),
}


def draw_curve(draw):
    family = draw.choice(list(CURVES))
    values_of, formula, closed, planar, fair = CURVES[family]
    values = values_of(draw)
    path = Path(formula(values))
    count = round(log_uniform(draw, 16 if closed else 12, 400))
    lengths, spacing = steps(draw, count if closed else count - 1, closed)
    shares = list(itertools.accumulate(lengths, initial=0.0))[:count]
    if family == "aerofoil":
        # By the cosine, as in tables of aerofoils.
        spacing = "cosine, " + spacing
        parameters = shares
    else:
        parameters = [path.parameter(share) for share in shares]
    scale = log_uniform(draw, 0.1, 100)

    def truth(path):
        return lambda point: scale * path.tree.distance(scaled(point, 1 / scale))

    def sample(path):
        return lambda draw: scaled(path.at(path.parameter(draw.random())), scale)

    def another(draw):
        other = Path(formula(varied(draw, values)))
        return truth(other), sample(other), [scaled(other.at(t), scale) for t in parameters]

    return Shape("curve", family, [scaled(path.at(t), scale) for t in parameters], closed=closed, planar=planar,
                 directions=[path.tangent(t) for t in parameters], truth=truth(path), fair=fair, radius=scale * path.radius(),
                 sample=sample(path), another=another, detail=f"{count} nodes, {spacing}")


def cells_between(columns, rows, around, kind):
    """Faces of a grid of nodes with these columns and rows of cells; around: the last column joins the first."""
    wide = columns if around else columns + 1
    at = lambda i, j: j * wide + (i % wide if around else i)
    faces = []
    for j in range(rows):
        i = 0
        if kind in ("bricks", "hexagons"):
            if j % 2:
                if not around:
                    faces.append([at(0, j), at(1, j), at(1, j + 1), at(0, j + 1)])
                i = 1
            last = columns + (i if around else 0)
            while i + 2 <= last:
                faces.append([at(i, j), at(i + 1, j), at(i + 2, j), at(i + 2, j + 1), at(i + 1, j + 1), at(i, j + 1)])
                i += 2
            if i < last:
                faces.append([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
            continue
        for i in range(columns):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            if kind == "quads" or kind == "mixed" and (7 * i + 5 * j) % 4 < 2:
                faces.append([a, b, c, d])
            elif kind == "triangles" or kind == "alternating" and (i + j) % 2 or kind == "mixed" and (i + j) % 3:
                faces += [[a, b, c], [a, c, d]]
            else:
                faces += [[a, b, d], [b, c, d]]
    return faces


class Patch:
    """at(u, v) with u around or across and v along, both 0 to 1. truth: the distance of a point."""

    def __init__(self, at, truth):
        self.at, self.truth = at, truth

    def normal(self, u, v):
        h = 1e-5
        return unit(cross(sub(self.at(u + h, v), self.at(u - h, v)), sub(self.at(u, v + h), self.at(u, v - h))))

    def radius(self):
        lines = [[self.at(u / 8, v / 60) for v in range(61)] for u in range(9)]
        lines += [[self.at(u / 60, v / 8) for u in range(61)] for v in range(9)]
        return min(map(least_radius, lines))

    def lengths(self):
        """Across the middle, and along it."""
        line = lambda points: math.fsum(math.dist(a, b) for a, b in zip(points, points[1:]))
        return line([self.at(k / 40, 0.5) for k in range(41)]), line([self.at(0.5, k / 40) for k in range(41)])


def lathe(profile):
    """A profile t → (r, z) around the axis; turn: share of a full turn."""
    def patch(p):
        path = Path(lambda t: (*profile(p)(t), 0.0))

        def at(u, v):
            # Beyond the ends in a straight line of the parameter, so that normals at rims are exact.
            r, z, _ = path.at(path.parameter(v) + (v - 1 if v > 1 else min(v, 0)) * path.length)
            return (r * math.cos(p["turn"] * u), r * math.sin(p["turn"] * u), z)
        return Patch(at, lambda q: path.tree.distance((math.hypot(q[0], q[1]), q[2], 0.0)))
    return patch


def tube(p):
    big, small = 1.0, p["thick"]

    def at(u, v):
        r = big + small * math.cos(TAU * u)
        return (r * math.cos(p["bend"] * v), r * math.sin(p["bend"] * v), small * math.sin(TAU * u))
    return Patch(at, lambda q: abs(math.hypot(math.hypot(q[0], q[1]) - big, q[2]) - small))


def heights(height):
    """Over a parallelogram."""
    def patch(p):
        z = height(p)

        def truth(q):
            h = 1e-5
            slopes = ((z(q[0] + h, q[1]) - z(q[0] - h, q[1])) / (2 * h), (z(q[0], q[1] + h) - z(q[0], q[1] - h)) / (2 * h))
            return abs(q[2] - z(q[0], q[1])) / math.hypot(1, *slopes)

        def at(u, v):
            x, y = u - 0.5 + p["skew"] * (v - 0.5), p["long"] * (v - 0.5)
            return (x, y, z(x, y))
        return Patch(at, truth)
    return patch


def turned(values):
    """Values of a lathe: a full turn or part of one."""
    return lambda d: {"turn": TAU if d.random() < 0.65 else d.uniform(1, 5), **values(d)}


def spread(values):
    return lambda d: {"skew": d.choice((0.0, d.uniform(-0.6, 0.6))), "long": log_uniform(d, 0.5, 2), **values(d)}


def funnel(p):
    return lambda t: (p["narrow"] + (1 - p["narrow"]) * t * t, p["high"] * t)


def bell(p):
    return lambda t: (1 - (1 - p["narrow"]) * (0.5 - 0.5 * math.cos(math.pi * t)), p["high"] * t)


def vase(p):
    return lambda t: (1 + p["deep"] * math.sin(TAU * p["waves"] * t + p["phase"]), p["high"] * t)


def band(p):
    return lambda t: (math.sin(p["from"] + p["wide"] * t), -math.cos(p["from"] + p["wide"] * t))


def draw_band(d):
    start = d.uniform(0.25, 2)
    return {"from": start, "wide": d.uniform(0.4, min(2.5, 2.9 - start))}


# name: (its values, the patch of them, fair)
SURFACES = {
    "cylinder": (turned(lambda d: {"high": log_uniform(d, 0.4, 4)}), lathe(lambda p: lambda t: (1.0, p["high"] * t)), True),
    "cone": (turned(lambda d: {"narrow": d.uniform(0.2, 0.9), "high": log_uniform(d, 0.3, 3)}),
             lathe(lambda p: lambda t: (1 - (1 - p["narrow"]) * t, p["high"] * t)), False),
    "sphere band": (turned(draw_band), lathe(band), True),
    "bell": (turned(lambda d: {"narrow": d.uniform(0.2, 0.7), "high": log_uniform(d, 0.5, 2)}), lathe(bell), False),
    "vase": (turned(lambda d: {"deep": d.uniform(0.1, 0.5), "waves": d.uniform(0.5, 1.5), "phase": d.uniform(0, TAU),
                               "high": log_uniform(d, 1, 4)}), lathe(vase), False),
    "annulus": (turned(lambda d: {"narrow": d.uniform(0.2, 0.8)}),
                lathe(lambda p: lambda t: (p["narrow"] + (1 - p["narrow"]) * t, 0.0)), True),
    "funnel": (turned(lambda d: {"narrow": d.uniform(0.2, 0.7), "high": log_uniform(d, 0.3, 2)}), lathe(funnel), False),
    "tube": (lambda d: {"thick": d.uniform(0.15, 0.5), "bend": math.radians(d.uniform(60, 300))}, tube, False),
    "plane": (spread(lambda d: {}), heights(lambda p: lambda x, y: 0.0), True),
    "paraboloid": (spread(lambda d: {"high": d.uniform(0.2, 1.5)}), heights(lambda p: lambda x, y: p["high"] * (x * x + y * y)), False),
    "saddle": (spread(lambda d: {"high": d.uniform(0.2, 1.5)}), heights(lambda p: lambda x, y: p["high"] * (x * x - y * y)), False),
    "waves": (spread(lambda d: {"high": d.uniform(0.02, 0.15), "wave": d.uniform(4, 12), "phase": d.uniform(0, TAU)}),
              heights(lambda p: lambda x, y: p["high"] * math.sin(p["wave"] * x + p["phase"]) * math.cos(p["wave"] * y)), False),
    # Its radius exceeds the reach of the parallelogram.
    "cylinder patch": (spread(lambda d: {"round": d.uniform(1.2, 4)}),
                       heights(lambda p: lambda x, y: math.sqrt(p["round"] ** 2 - x * x) - p["round"]), True),
}


def halved(patch_of):
    """Patches that end in the plane y = 0, in which their families are symmetric: those that turn are halves as they are; of what lies
    over a parallelogram they have the part with y from 0 on."""
    def half_of(values):
        whole = patch_of(values)
        at = (lambda u, v: whole.at(u, (1 + v) / 2)) if "skew" in values else whole.at
        return Patch(lambda u, v: in_plane_y(at(u, v)), whole.truth)
    return half_of


def in_plane_y(place):
    """With y exactly 0 where that is so but for rounding."""
    return place if abs(place[1]) > 1e-12 else (place[0], 0.0, place[2])


def draw_grid_surface(draw, half=False):
    family = draw.choice(list(SURFACES))
    values_of, patch_of, fair = SURFACES[family]
    if half:
        patch_of = halved(patch_of)
    while True:
        values = values_of(draw)
        if half:
            turn = draw.choice((math.pi, draw.uniform(0.5, 2.9)))
            values.update((key, turn) for key in ("turn", "bend") if key in values)
            # Else the rim would have a corner in the plane.
            values.update((key, 0.0) for key in ("skew",) if key in values)
        around = family == "tube" or values.get("turn") == TAU
        patch = patch_of(values)
        columns, rows = draw.randint(12 if "turn" in values else 6, 64), draw.randint(4, 40)
        cells = draw.choice(("quads", "triangles", "alternating", "mixed", draw.choice(("bricks", "hexagons"))))
        if cells in ("bricks", "hexagons") and around:
            columns += columns % 2
        wide, long = patch.lengths()
        aspect = wide / columns / (long / rows)
        if 50 <= (columns + (not around)) * (rows + 1) <= 2500 and 0.1 <= aspect <= 10:
            break
    graded = lambda count: steps(draw, count)[0] if draw.random() < 0.35 else [1 / count] * count
    grades = [(graded(columns) if "skew" in values and draw.random() < 0.5 else [1 / columns] * columns), graded(rows)]
    shares = [list(itertools.accumulate(lengths, initial=0.0)) for lengths in grades]
    places = []
    for j in range(rows + 1):
        for i in range(columns + (not around)):
            u, v = shares[0][i], shares[1][j]
            if cells == "hexagons" and 0 < j < rows:
                # Where an edge leads up the node is moved up, and bricks become hexagons.
                v += grades[1][j] / 6 if (i + j) % 2 == 0 else -grades[1][j - 1] / 6
            places.append((u, v))
    scale = log_uniform(draw, 0.1, 100)

    def truth(patch):
        return lambda point: scale * patch.truth(scaled(point, 1 / scale))

    def sample(patch):
        return lambda draw: scaled(patch.at(draw.random(), draw.random()), scale)

    def another(draw):
        other = {**varied(draw, values), **({"turn": TAU} if around and family != "tube" else {})}
        return truth(patch_of(other)), sample(patch_of(other)), None

    spaced = "rows " + ("even" if len(set(grades[1])) == 1 else f"1:{max(grades[1]) / min(grades[1]):.1f}")
    return Shape("surface", family, [scaled(patch.at(u, v), scale) for u, v in places], cells_between(columns, rows, around, cells),
                 directions=[patch.normal(u, v) for u, v in places], truth=truth(patch), fair=fair, radius=scale * patch.radius(),
                 sample=sample(patch), another=another,
                 detail=f"{columns} x {rows} {cells}, {'full turn, ' if around else ''}aspect {aspect:.2g}, {spaced}")


def draw_patch(draw, least_columns, least_around, most_columns, rows, aspect):
    """A family of surfaces, its values and patch, whether it is fair, whether it goes around, and columns and rows of
    cells whose aspect is between 1 / aspect and aspect."""
    while True:
        family = draw.choice(list(SURFACES))
        values_of, patch_of, fair = SURFACES[family]
        values = values_of(draw)
        around = family == "tube" or values.get("turn") == TAU
        patch = patch_of(values)
        columns, count = draw.randint(least_around if around else least_columns, most_columns), draw.randint(*rows)
        wide, long = patch.lengths()
        if 1 / aspect <= wide / columns / (long / count) <= aspect:
            return family, values, patch, fair, around, columns, count


REAL = ("spot.obj", "pipe-blend.obj", "saddle.ply")


@functools.lru_cache(maxsize=None)
def real_mesh(name):
    data = (ROOT / "examples" / name).read_bytes()
    if name.endswith(".obj"):
        return parse_obj(data.decode())
    header, _, body = data.partition(b"end_header\n")
    words = header.decode().split()
    nodes, faces = (int(words[words.index(what) + 1]) for what in ("vertex", "face"))
    nodes = [struct.unpack_from("<3d", body, 24 * k) for k in range(nodes)]
    offset, polygons = 24 * len(nodes), []
    for _ in range(faces):
        count = body[offset]
        polygons.append(list(struct.unpack_from(f"<{count}i", body, offset + 1)))
        offset += 1 + 4 * count
    return nodes, polygons


def draw_real_surface(draw):
    name = draw.choice(REAL)
    nodes, faces = real_mesh(name)
    return Shape("surface", name, list(nodes), [list(face) for face in faces], detail=f"{len(nodes)} nodes",
                 truth=lambda point: real_tree(name).distance(point), radius=0.05 * diagonal_of(nodes))


@functools.lru_cache(maxsize=None)
def real_tree(name):
    return Tree(pieces_of(*real_mesh(name)))


def draw_surface(draw):
    return draw_real_surface(draw) if draw.random() < 0.15 else draw_grid_surface(draw)


KINDS = {"curve": draw_curve, "surface": draw_surface}


def tree_of(shape, nodes, all_ways=False):
    if shape.faces is None:
        return Tree([(nodes[a], nodes[b]) for a, b in edges_of(shape)])
    return Tree(pieces_of(nodes, shape.faces, all_ways))
