"""Measure Curvature."""
import bpy
import numpy as np
from support import Case, module, told

measure = bpy.ops.mesh.vspring_measure


class Measured(Case):
    def test_sphere(self):
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4, radius=2)
        thing = bpy.context.object
        before = np.array([v.co[:] for v in thing.data.vertices], np.float32)
        self.edit(thing)
        for kind, expected in (('mean', 0.5), ('gaussian', 0.25), ('k1', 0.5), ('k2', 0.5)):
            with told() as lines:
                measure(kind=kind)
            self.assertIn("Colours go from", lines[0])
            bpy.ops.object.mode_set(mode='OBJECT')
            values = np.empty(len(thing.data.vertices), np.float32)
            thing.data.attributes["curvature"].data.foreach_get("value", values)
            np.testing.assert_allclose(values, expected, atol=2e-3)
            bpy.ops.object.mode_set(mode='EDIT')
        self.assert_same_bits(self.places(thing), before)

    def test_colours(self):
        """Those of the module, as a person sees them; the attribute is the active one."""
        bpy.ops.mesh.primitive_torus_add(major_segments=48, minor_segments=24)
        thing = bpy.context.object
        thing.data.attributes.active_color = thing.data.attributes.new("Paint", 'FLOAT_COLOR', 'POINT')
        self.edit(thing)
        measure(kind='gaussian')
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assertEqual(thing.data.attributes.active_color.name, "Curvature")
        seen = np.empty(4 * len(thing.data.vertices), np.float32)
        thing.data.attributes["Curvature"].data.foreach_get("color_srgb", seen)
        places = np.array([v.co[:] for v in thing.data.vertices], np.float32)
        faces = [list(face.vertices) for face in thing.data.polygons]
        expected, _ = module().colours(module().curvatures(places, faces).gaussian, about=0)
        np.testing.assert_allclose(seen.reshape(-1, 4)[:, :3], expected, atol=1e-3)
        outer, inner = np.linalg.norm(places[:, :2], axis=1).argmax(), np.linalg.norm(places[:, :2], axis=1).argmin()
        self.assertGreater(expected[outer, 0], expected[outer, 2])  # orange
        self.assertGreater(expected[inner, 2], expected[inner, 0])  # violet

    def test_colours_are_spread_over_the_selection(self):
        bpy.ops.mesh.primitive_torus_add(major_segments=48, minor_segments=24)
        thing = bpy.context.object
        places = np.array([v.co[:] for v in thing.data.vertices], np.float32)
        outside = np.linalg.norm(places[:, :2], axis=1) > 1.1
        self.edit(thing, selected=[outside])
        with told() as lines:
            measure()
        bends = module().curvatures(places, [list(face.vertices) for face in thing.data.polygons]).mean
        low, high = np.quantile(bends[outside], [0.02, 0.98])
        self.assertIn(f"from {low:.4g} to {high:.4g}", lines[0])

    def test_again_and_undo(self):
        bpy.ops.mesh.primitive_torus_add()
        thing = bpy.context.object
        self.edit(thing)
        measure('EXEC_DEFAULT', True)
        measure('EXEC_DEFAULT', True)
        bpy.ops.ed.undo()
        bpy.ops.ed.undo()
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assertNotIn("curvature", bpy.context.object.data.attributes)
