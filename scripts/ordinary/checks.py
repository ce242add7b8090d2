"""Checks of a result, from outside."""
import collections
import json
import math
import pathlib
import subprocess

from ordinary.distances import Tree
from ordinary.files import parse_csv, parse_obj, parse_ply, text_of
from ordinary.shapes import REAL, edges_of, tree_of
from ordinary.vectors import add, box_of, cross, diagonal_of, dot, root_mean_square, scaled, sub, unit


# Warnings that a converged shape never has.
NOT_FOUND = {"no-equilibrium", "worse-than-input", "outside-tolerance"}
HARD, BASIC, QUALITY = "hard", "basic", "quality"  # crash and the like; what exit status 3 has to own up to; what convergence promises


def vector_area(nodes, face):
    corners = [nodes[k] for k in face]
    a = corners[0]
    total = (0.0, 0.0, 0.0)
    for b, c in zip(corners[1:], corners[2:]):
        total = add(total, cross(sub(b, a), sub(c, a)))
    return scaled(total, 0.5)


def folds(shape, nodes, dragged=(), least_cosine=0):
    """Faces that turn by more than 90 degrees against a neighbour, and faces without area; for curves such edges, or those
    that turn by more than least_cosine says.

    Not at dragged nodes, where a spike is wanted."""
    if shape.faces is None:
        edges = [sub(nodes[b], nodes[a]) for a, b in edges_of(shape)]
        pairs = zip(edges, edges[1:] + (edges[:1] if shape.closed else []))
        least = 1e-9 * shape.edge
        return sum(dot(a, b) < least_cosine * math.hypot(*a) * math.hypot(*b) for a, b in pairs), sum(math.hypot(*edge) < least for edge in edges)
    areas = [vector_area(nodes, face) for face in shape.faces]
    # Where three sheets meet, none continues another.
    times = collections.Counter(frozenset(edge) for face in shape.faces for edge in zip(face, face[1:] + face[:1]))
    seen, turned_over = {}, 0
    for k, face in enumerate(shape.faces):
        if not set(dragged).isdisjoint(face):
            continue
        for a, b in zip(face, face[1:] + face[:1]):
            if times[frozenset((a, b))] > (2 if shape.family == "materials" else 4):
                continue
            for other, sign in ((seen.get((b, a)), 1), (seen.get((a, b)), -1)):
                turned_over += other is not None and sign * dot(areas[k], areas[other]) < 0
            seen[a, b] = k
    return turned_over, sum(math.hypot(*area) < 1e-9 * shape.edge ** 2 for area in areas)


def bending(shape, nodes, moving):
    """About the integral of both principal curvatures squared, from the angles between the faces that have moving nodes.

    Not from estimates of curvature: at free rims and their corners these depend more on the mesh than on the
    surface."""
    seen, total = {}, 0.0
    for face in shape.faces:
        if moving.isdisjoint(face):
            continue
        area = vector_area(nodes, face)
        for a, b in zip(face, face[1:] + face[:1]):
            other = seen.setdefault(frozenset((a, b)), area)
            areas = math.hypot(*area) + math.hypot(*other)
            if other is not area and areas > 0:
                angle = math.atan2(math.hypot(*cross(area, other)), dot(area, other))
                total += angle ** 2 * math.dist(nodes[a], nodes[b]) ** 2 / areas
    return total


def links_of(shape):
    """Per node the other nodes of its faces."""
    links = [set() for _ in shape.nodes]
    for face in shape.faces:
        for node in face:
            links[node].update(face)
    for node, link in enumerate(links):
        link.discard(node)
    return links


def solved(a, b):
    """Solves a x = b for a positive definite a; changes both. None if a is not."""
    count = len(b)
    for i in range(count):
        if not a[i][i] > 1e-12:
            return None
        for j in range(i + 1, count):
            factor = a[j][i] / a[i][i]
            for k in range(i, count):
                a[j][k] -= factor * a[i][k]
            b[j] -= factor * b[i]
    for i in reversed(range(count)):
        b[i] = (b[i] - math.fsum(a[i][k] * b[k] for k in range(i + 1, count))) / a[i][i]
    return b


