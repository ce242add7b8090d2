"""Files as they come: masks of voxels, seams, coordinates that are far away or in single precision."""
import itertools
import math
import struct

from ordinary.checks import BASIC, QUALITY
from ordinary.shapes import Shape, draw_grid_surface
from ordinary.tasks import Task, shaken
from ordinary.vectors import add, cross, dot, mean_of, root_mean_square, sub, unit


def voxels_inside(inside, size, reach):
    """Voxels of a size whose middles are inside, as places of the grid."""
    most = [math.ceil(reach / length) + 1 for length in size]
    middle = lambda at: tuple((k + 0.5) * length for k, length in zip(at, size))
    return {at for at in itertools.product(*(range(-m, m) for m in most)) if inside(middle(at))}


def with_a_twin(cells):
    """These voxels and a copy of them that touches them along edges only."""
    beside = ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))
    near = {add(at, step) for at in cells for step in beside} | cells
    across = {add(at, step) for at in cells for step in ((1, 1, 0), (1, -1, 0), (-1, 1, 0), (-1, -1, 0))} - near
    wide = [max(at[axis] for at in cells) - min(at[axis] for at in cells) + 1 for axis in range(2)]
    for shift in itertools.product(range(1, wide[0] + 1), range(1, wide[1] + 1)):
        twin = {add(at, (*shift, 0)) for at in cells}
        if not twin & near and twin & across:
            return cells | twin
    return cells


def sides_of_voxels(material, size):
    """Nodes and quads of the common sides of cells of different materials, facing from the greater; empty cells are of
    material 0."""
    nodes, faces = {}, []
    for at in sorted(material):
        for axis, side in itertools.product(range(3), (0, 1)):
            if material.get(tuple(k + (n == axis) * (2 * side - 1) for n, k in enumerate(at)), 0) >= material[at]:
                continue
            corners = [tuple(k + (side if n == axis else u if n == (axis + 1) % 3 else v) for n, k in enumerate(at))
                       for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))]
            faces.append([nodes.setdefault(corner, len(nodes)) for corner in (corners if side else corners[::-1])])
    return [tuple(k * length for k, length in zip(at, size)) for at in nodes], faces


MASKS = {
    "ball": lambda r: lambda p: math.hypot(*p) - r,
    "ring": lambda r: lambda p: math.hypot(math.hypot(p[0], p[1]) - 2 * r / 3, p[2]) - r / 3,
    "box": lambda r: lambda p: box_distance(p, (r, 0.7 * r, 0.5 * r)),
    "tilted box": lambda r: lambda p: box_distance((0.94 * p[0] + 0.34 * p[2], p[1], 0.94 * p[2] - 0.34 * p[0]), (0.7 * r, 0.5 * r, 0.4 * r)),
}


def box_distance(p, half):
    beyond = [abs(x) - h for x, h in zip(p, half)]
    return math.hypot(*(max(b, 0) for b in beyond)) + min(max(beyond), 0)


def volume(nodes, faces):
    return math.fsum(dot(nodes[face[0]], cross(nodes[face[k]], nodes[face[k + 1]])) / 6 for face in faces for k in range(1, len(face) - 1))


def draw_mask(draw, touching=False, halves=False):
    """A mask whose steps are to be removed: if asked for, two equal bodies that touch along an edge, or one of two
    materials."""
    name = draw.choice(list(MASKS))
    size = (1.0, 1.0, draw.choice((1.0, 1.0, draw.uniform(1.3, 3))))
    radius = draw.uniform(12, 20) if name == "ring" else draw.uniform(7, 14)
    middle = tuple(draw.uniform(0, 1) for _ in range(3))
    truth = (lambda of: lambda p: abs(of(sub(p, middle))))(MASKS[name](radius))
    cells = voxels_inside(lambda p: MASKS[name](radius)(sub(p, middle)) < 0, size, radius + 2)
    material = dict.fromkeys(with_a_twin(cells) if touching else cells, 1)
    if halves:
        way, height = unit(tuple(draw.gauss(0, 1) for _ in range(3))), draw.uniform(-0.3, 0.3) * radius
        plane = lambda p: abs(dot(way, p) - height)
        for at in material:
            material[at] += dot(way, tuple((k + 0.5) * length for k, length in zip(at, size))) > height
        truth = (lambda of: lambda p: min(of(p), plane(p)))(truth)
    nodes, faces = sides_of_voxels(material, size)
    shape = Shape("surface", "materials" if halves else "touching masks" if touching else "masks", nodes, faces, truth=truth, radius=radius / 3,
                  detail=f"{name}, voxels of 1 x 1 x {size[2]:.2g}")
    task = Task("", 0, shape)
    task.how, task.points = "noise auto", list(nodes)
    task.options = [draw.choice(("--noise", "--within")), "auto"]

    def check(result):
        before, after = (volume(places, faces) for places in (nodes, result.nodes))
        if not touching and not halves and abs(after / before - 1) > 1e-3:
            result.blame(QUALITY, f"volume {100 * (after / before - 1):.3g} %")
        far = [math.dist(p, q) for p, q in zip(nodes, result.nodes)]
        if max(far) > math.hypot(*size):
            result.blame(QUALITY, f"a node moves by {max(far):.3g}, across the whole of a voxel")
        off, was = (root_mean_square(map(truth, places)) for places in (result.nodes, nodes))
        if not touching and off > (0.5 if "box" not in name else 1.1) * was:
            result.blame(QUALITY, f"{off:.3g} from the true shape, {was:.3g} before")
    task.check = check
    return task


