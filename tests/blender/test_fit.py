"""Fit to Object, and Smooth within Distance."""
import bpy
import numpy as np
from mathutils.bvhtree import BVHTree
from support import Case, grid, module, within

fit, smooth = bpy.ops.mesh.vspring_fit, bpy.ops.mesh.vspring_smooth


class Fitted(Case):
    def parts(self):
        """A flat grid in Edit Mode, and above it a scan that stands and is turned elsewhere: the object and its vertices."""
        flat, faces = grid(noise=0)
        flat[:, 2] = 0
        x, y = np.random.default_rng(4).uniform(-1, 1, (2, 4000))
        scan = self.add(np.column_stack([x, y, 0.3 - 0.3 * x * x]), name="Scan")
        sheet = self.add(flat, faces, name="Sheet")
        for thing in (scan, sheet):
            thing.rotation_euler, thing.location, thing.scale = (0.5, 0.2, 1), (1, 2, 3), (2, 2, 2)
        bpy.context.view_layer.update()
        # The scan's numbers are of the world, the sheet's its own.
        scan.data.transform(scan.matrix_world)
        scan.matrix_world.identity()
        bpy.context.view_layer.update()
        self.edit(sheet, selected=[slice(None)])
        return sheet, flat, scan

    def misses(self, sheet):
        after = self.places(sheet)
        inner = within(after, 0.7)
        return np.abs(after[inner, 2] - (0.3 - 0.3 * after[inner, 0] ** 2))

    def test_named_or_selected(self):
        sheet, flat, scan = self.parts()
        self.assert_refused("select it besides", fit)
        fit('EXEC_DEFAULT', True, other="Scan")
        named = self.places(bpy.context.edit_object)
        self.assertLess(self.misses(bpy.context.edit_object).max(), 0.1)
        bpy.ops.ed.undo()
        self.assertLess(np.abs(self.places(bpy.context.edit_object)[:, 2]).max(), 1e-6)
        bpy.data.objects["Scan"].select_set(True)
        fit('EXEC_DEFAULT', True)
        self.assert_same_bits(self.places(bpy.context.edit_object), named)

    def test_length(self):
        sheet, flat, scan = self.parts()
        fit('EXEC_DEFAULT', True, other="Scan", length=0.02)
        near = self.misses(bpy.context.edit_object)
        bpy.ops.ed.undo()
        fit('EXEC_DEFAULT', True, other="Scan", length=1)
        self.assertLess(near.max(), 0.02)
        self.assertGreater(self.misses(bpy.context.edit_object).max(), 0.05)

    def test_modifiers_count(self):
        sheet, flat, scan = self.parts()
        scan.modifiers.new("Off", 'DISPLACE').strength = 0
        scan.modifiers.new("Half", 'MASK').vertex_group = scan.vertex_groups.new(name="None").name
        self.assert_refused("Scan has no vertices", fit, other="Scan")


class Smoothed(Case):
    def ball(self, noise=0.01):
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4, radius=1)
        thing = bpy.context.object
        places = np.array([v.co[:] for v in thing.data.vertices])
        places = (places + noise * np.random.default_rng(1).standard_normal(places.shape)).astype(np.float32)
        thing.data.vertices.foreach_set("co", places.ravel())
        faces = np.array([face.vertices[:] for face in thing.data.polygons])
        return thing, places, faces

    def test_estimated_noise(self):
        thing, places, faces = self.ball()
        self.edit(thing, selected=[slice(None)])
        smooth()
        after = self.places(thing)
        self.assert_same_bits(after, module().fair(places, faces, noise="auto").positions)
        off = [np.sqrt(np.mean((np.linalg.norm(one, axis=1) - 1) ** 2)) for one in (places, after)]
        self.assertLess(off[1], off[0] / 2.5)

    def test_distance(self):
        thing, places, faces = self.ball()
        half = places[:, 2] > 0
        self.edit(thing, selected=[half])
        smooth(by='DISTANCE', within=0.02)
        after = self.places(thing)
        tree = BVHTree.FromPolygons(after.tolist(), faces.tolist())
        away = max(tree.find_nearest(place)[3] for place in places.tolist())
        self.assertLess(away, 0.0202)
        self.assertGreater(away, 0.01)
        self.assert_same_bits(after[~half], places[~half])

    def test_no_noise(self):
        vertices, faces = grid(noise=0)
        vertices[:, 2] = 0
        thing = self.add(vertices, faces)
        self.edit(thing, selected=[slice(None)])
        self.assert_refused("no noise.*Choose Distance", smooth)