def bending_by_fits(shape, nodes, moving):
    """The bending by quadratics through inner nodes, fitted to their links and the links of these.

    Angles between faces depend on the length of cells: on one sphere 4.9 before they slid and 17.6 after; by fits 6.8
    and 6.8."""
    links, areas, total = links_of(shape), [(0.0, 0.0, 0.0)] * len(nodes), 0.0
    shares = [0.0] * len(nodes)
    for face in shape.faces:
        area = vector_area(nodes, face)
        for node in face:
            areas[node] = add(areas[node], area)
            shares[node] += math.hypot(*area) / len(face)
    for node in moving - set(shape.rim):
        if not any(areas[node]):
            continue
        up = unit(areas[node])
        aside = unit(cross(up, min(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), key=lambda axis: abs(dot(axis, up)))))
        ahead = cross(up, aside)
        a, b = [[0.0] * 5 for _ in range(5)], [0.0] * 5
        for other in links[node].union(*(links[near] for near in links[node])) - {node}:
            e = sub(nodes[other], nodes[node])
            if not any(e):
                continue
            # Lengths in units of the edge, so that all unknowns have one unit.
            x, y, z = (dot(e, axis) / shape.edge for axis in (aside, ahead, up))
            weight = 1 / (x * x + y * y + z * z)
            row = [weight * entry for entry in (x, y, x * x / 2, x * y, y * y / 2)]
            for i in range(5):
                for j in range(5):
                    a[i][j] += row[i] * row[j]
                b[i] += row[i] * weight * z
        fitted = solved(a, b)
        if fitted is None:
            continue
        p, q, r, s, t = fitted
        # Of a graph: κ₁² + κ₂² = (κ₁ + κ₂)² − 2 κ₁ κ₂.
        stretch = 1 + p * p + q * q
        twice_mean = ((1 + q * q) * r - 2 * p * q * s + (1 + p * p) * t) / stretch ** 1.5
        total += (twice_mean ** 2 - 2 * (r * t - s * s) / stretch ** 2) * shares[node] / shape.edge ** 2
    return total


def inflections(shape, nodes, lift=0.0):
    """Inflections of a planar curve, except where they lift it by less than lift or the solver's tolerance."""
    edges = [sub(nodes[b], nodes[a]) for a, b in edges_of(shape)]
    pairs = list(zip(edges, edges[1:] + (edges[:1] if shape.closed else [])))
    turns = [math.atan2(a[0] * b[1] - a[1] * b[0], dot(a, b)) for a, b in pairs]
    least = 1e-6 * max(map(abs, turns))
    runs = []  # [turn, length] between changes
    for turn, (_, b) in zip(turns, pairs):
        if abs(turn) <= least:
            if runs:
                runs[-1][1] += math.hypot(*b)
        elif runs and runs[-1][0] * turn > 0:
            runs[-1] = [runs[-1][0] + turn, runs[-1][1] + math.hypot(*b)]
        else:
            runs.append([turn, math.hypot(*b)])
    signs = [turn > 0 for turn, length in runs if abs(turn) * length / 8 > max(lift, 3e-5 * shape.size)]
    return sum(a != b for a, b in zip(signs, signs[1:] + (signs[:1] if shape.closed else [])))


class Result:
    """The result of a run. reasons: (weight, text)."""

    def __init__(self, task, folder):
        self.task, self.folder = task, folder
        self.status, self.message, self.report, self.nodes, self.faces = None, "", {}, None, None
        self.reasons, self.figures = [], {}

    @property
    def converged(self):
        return self.report.get("outcome") == "converged"

    def blame(self, weight, text):
        self.reasons.append((weight, text))


