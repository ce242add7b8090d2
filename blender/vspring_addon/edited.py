"""The mesh of an object in Edit Mode as arrays, and back. Vertices go by their indices; coordinates are the object's own."""
import bmesh
import mathutils
import mathutils.bvhtree
import mathutils.interpolate
import mathutils.kdtree
import numpy as np

PAIRED = 2e-5
"""How far a vertex may be from the mirror image of another, in units of the object, as Blender's own tools have it."""


class Refused(Exception):
    """What a person has to change first."""


class EditedMesh:
    """vertices: (n, 3) float32. faces: corners and offsets. edges: (m, 2). selected: of vertices, selected_edges: of edges."""

    def __init__(self, thing):
        thing.update_from_editmode()
        self.object, mesh = thing, thing.data
        # The mesh has the coordinates of the basis where another shape key is edited.
        made = bmesh.from_edit_mesh(mesh)
        self.vertices = np.fromiter((part for vertex in made.verts for part in vertex.co), np.float32).reshape(-1, 3)
        self.faces = _column(mesh.loops, "vertex_index"), np.append(_column(mesh.polygons, "loop_start"), len(mesh.loops)).astype(np.int32)
        self.edges = _column(mesh.edges, "vertices", columns=2).reshape(-1, 2)
        self.selected = _column(mesh.vertices, "select", bool)
        self.selected_edges = _column(mesh.edges, "select", bool)

    def group(self, name):
        """The mask of the vertices with a weight in a vertex group; of none without a name."""
        if not name:
            return np.zeros(len(self.vertices), bool)
        group = self.object.vertex_groups.get(name)
        if group is None:
            raise Refused(f"{self.object.name}: it has no vertex group “{name}”")
        made = bmesh.from_edit_mesh(self.object.data)
        layer = made.verts.layers.deform.active
        if layer is None:
            return np.zeros(len(self.vertices), bool)
        return np.fromiter((vertex[layer].get(group.index, 0) > 0 for vertex in made.verts), bool)

    def faces_at(self, nodes):
        """The faces that have a vertex of a mask."""
        corners, offsets = self.faces
        sizes = np.diff(offsets)
        kept = np.logical_or.reduceat(nodes[corners], offsets[:-1]) if len(sizes) else np.zeros(0, bool)
        return corners[np.repeat(kept, sizes)], np.append(0, np.cumsum(sizes[kept])).astype(np.int32)

    def rim(self, moving):
        """The mask of what does not move, in faces that have a vertex that does."""
        return self._mask(self.faces_at(moving)[0]) & ~moving

    def mirrors(self):
        """For each axis that the mesh is mirrored at while it is edited, the axis and every vertex's partner; -1 without one."""
        mesh = self.object.data
        axes = [axis for axis, on in enumerate((mesh.use_mirror_x, mesh.use_mirror_y, mesh.use_mirror_z)) if on]
        if not axes:
            return []
        tree = mathutils.kdtree.KDTree(len(self.vertices))
        for index, place in enumerate(self.vertices):
            tree.insert(place, index)
        tree.balance()
        return [(axis, self._partners(tree, axis)) for axis in axes]

    def _partners(self, tree, axis):
        images = self.vertices.copy()
        images[:, axis] *= -1
        found = (tree.find(place) for place in images)
        return np.fromiter((index if distance <= PAIRED else -1 for _, index, distance in found), np.int64)

    def put(self, positions):
        """Moves the vertices that are elsewhere, and nothing else of the mesh. Returns how many these are."""
        moved = np.flatnonzero((positions != self.vertices).any(axis=1))
        mesh = self.object.data
        made = bmesh.from_edit_mesh(mesh)
        made.verts.ensure_lookup_table()
        for index, place in zip(moved.tolist(), positions[moved].tolist()):
            made.verts[index].co = place
        made.normal_update()
        bmesh.update_edit_mesh(mesh, loop_triangles=True, destructive=False)
        return len(moved)

    def _mask(self, nodes):
        mask = np.zeros(len(self.vertices), bool)
        mask[nodes] = True
        return mask


def on_both_sides(mask, mirrors):
    """With the partners of its vertices."""
    mask = mask.copy()
    for _, partner in mirrors:
        mask[partner[mask & (partner >= 0)]] = True
    return mask


def made_even(positions, moving, mirrors):
    """Moving vertices and their partners at mirror images of each other: at the middle of where they are and where they should be."""
    for axis, partner in mirrors:
        paired = moving & (partner >= 0)
        image = positions[partner[paired]]
        image[:, axis] *= -1
        positions[paired] = (positions[paired] + image) / 2
    return positions


def as_typed(value):
    """A number of a panel, which Blender keeps in single precision, as it was typed: 0.1, not 0.10000000149."""
    return float(str(np.float32(value)))


def points_of(thing, context):
    """The vertices of another object with its modifiers, and their normals where it has faces; in coordinates of the world."""
    shown = thing.evaluated_get(context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    points = _column(mesh.vertices, "co", np.float32, 3).reshape(-1, 3).astype(float)
    normals = _column(mesh.vertices, "normal", np.float32, 3).reshape(-1, 3).astype(float) if len(mesh.polygons) else None
    shown.to_mesh_clear()
    matrix = np.array(thing.matrix_world)
    return points @ matrix[:3, :3].T + matrix[:3, 3], None if normals is None else turned(normals, matrix)


def turned(normals, matrix):
    """Normals where a matrix takes them; unit length, zero where they are zero."""
    found = normals @ np.linalg.inv(matrix[:3, :3])
    length = np.linalg.norm(found, axis=1, keepdims=True)
    return np.divide(found, length, out=np.zeros_like(found), where=length > 0)


def normals_from(thing, edited, nodes, context):
    """The normals of another object as they are shaded, where it is nearest to vertices of an edited mesh; in that one's
    coordinates."""
    shown = thing.evaluated_get(context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    mesh.calc_loop_triangles()
    triangles = _column(mesh.loop_triangles, "vertices", columns=3).reshape(-1, 3)
    if not len(triangles):
        raise Refused(f"{thing.name} has no faces that could give normals")
    polygons = _column(mesh.loop_triangles, "polygon_index")
    places, normals = (_column(mesh.vertices, name, np.float32, 3).reshape(-1, 3) for name in ("co", "normal"))
    flat, is_smooth = _column(mesh.polygons, "normal", np.float32, 3).reshape(-1, 3), _column(mesh.polygons, "use_smooth", bool)
    shown.to_mesh_clear()
    tree = mathutils.bvhtree.BVHTree.FromPolygons(places.tolist(), triangles.tolist(), all_triangles=True)
    to_other = thing.matrix_world.inverted() @ edited.object.matrix_world
    found = []
    for place in edited.vertices[nodes]:
        at, _, index, _ = tree.find_nearest(to_other @ mathutils.Vector(place))
        corners, polygon = triangles[index], polygons[index]
        share = mathutils.interpolate.poly_3d_calc([mathutils.Vector(corner) for corner in places[corners]], at)
        found.append(share @ normals[corners].astype(float) if is_smooth[polygon] else flat[polygon])
    return turned(np.array(found, float).reshape(-1, 3), np.array(to_other.inverted()))


def _column(things, name, dtype=np.int32, columns=1):
    values = np.empty(len(things) * columns, dtype)
    things.foreach_get(name, values)
    return values
