"""Halves of surfaces that end in a plane, and symmetric wholes."""
import collections
import math
import random

from ordinary.checks import HARD, QUALITY, vector_area
from ordinary.files import text_of
from ordinary.shapes import Shape, draw_grid_surface
from ordinary.tasks import HOW, Task, shaken
from ordinary.vectors import dot, unit


def mirrored(node):
    return (node[0], -node[1], node[2])


def seam_of(shape):
    """Edges in the plane y = 0, each with its face."""
    lies = lambda k: shape.nodes[k][1] == 0
    return [(face, a, b) for face in shape.faces for a, b in zip(face, face[1:] + face[:1]) if lies(a) and lies(b)]


def rim_beside_plane(shape):
    """Nodes of boundary edges that do not lie in the plane."""
    seam = {frozenset((a, b)) for _, a, b in seam_of(shape)}
    count = collections.Counter(frozenset(edge) for face in shape.faces for edge in zip(face, face[1:] + face[:1]))
    return sorted({k for edge, faces in count.items() if faces == 1 and edge not in seam for k in edge})


def with_mirror_image(half):
    """The whole of a half, as faces and nodes, and the mirror image of each node."""
    nodes, image = list(half.nodes), list(range(len(half.nodes)))
    for k, node in enumerate(half.nodes):
        if node[1] != 0:
            image[k] = len(nodes)
            image.append(k)
            nodes.append(mirrored(node))
    faces = half.faces + [[image[k] for k in reversed(face)] for face in half.faces]
    return nodes, faces, image


HALVES = ["plain", "plain", "normals", "exact normals", "within", "rms", "length", "weight", "fit"]


def draw_half_task(seed, number):
    """Half a surface, or a whole one, by --symmetry."""
    draw = random.Random(f"{seed} {number} halves")
    shape = draw_grid_surface(draw, half=True)
    is_half = draw.random() < 0.75
    image = None
    if not is_half:
        nodes, faces, image = with_mirror_image(shape)
        directions = shape.directions + [mirrored(shape.directions[k]) for n, k in enumerate(image) if n >= len(shape.nodes)]
        shape = Shape("surface", shape.family, nodes, faces, directions=directions, truth=shape.truth, fair=shape.fair, radius=shape.radius,
                      sample=shape.sample, another=shape.another, detail=shape.detail)
    else:
        shape.rim = rim_beside_plane(shape)
    shape.detail += ", half" if is_half else ", whole"
    task = Task(seed, number, shape)
    if draw.random() > 1 / 3:
        task.noise = draw.uniform(0, 0.005) * shape.size
    on_plane = {k for k, node in enumerate(shape.nodes) if node[1] == 0}
    task.how = draw.choice(HALVES if shape.rim else ["within", "rms", "length", "weight", "fit"])
    for k, node in enumerate(shape.nodes):
        if k not in task.fixed:
            x, y, z = shaken(draw, node, task.noise, False)
            shape.nodes[k] = (x, 0.0 if is_half and k in on_plane else y, z)
    HOW[task.how](draw, task)
    task.options += ["--symmetry", "y"]
    task.files[task.input] = text_of(shape, shape.nodes, task.input)
    task.arguments = [task.command, task.input, "-o", task.output, *task.options, "--report", "report.json", "--quiet", "--threads", "1"]

    def check(result):
        off = [k for k in on_plane if result.nodes[k][1] != 0]
        if off:
            result.blame(HARD, f"{len(off)} nodes left the plane, node {off[0]} first")
        if is_half:
            check_seam(result)
        else:
            apart = [k for k, other in enumerate(image) if result.nodes[other] != mirrored(result.nodes[k])]
            if apart:
                result.blame(HARD, f"{len(apart)} nodes are no mirror images, node {apart[0]} first")
    task.check = check
    return task


def check_seam(result):
    """The shape must not turn more where it meets its mirror image than it does elsewhere, or did before."""
    shape = result.task.shape

    def turns(nodes):
        ways = [(unit(vector_area(nodes, face)), (a, b)) for face, a, b in seam_of(shape) if math.hypot(*vector_area(nodes, face)) > 0]
        return max((2 * math.degrees(math.asin(min(abs(way[1]), 1))) for way, _ in ways), default=0)

    def elsewhere(nodes):
        faces = collections.defaultdict(list)
        for face in shape.faces:
            if math.hypot(*vector_area(nodes, face)) > 0:
                for edge in zip(face, face[1:] + face[:1]):
                    faces[frozenset(edge)].append(unit(vector_area(nodes, face)))
        return max((math.degrees(math.acos(max(-1, min(dot(*pair), 1)))) for pair in faces.values() if len(pair) == 2), default=0)

    before, after, inside = turns(shape.nodes), turns(result.nodes), elsewhere(result.nodes)
    result.figures["seam"] = [before, after, inside]
    if after > 1.5 * max(before, inside) + 1:
        result.blame(QUALITY, f"turns by {after:.3g} degrees at the plane, {inside:.3g} elsewhere, {before:.3g} before")
