"""Surfaces with holes to be filled."""
import collections
import math
import random
import types

from ordinary.checks import BASIC, QUALITY, check_crossings, folds
from ordinary.files import text_of
from ordinary.shapes import REAL, Shape, draw_grid_surface, draw_real_surface, log_uniform
from ordinary.tasks import Task, shaken
from ordinary.vectors import add, cross, diagonal_of, dot, mean_of, sub, unit


def faces_around(draw, nodes, faces, untouched, radius):
    """Numbers of the faces at nodes within a radius of a random one that are connected with it; None if they reach
    nodes that are to stay untouched."""
    at = collections.defaultdict(list)
    for number, face in enumerate(faces):
        for node in face:
            at[node].append(number)
    first = draw.choice(sorted(at))
    inside, waiting = {first}, [first]
    while waiting:
        for number in at[waiting.pop()]:
            near = {node for node in faces[number] if math.dist(nodes[node], nodes[first]) < radius} - inside
            inside |= near
            waiting += near
    around = {number for node in inside for number in at[node]}
    return None if untouched & {node for number in around for node in faces[number]} else around


def largest_part(faces):
    """Of the faces, by edges."""
    joined = parts_of(faces)
    most = collections.Counter(joined).most_common(1)[0][0]
    return [face for face, part in zip(faces, joined) if part == most]


def parts_of(faces):
    """Per face the number of a face that it is joined with by edges, the same for all of a part."""
    part = list(range(len(faces)))

    def top(k):
        while part[k] != k:
            part[k] = part[part[k]]
            k = part[k]
        return k

    seen = {}
    for k, face in enumerate(faces):
        for edge in zip(face, face[1:] + face[:1]):
            part[top(k)] = top(seen.setdefault(frozenset(edge), k))
    return [top(k) for k in range(len(faces))]


def with_holes(draw, shape):
    """The faces that are left where one to three holes were cut, a third of them with spikes on the rim; None if a hole
    would reach the boundary, or part the shape."""
    faces = shape.faces
    for _ in range(draw.choice((1, 1, 2, 3))):
        gone = faces_around(draw, shape.nodes, faces, set(shape.rim), log_uniform(draw, 1.2 * shape.edge, 0.15 * shape.size))
        if gone is None:
            return None
        if draw.random() < 1 / 3:
            rim = {node for k in gone for node in faces[k]}
            beside = [k for k, face in enumerate(faces) if k not in gone and not rim.isdisjoint(face) and set(shape.rim).isdisjoint(face)]
            gone |= {k for k in beside if draw.random() < 0.3}
        faces = [face for k, face in enumerate(faces) if k not in gone]
    left = largest_part(faces)
    is_whole = {node for face in left for node in face} >= set(shape.rim) and len(left) > 0.9 * len(faces) > 0.5 * len(shape.faces)
    return left if is_whole else None


def draw_hole_task(seed, number):
    """A surface, or a real mesh, with holes that are to be filled."""
    draw = random.Random(f"{seed} {number} holes")
    left = None
    while left is None:
        whole = draw_real_surface(draw) if draw.random() < 0.4 else draw_grid_surface(draw)
        left = with_holes(draw, whole)
    kept = sorted({node for face in left for node in face})
    number_of = {node: k for k, node in enumerate(kept)}
    noise = draw.uniform(0, 0.002) * whole.size if whole.family not in REAL and draw.random() < 1 / 3 else 0.0
    shape = Shape("surface", whole.family, [shaken(draw, whole.nodes[k], noise, False) for k in kept], [[number_of[k] for k in face] for face in left],
                  truth=whole.truth, radius=whole.radius, detail=whole.detail)
    task = Task(seed, number, shape)
    task.noise, task.how, task.command = noise, "holes", "fill"
    task.fixed, task.checks = set(range(len(kept))), (check_crossings,)
    own_rim = {number_of[node] for node in whole.rim if node in number_of}
    if own_rim:
        task.options += ["--at", ",".join(map(str, sorted(set(shape.rim) - own_rim)))]
    if draw.random() < 0.2:
        task.options += ["--fair-by", "bending"]
    missing = [face for face in whole.faces if not set(face) <= set(number_of) or [number_of[k] for k in face] not in shape.faces]
    task.check = lambda result: check_patches(result, whole, kept, missing, own_rim)
    task.files[task.input] = text_of(shape, shape.nodes, task.input)
    task.arguments = [task.command, task.input, "-o", task.output, *task.options, "--report", "report.json", "--quiet", "--threads", "1"]
    return task