def check_run(result, context):
    task, shape = result.task, result.task.shape
    spans = task.command == "span"  # curves become faces
    expected = [] if spans else shape.faces or edges_of(shape)
    if result.status is None:
        return result.blame(HARD, f"killed after {context.limit:g} s")
    if result.status == 2:
        return None
    if result.status not in (0, 3):
        return result.blame(HARD, f"exit status {result.status}: {result.message}")
    if not (result.folder / task.output).exists():
        return result.blame(HARD, "no output")
    try:
        text = (result.folder / task.output).read_text()
        nodes, faces = (parse_csv(text), expected) if task.output.endswith(".csv") else (parse_ply if task.output.endswith(".ply") else parse_obj)(text)
    except ValueError as error:
        return result.blame(HARD, f"output is unreadable: {error}")
    if not all(math.isfinite(x) for node in nodes for x in node):
        return result.blame(HARD, "numbers that are not finite")
    # New nodes and faces come behind those of the input; a refined face is others in its place.
    grows = spans or task.command == "fill" or "--refine" in task.options
    if not spans and (len(nodes) != len(shape.nodes) and not grows or len(nodes) < len(shape.nodes)) or \
            "--refine" not in task.options and faces[:len(expected) if grows else None] != expected:
        return result.blame(HARD, "other nodes or faces than the input")
    result.nodes, result.faces = nodes, faces
    ends = task.ends if task.drag else {}
    moved = sum(nodes[k] != shape.nodes[k] if k not in ends else math.dist(nodes[k], ends[k]) > 1e-12 * shape.size for k in task.fixed)
    if moved:
        result.blame(BASIC, f"{moved} fixed nodes moved")
    try:
        result.report = json.loads((result.folder / "report.json").read_text())
    except (OSError, ValueError):
        result.blame(HARD, "no report")
    if result.status == 0 and not result.converged:
        result.blame(QUALITY, f"exit status 0, outcome {result.report.get('outcome')}")
    denied = NOT_FOUND & set(result.report.get("warning_codes", []))
    if result.converged and denied:
        result.blame(QUALITY, f"converged, and yet {', '.join(sorted(denied))}")
    return None


def check_box(result, context):
    task = result.task
    low, high = box_of(task.shape.nodes + (task.points or []) + (list(task.ends.values()) if task.drag else []))
    # Relative to the longest side: between few held nodes a fair curve may be rounder than its flat input, and a
    # tangent or normal may require a wide loop.
    times = 10 if task.held else 3
    reach = [times * max(map(float.__sub__, high, low)) / 2] * len(low)
    outside = [max(abs(x - (l + h) / 2) / r for x, l, h, r in zip(node, low, high, reach)) for node in result.nodes]
    if max(outside) > 1:
        result.blame(BASIC, f"{sum(o > 1 for o in outside)} nodes outside {times} times the box, up to {times * max(outside):.3g} times")
    size, before = diagonal_of(result.nodes), diagonal_of(task.shape.nodes)
    # What only its ends hold becomes straight between them, which is said.
    if size < before / 5 and "only-ends-held" not in result.report.get("warning_codes", []):
        result.blame(BASIC, f"size {before:.3g} to {size:.3g}")


FITS_OF_CURVES = {"within", "rms", "fit", "weight", "length"}


def check_folds(result, context):
    dragged = result.task.ends if result.task.drag else ()
    # Where few nodes go around a nose to which points draw them, one turns by more than a right angle.
    least_cosine = -0.5 if result.task.shape.faces is None and result.task.how in FITS_OF_CURVES else 0
    before, after = (folds(result.task.shape, nodes, dragged, least_cosine) for nodes in (result.task.shape.nodes, result.nodes))
    if after[0] > before[0]:
        result.blame(BASIC, f"folds {before[0]} to {after[0]}")
    if after[1] > before[1]:
        what = "edges without length" if result.task.shape.faces is None else "faces without area"
        result.blame(BASIC, f"{what} {before[1]} to {after[1]}")


