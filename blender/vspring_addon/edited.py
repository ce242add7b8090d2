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
    """vertices: (n, 3) float32. faces: corners and offsets. selected: the mask of vertices."""

    def __init__(self, thing):
        thing.update_from_editmode()
        self.object, self.mesh = thing, thing.data
        if self.mesh.shape_keys is None:
            self.vertices = _column(self.mesh.vertices, "co", np.float32, 3).reshape(-1, 3)
        else:
            # The mesh has the coordinates of the basis, whichever key is edited.
            made = bmesh.from_edit_mesh(self.mesh)
            self.vertices = np.fromiter((part for vertex in made.verts for part in vertex.co), np.float32).reshape(-1, 3)
        self.faces = (_column(self.mesh.loops, "vertex_index"),
                      np.append(_column(self.mesh.polygons, "loop_start"), len(self.mesh.loops)).astype(np.int32))
        self.selected = _column(self.mesh.vertices, "select", bool)

    @property
    def edges(self):
        """(m, 2)."""
        return _column(self.mesh.edges, "vertices", columns=2).reshape(-1, 2)

    @property
    def selected_edges(self):
        """The mask of edges."""
        return _column(self.mesh.edges, "select", bool)

    def group(self, name):
        """The mask of the vertices with a weight in a vertex group; of none without a name."""
        if not name:
            return np.zeros(len(self.vertices), bool)
        group = self.object.vertex_groups.get(name)
        if group is None:
            raise Refused(f"{self.object.name}: it has no vertex group “{name}”")
        made = bmesh.from_edit_mesh(self.mesh)
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
        """A Mirror for each axis that the mesh is mirrored at while it is edited."""
        axes = [axis for axis, on in enumerate((self.mesh.use_mirror_x, self.mesh.use_mirror_y, self.mesh.use_mirror_z)) if on]
        if not axes:
            return []
        tree = mathutils.kdtree.KDTree(len(self.vertices))
        for index, place in enumerate(self.vertices.tolist()):
            tree.insert(place, index)
        tree.balance()
        return [Mirror(self.vertices, tree, axis) for axis in axes]

    def is_edited_still(self):
        """Whether it is in Edit Mode, with as many vertices."""
        return self.object.mode == 'EDIT' and len(bmesh.from_edit_mesh(self.mesh).verts) == len(self.vertices)

    def put(self, positions):
        """Moves the vertices that are elsewhere, and nothing else of the mesh. Returns how many these are."""
        moved = np.flatnonzero((positions != self.vertices).any(axis=1))
        made = bmesh.from_edit_mesh(self.mesh)
        made.verts.ensure_lookup_table()
        vertices = [made.verts[index] for index in moved.tolist()]
        for vertex, place in zip(vertices, positions[moved].tolist()):
            vertex.co = place
        if 8 * len(moved) > len(self.vertices):
            made.normal_update()
        else:
            faces = {face for vertex in vertices for face in vertex.link_faces}
            for face in faces:
                face.normal_update()
            for vertex in {vertex for face in faces for vertex in face.verts}:
                vertex.normal_update()
        bmesh.update_edit_mesh(self.mesh, loop_triangles=True, destructive=False)
        return len(moved)

    def _mask(self, nodes):
        mask = np.zeros(len(self.vertices), bool)
        mask[nodes] = True
        return mask


class Mirror:
    """Partners of vertices across a plane through the object's origin. axis: what the plane is at right angles to."""

    def __init__(self, vertices, tree, axis):
        self.vertices, self.tree, self.axis = vertices, tree, axis

    def partners(self, nodes):
        """For each of some vertices its partner; -1 without one."""
        images = self.vertices[nodes]
        images[:, self.axis] *= -1
        found = (self.tree.find(place) for place in images.tolist())
        return np.fromiter((index if distance <= PAIRED else -1 for _, index, distance in found), np.int64)


def on_both_sides(mask, mirrors):
    """With the partners of its vertices."""
    mask = mask.copy()
    for mirror in mirrors:
        partners = mirror.partners(np.flatnonzero(mask))
        mask[partners[partners >= 0]] = True
    return mask


def made_even(positions, moving, mirrors):
    """Moving vertices and their partners at mirror images of each other: at the middle of where they are and where they should be."""
    for mirror in mirrors:
        nodes = np.flatnonzero(moving)
        partners = mirror.partners(nodes)
        nodes, partners = nodes[partners >= 0], partners[partners >= 0]
        image = positions[partners]
        image[:, mirror.axis] *= -1
        positions[nodes] = (positions[nodes] + image) / 2
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