def rim_outline(faces, places):
    """The vector area of a patch and the middle of its rim."""
    sides = {edge for face in faces for edge in zip(face, face[1:] + face[:1])}
    rim = [(places[a], places[b]) for a, b in sides if (b, a) not in sides]
    total = (0.0, 0.0, 0.0)
    for a, b in rim:
        total = add(total, cross(a, b))
    return total, mean_of([a for a, _ in rim])


def depth_below(outline, places):
    """How far places are from the plane of a rim."""
    area, middle = outline
    return max(abs(dot(sub(place, middle), unit(area))) for place in places)


def check_patches(result, whole, kept, missing, own_rim):
    """Checks that no hole is left, and how far patches are from what was cut out, and folded."""
    task, shape = result.task, result.task.shape
    times = collections.Counter(frozenset(edge) for face in result.faces for edge in zip(face, face[1:] + face[:1]))
    open_edges = [edge for edge, count in times.items() if count == 1 and not edge <= own_rim]
    if open_edges:
        result.blame(BASIC, f"{len(open_edges)} edges are at a hole")
    crowded = sum(count > 2 for count in times.values())
    if crowded:
        result.blame(BASIC, f"{crowded} edges of more than two faces")
    new = result.faces[len(shape.faces):]
    patches = collections.defaultdict(list)
    for face, part in zip(new, parts_of(new)):
        patches[part].append(face)
    gone = collections.defaultdict(set)
    for face, part in zip(missing, parts_of(missing)):
        gone[part].update(face)
    off = result.figures["patches"] = []
    for faces in patches.values():
        nodes = {node for face in faces for node in face}
        rim = {node for node in nodes if node < len(shape.nodes)}
        places = [mean_of([result.nodes[node] for node in face]) for face in faces] + [result.nodes[node] for node in nodes - rim]
        across = diagonal_of([result.nodes[node] for node in rim])
        far = max(map(shape.truth, places))
        # Noise tilts the faces at the rim; curvature changes by up to its greatest.
        most = (0.03 + task.noise / shape.edge) * across + across ** 2 / (16 * shape.radius)
        if shape.family in REAL:
            opposite = [whole.nodes[node] for part in gone.values() if not part.isdisjoint(kept[k] for k in rim) for node in part]
            most = 0.08 * across + 0.5 * depth_below(rim_outline(faces, result.nodes), opposite)
        off.append([far / across, most / across])
        if far > most:
            result.blame(QUALITY, f"a patch {across:.3g} wide is {far:.3g} from what was cut out, {most:.3g} allowed")
    of = lambda faces: types.SimpleNamespace(faces=faces, edge=shape.edge, family=shape.family)
    # A hole of three edges has one triangle, whatever way that faces.
    chosen = shape.faces + [face for faces in patches.values() if len(faces) > 1 for face in faces]
    turned_over, empty = (after - before for after, before in zip(folds(of(chosen), result.nodes), folds(of(shape.faces), shape.nodes)))
    # Faces beside the hole may be folded already.
    cut_out = folds(of(whole.faces), whole.nodes)[0] - folds(of([whole.faces[k] for k in range(len(whole.faces)) if whole.faces[k] not in missing]), whole.nodes)[0]
    result.figures["folds"] = [cut_out, turned_over]
    if turned_over > cut_out:
        result.blame(BASIC, f"{turned_over} folds in patches")
    if empty > 0:
        result.blame(BASIC, f"{empty} faces without area in patches")