def check_inflections(result, context):
    task, shape = result.task, result.task.shape
    if not shape.planar:
        return
    # Next to a jump of curvature a filter overshoots on both sides, by less than what it may remove: a wave whose root
    # mean square is 1 rises by 2 √2.
    lift = max(1.5 * (task.within or 0), 2 * math.sqrt(2) * (task.rms or 0), 0.2 * task.blur)
    exact, before, after = inflections(shape, task.exact), inflections(shape, shape.nodes), inflections(shape, result.nodes, lift)
    result.figures["inflections"] = [exact, before, after]
    # Between held nodes curvature is linear: one change in each span, and one more where it jumps at a held tangent.
    spans = task.inner * (2 if task.inner_normals else 1) + (0 if shape.closed else 1) if task.points is None else 0
    if task.points is not None and task.truth is not shape.truth:
        # Points of another shape: the curve has its inflections, one more at each end that keeps its place, and two if
        # it keeps its direction there.
        spans = task.other_inflections + (0 if shape.closed else 4 if task.held else 2)
    elif task.points is not None and task.held and task.noise and not task.exact_normals:
        # Directions of noisy ends mislead.
        spans = exact + 4
    if after > max(before, spans):
        result.blame(QUALITY, f"inflections {before} to {after}")
        return
    loose = (task.within or 0) >= 2 * task.noise or (task.rms or 0) >= 2 * task.noise
    # What stays near the input, as springs find nothing, is led by the directions of noisy ends.
    misled = "other-fairness" in result.report.get("warning_codes", [])
    smoothed = task.points is None and not task.inner or task.points is not None and (task.within or task.rms) and loose
    if result.converged and smoothed and task.truth is shape.truth and after > exact + (4 if misled else 2):
        result.blame(QUALITY, f"inflections {exact} without noise, {before} with it, {after} after")


def check_fairness(result, context):
    """Checks figures, with a surface's bending measured here: not less fair than the true shape, if that was allowed,
    or than the input.

    A mesh spreads anew, ends bend freely and a held node may stick out, so one figure may rise a little, or from zero.
    If a shape has visibly left the true one, not all three may rise, nor two by much."""
    task, shape = result.task, result.task.shape
    if task.drag or len(task.fixed) == len(task.exact):
        return
    true_rim = all(shape.nodes[k] == task.exact[k] for k in task.fixed)
    if task.points is not None:
        distances = [math.dist(p, q) for p, q in zip(task.points, task.exact)]
        near = task.within and max(distances) <= task.within or task.rms and root_mean_square(distances) <= task.rms
        # Normals held as in the noisy input are not those of the true shape.
        if task.command == "fit" or not near or not true_rim or task.held and task.noise and shape.family not in REAL:
            return
    elif task.inner_normals and task.noise:
        return
    if true_rim and not (task.held and task.noise and not task.exact_normals and shape.family not in REAL):
        name, whose = "true" + pathlib.Path(task.input).suffix, "that shape"
        (result.folder / name).write_text(text_of(shape, task.exact, name))
    else:
        name, whose = task.input, "the input"
    start = task.exact if name == "true" + pathlib.Path(task.input).suffix else shape.nodes
    before, after = (fairness_of(result, context, *which) for which in ((name, start), (task.output, result.nodes)))
    result.figures["fairness"] = [before, after]
    # The last terms allow for a flat shape within the solver's tolerance.
    risen = lambda *times: all(a > t * b + rest for a, b, t, rest in zip(after, before, times, (1e-9, 1e-4, 1e-2)))
    if not risen(1 if task.points is None else 1.5, 1.1, 1.5) and not risen(0, 2, 10):
        return
    if shape.kind == "surface":
        # Angles depend on cells, too: this is a second, slower measure.
        moving = set(range(len(start))) - task.fixed
        before[1], after[1] = (bending_by_fits(shape, nodes, moving) for nodes in (start, result.nodes))
        if not risen(1 if task.points is None else 1.5, 1.1, 1.5) and not risen(0, 2, 10):
            return
    apart = root_mean_square(shape.truth(result.nodes[k]) for k in range(len(result.nodes)) if k not in task.fixed) / shape.size
    if apart > 0.01:
        told = ", ".join(f"{what} {b:.3g} to {a:.3g}" for what, b, a in zip(("energy", "bending", "variation"), before, after))
        result.blame(QUALITY, f"{100 * apart:.3g} % of the size from the true shape and less fair than {whose}: {told}")