def draw_seam(draw):
    """A patch whose nodes are doubled along a seam, with the normals of one surface."""
    while True:
        shape = draw_grid_surface(draw)
        if shape.directions and all(len(face) == 4 for face in shape.faces):
            break
    axis = draw.randrange(3)
    middle = mean_of(shape.nodes)[axis]
    far = [mean_of([shape.nodes[k] for k in face])[axis] > middle for face in shape.faces]
    twins = sorted({k for face, is_far in zip(shape.faces, far) if is_far for k in face}
                   & {k for face, is_far in zip(shape.faces, far) if not is_far for k in face})
    double = {k: len(shape.nodes) + n for n, k in enumerate(twins)}
    nodes = shape.nodes + [shape.nodes[k] for k in twins]
    faces = [[double.get(k, k) if is_far else k for k in face] for face, is_far in zip(shape.faces, far)]
    noise = draw.uniform(0, 0.003) * shape.size
    places = [shaken(draw, node, 0 if k in set(shape.rim) else noise, False) for k, node in enumerate(shape.nodes)]
    split = Shape("surface", "seams", [*places, *(places[k] for k in twins)], faces, truth=shape.truth, radius=shape.radius, detail=shape.detail)
    task = Task("", 0, split)
    task.exact, task.noise, task.how, task.options = nodes, noise, "plain", ["--weld", "0"]
    task.fixed = {n for n, k in enumerate([*range(len(places)), *twins]) if k in set(shape.rim)}
    directions = shape.directions + [shape.directions[k] for k in twins]
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in split.nodes] + [f"vn {x!r} {y!r} {z!r}" for x, y, z in directions]
    lines += ["f " + " ".join(f"{k + 1}//{k + 1}" for k in face) for face in faces]
    task.files["input.obj"] = "\n".join(lines) + "\n"

    def check(result):
        normals = [tuple(map(float, line.split()[1:4])) for line in (result.folder / task.output).read_text().splitlines()
                   if line.startswith("vn ")]
        apart = [math.dist(normals[k], normals[double[k]]) for k in twins]
        if apart and max(apart) > 1e-6:
            result.blame(BASIC, f"{sum(d > 1e-6 for d in apart)} of {len(twins)} normals differ across the seam, by up to {max(apart):.3g}")
    task.check = check
    return task


def draw_far(draw, single=False):
    """A patch at coordinates of a million of its edges, in double or single precision."""
    shape = draw_grid_surface(draw)
    away = [draw.uniform(-1, 1) * (3e4 if single else 1e6) * shape.edge for _ in range(3)]
    rounded = (lambda x: struct.unpack("f", struct.pack("f", x))[0]) if single else float
    noise = draw.uniform(0, 0.003) * shape.size
    task_nodes = [tuple(rounded(x + a) for x, a in zip(shaken(draw, node, 0 if k in set(shape.rim) else noise, False), away))
                  for k, node in enumerate(shape.nodes)]
    moved = Shape("surface", "single precision" if single else "far away", task_nodes, shape.faces,
                  truth=lambda point: shape.truth(sub(point, away)), radius=shape.radius, detail=shape.detail)
    task = Task("", 0, moved)
    task.exact, task.noise, task.how = [add(node, away) for node in shape.nodes], noise, "plain"
    if single:
        task.input, task.output = "input.ply", "out.ply"
        header = "".join(f"property float {axis}\n" for axis in "xyz")
        rows = [" ".join(f"{x!r}" for x in node) for node in task_nodes] + [" ".join(map(str, [len(f), *f])) for f in shape.faces]
        task.files["input.ply"] = (f"ply\nformat ascii 1.0\nelement vertex {len(task_nodes)}\n{header}element face {len(shape.faces)}\n"
                                   "property list uchar int vertex_indices\nend_header\n" + "\n".join(rows) + "\n")
    return task


MET = {"masks": draw_mask, "touching masks": lambda draw: draw_mask(draw, touching=True),
       "materials": lambda draw: draw_mask(draw, halves=True), "seams": draw_seam, "far away": draw_far,
       "single precision": lambda draw: draw_far(draw, single=True)}