def figures_of(result, context, name, more=()):
    """The program's figures of a file."""
    subprocess.run([context.program, "measure", name, *result.task.closed, *more, "--quiet", "--threads", "1", "--report", "measured.json"],
                   cwd=result.folder, check=True, capture_output=True, timeout=context.limit)
    return json.loads((result.folder / "measured.json").read_text())["figures"]


def fairness_of(result, context, name, nodes):
    """V-Spring energy, bending energy and variation of curvature where nodes move."""
    task = result.task
    region = ["--region", "moving.json"] if task.shape.family in REAL else []
    if region:
        (result.folder / "moving.json").write_text(json.dumps([k for k in range(len(task.exact)) if k not in task.fixed]))
    figures = figures_of(result, context, name, region)
    variation = "curvature_variation" if task.shape.kind == "curve" else "mean_curvature_variation"
    bent = figures["bending_energy"] if task.shape.kind == "curve" else bending(task.shape, nodes, set(range(len(nodes))) - task.fixed)
    return [figures["vspring_energy"], bent, figures[variation]]


def held_edges(task):
    """Of a curve, its held nodes."""
    edges = [(face[k - 1], face[k]) for face in task.shape.faces or [] for k in range(len(face))]
    edges += [(k, k) for k in task.fixed] if task.shape.kind == "curve" else []
    return [(task.shape.nodes[a], task.shape.nodes[b]) for a, b in edges if a in task.fixed and b in task.fixed]


def check_distance(result, context):
    task = result.task
    if task.within is None and task.rms is None:
        return
    # A warped face has no definite surface: any way to cut it counts.
    tree = tree_of(task.shape, result.nodes, all_ways=True)
    own = task.command != "fit"
    # Its own node is the nearest part of the result or close to it, so it gives a first bound.
    guesses = [math.dist(p, q) * (1 + 1e-12) if own else math.inf for p, q in zip(task.points, result.nodes if own else task.points)]
    if task.within is not None:
        most = task.within * (1 + 1e-6)
        distances = [guess if guess <= most else tree.distance(p, most, guess) for p, guess in zip(task.points, guesses)]
        result.figures["distance"] = [task.within, max(distances)]
        if max(distances) > most:
            far = sum(d > most for d in distances)
            result.blame(QUALITY, f"{far} of {len(distances)} points further than {task.within:.4g}, up to {max(distances):.4g}")
    else:
        distances = [tree.distance(p, 0.0, guess) for p, guess in zip(task.points, guesses)]
        # To points at what is held nothing that moves comes nearer.
        if own and task.shape.kind == "surface":
            distances = [d for k, d in enumerate(distances) if k not in task.fixed]
        elif not own and (held := held_edges(task)):
            rim = Tree(held)
            distances = [d for d, p in zip(distances, task.points) if d < (1 - 1e-9) * rim.distance(p)]
        found = root_mean_square(distances)
        result.figures["distance"] = [task.rms, found]
        if found > 1.01 * task.rms:
            result.blame(QUALITY, f"root mean square distance {found:.4g} for {task.rms:.4g}")


def check_truth(result, context):
    task, shape = result.task, result.task.shape
    if task.truth is None:
        return
    moving = [k for k in range(len(shape.nodes)) if k not in task.fixed]
    if task.command == "fit" and shape.kind == "curve":
        # Without points the true shape is undetermined.
        moving = [k for k in moving if min(math.dist(task.exact[k], p) for p in task.points) < shape.edge / 2]
    exactly = shape.fair and task.exact_normals and not task.inner and task.points is None
    if not moving or not exactly and task.points is None:
        return
    before, after = (root_mean_square(task.truth(nodes[k]) for k in moving) for nodes in (shape.nodes, result.nodes))
    if exactly:
        most = 0.02 * shape.size
    else:
        # Allows for the tolerance, for smoothing and, at rims, for the curvature that falls to zero over such a length.
        # Points from elsewhere are denser in some places than in others.
        loose = (task.rms or 0) * (1.5 if task.command == "fit" else 1)
        most = 1.5 * before + 1e-3 * shape.size + (task.within or 0) + loose
        most += min(task.blur ** 2 / shape.radius, 0.25 * shape.size)
        if task.held and not task.exact_normals:
            # Directions of a noisy rim mislead as far as the fit allows.
            most += min(1, 2 * task.noise / shape.edge) * task.blur / 2
    result.figures["truth"] = [before / shape.size, after / shape.size, most / shape.size]
    if after > most:
        part = lambda x: f"{100 * x / shape.size:.3g}"
        result.blame(QUALITY, f"{part(after)} % of the size from the true shape, {part(before)} % before, {part(most)} % allowed")


def work_of(result):
    """Moving nodes times iterations, summed over levels, per moving node of the finest."""
    levels = result.report.get("levels", [])
    if not levels:
        return result.report.get("iterations", 0)
    return sum(level["moving_nodes"] * level["iterations"] for level in levels) / max(result.report.get("moving_nodes", 1), 1)


def check_drag(result, context):
    """A session must end at the shape of one run from the input, or at one not less fair, as there may be several
    equilibria."""
    if not result.task.drag or not result.converged:
        return
    afresh = result.report["afresh"]
    result.figures["afresh"] = [afresh["outcome"], afresh["distance"] / result.task.shape.size]
    same = afresh["distance"] < 0.01 * result.task.shape.size
    if afresh["outcome"] == "converged" and not same and result.report["energy"] > 1.5 * afresh["energy"] + 1e-9:
        result.blame(QUALITY, f"the session ends {100 * afresh['distance'] / result.task.shape.size:.3g} % of the size from a fresh run, "
                     f"energy {result.report['energy']:.3g}, {afresh['energy']:.3g} afresh")


def check_crossings(result, context):
    """Checks the program's own count, made anew."""
    task = result.task
    if task.shape.kind == "curve":
        return
    before, after = (figures_of(result, context, which)["self_intersections"] for which in (task.input, task.output))
    if after > before:
        result.blame(BASIC, f"pairs of faces that cross {before} to {after}")


def find_error(result, context):
    """The distance of the result from that of a far smaller tolerance, over the expected error; if both converged."""
    task, report = result.task, result.report
    if not result.converged or task.drag or task.command == "fill" or task.points is not None or not report["expected_error"]:
        return
    if any(level["outcome"] != "converged" for level in report["levels"][:-1]):
        return  # other levels may end elsewhere
    exact = [*task.arguments, "--tolerance", "1e-10"]
    exact[exact.index(task.output)], exact[exact.index("report.json")] = "exact" + pathlib.Path(task.output).suffix, "exact.json"
    process = subprocess.run([context.program, *exact], cwd=result.folder, capture_output=True, timeout=10 * context.limit)
    if process.returncode != 0:
        return
    text = (result.folder / ("exact" + pathlib.Path(task.output).suffix)).read_text()
    nodes = parse_csv(text) if task.output.endswith(".csv") else parse_obj(text)[0]
    moving = set(range(len(nodes))) - task.fixed
    around = {k for edge in edges_of(task.shape) if moving & set(edge) for k in edge}
    size = diagonal_of([task.shape.nodes[k] for k in around]) if around else task.shape.size
    error = max(math.dist(a, b) for a, b in zip(result.nodes, nodes)) / size
    result.figures["error"] = error / report["expected_error"]


CHECKS = (check_box, check_folds, check_crossings, check_inflections, check_fairness, check_distance, check_truth, check_drag)
MUCH_WORK = 3000


def verdict_of(result):
    weights = {weight for weight, _ in result.reasons}
    if HARD in weights or result.status == 0 and weights:
        return "INSANE"
    if result.status == 2:
        return "refused"
    if result.status == 3:
        return "worse, said" if BASIC in weights else "said so"
    return "sane"


def way_of(report):
    """Which attempt (docs/solver.md, where it fails) gave the shape of a surface, in words."""
    levels, warned = report["levels"], report["warning_codes"]
    if not levels:
        return "nothing moves"
    way = levels[-1]["strategy"]
    if "points" in report:
        return "fit, " + way
    if "other-distribution" in warned:
        return way + ", even distribution"
    if way in ("in place", "coarse to fine"):
        return f"{report['springs']} springs, {way}" + (", second" if "other-springs" in warned else "")
    return way
