"""Fair: what moves, what holds, and that all else stays."""
import bmesh
import bpy
import numpy as np
from support import Case, grid, module, told, within

fair = bpy.ops.mesh.vspring_fair


class SameAsTheModule(Case):
    def test_region(self):
        thing, vertices, faces, chosen = self.edited_patch()
        fair()
        after = self.places(thing)
        self.assert_same_bits(after, module().fair(vertices, faces, region=chosen).positions)
        self.assert_same_bits(after[~chosen], vertices[~chosen])
        self.assertTrue((after[chosen] != vertices[chosen]).any(axis=1).all())
        before, now = (module().measure(places, faces, fix=~chosen).bending_energy for places in (vertices, after))
        self.assertLess(now, before / 2)

    def test_all_of_a_surface_with_a_boundary(self):
        thing, vertices, faces, chosen = self.edited_patch(reach=2)
        fair()
        self.assert_same_bits(self.places(thing), module().fair(vertices, faces, region=chosen).positions)

    def test_faces_of_any_kind(self):
        vertices, faces = grid()
        mixed = [faces[0, :3].tolist(), faces[0, [0, 2, 3]].tolist(), [*faces[1, :2].tolist(), *faces[1, 2:].tolist()], *faces[2:].tolist()]
        # A hexagon from two quads in the middle.
        left, right = faces[66].tolist(), faces[67].tolist()
        mixed = [face for face in mixed if face not in (left, right)] + [[left[0], left[1], right[1], right[2], right[3], left[3]]]
        thing = self.add(vertices, mixed)
        used = np.zeros(len(vertices), bool)
        used[np.concatenate(mixed)] = True
        chosen = within(vertices, 0.6) & used
        self.edit(thing, selected=[chosen])
        fair()
        corners, offsets = np.concatenate(mixed), np.cumsum([0, *map(len, mixed)])
        self.assert_same_bits(self.places(thing), module().fair(vertices, (corners, offsets), region=chosen).positions)
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assertEqual([list(face.vertices) for face in thing.data.polygons], mixed)

    def test_options(self):
        thing, vertices, faces, chosen = self.edited_patch()
        fair(least='bending', spacing='even', tolerance=1e-7)
        tolerance = np.float32(1e-7).item()  # as Blender has it
        self.assert_same_bits(self.places(thing), module().fair(vertices, faces, region=chosen, fair_by="bending", distribution="even",
                                                                tolerance=tolerance).positions)

    def test_face_select_mode(self):
        vertices, faces = grid()
        thing = self.add(vertices, faces)
        self.edit(thing)
        bpy.context.tool_settings.mesh_select_mode = (False, False, True)
        made = bmesh.from_edit_mesh(thing.data)
        made.faces.ensure_lookup_table()
        for index in (64, 65, 66):
            made.faces[index].select = True
        made.select_flush(True)
        bmesh.update_edit_mesh(thing.data)
        fair()
        self.assert_same_bits(self.places(thing), module().fair(vertices, faces, region=np.unique(faces[64:67])).positions)

    def test_hidden_surroundings_count(self):
        thing, vertices, faces, chosen = self.edited_patch()
        bpy.ops.mesh.hide(unselected=True)
        fair()
        self.assert_same_bits(self.places(thing), module().fair(vertices, faces, region=chosen).positions)


class Held(Case):
    def test_join_by_position_does_not_look_beyond(self):
        thing, vertices, faces, chosen = self.edited_patch()
        beyond = vertices.copy()
        far = ~within(vertices, 0.8)
        beyond[far, 2] += 1
        fair(join='POSITION')
        one = self.places(thing)
        other = self.add(beyond, faces)
        bpy.ops.object.mode_set(mode='OBJECT')
        self.edit(other, selected=[chosen])
        fair(join='POSITION')
        self.assert_same_bits(self.places(other)[chosen], one[chosen])
        bpy.ops.ed.undo()
        fair(join='TANGENT')
        self.assertGreater(np.abs(self.places(bpy.context.edit_object)[chosen] - one[chosen]).max(), 1e-3)

    def test_pins(self):
        vertices, faces = grid()
        vertices[84, 2] += 0.3
        thing = self.add(vertices, faces)
        chosen = within(vertices, 0.6)
        self.group(thing, "Pins", [84])
        self.edit(thing, selected=[chosen])
        fair(pins="Pins")
        after = self.places(thing)
        self.assert_same_bits(after[84], vertices[84])
        self.assert_same_bits(after, module().fair(vertices, faces, region=chosen, constraints=[{"nodes": [84], "position": "fixed"}]).positions)

    def test_normals_as_they_are(self):
        vertices, faces = grid()
        thing = self.add(vertices, faces)
        self.group(thing, "Level", [84])
        chosen = within(vertices, 0.6)
        self.edit(thing, selected=[chosen])
        fair(normals="Level")
        self.assert_same_bits(self.places(thing), module().fair(vertices, faces, region=chosen, constraints=[{"nodes": [84], "normal": "fixed"}]).positions)

    def test_normals_of_another_object(self):
        """A cap that is flat comes to the sphere whose normals its edge is given, wherever that stands."""
        flat, faces = grid(cells=16, noise=0)
        flat = flat.astype(float) * 0.6
        flat[:, 2] = 0
        rim = ~within(flat, 0.59)
        flat[rim, 2] = np.sqrt(1 - (flat[rim, :2] ** 2).sum(axis=1))
        thing = self.add(flat, faces, name="Cap")
        bpy.ops.mesh.primitive_uv_sphere_add(segments=128, ring_count=64, radius=2)
        bpy.ops.object.shade_smooth()
        sphere = bpy.context.object
        thing.scale, thing.location, sphere.location = (2, 2, 2), (3, 0, 0), (3, 0, 0)
        sphere.rotation_euler = (1, 0.3, 0)
        bpy.context.view_layer.update()
        self.edit(thing, selected=[~rim])
        sphere.select_set(True)
        fair(normals_from='OBJECT')
        radius = np.linalg.norm(self.places(thing), axis=1)
        self.assertLess(np.abs(radius - 1).max(), 2e-3)
        bpy.ops.ed.undo()
        fair()
        self.assertGreater(np.abs(np.linalg.norm(self.places(bpy.context.edit_object), axis=1) - 1).max(), 0.05)

    def test_open_edges(self):
        thing, vertices, faces, chosen = self.edited_patch(reach=2)
        fair(boundary='TANGENT')
        self.assert_same_bits(self.places(thing), module().fair(vertices, faces, region=chosen, fix_normals="boundary").positions)
        bpy.ops.ed.undo()
        thing = bpy.context.edit_object
        corners = (0, 12, 156, 168)
        self.select(thing, slice(None))
        bpy.ops.object.mode_set(mode='OBJECT')
        self.group(thing, "Corners", corners)
        bpy.ops.object.mode_set(mode='EDIT')
        fair(boundary='FAIR', pins="Corners")
        after = self.places(thing)
        self.assert_same_bits(after[list(corners)], vertices[list(corners)])
        self.assertGreater(np.abs(after[1:12] - vertices[1:12]).max(), 1e-3)

    def test_strength(self):
        thing, vertices, faces, chosen = self.edited_patch()
        whole = module().fair(vertices, faces, region=chosen).positions
        fair(strength=0.25)
        np.testing.assert_allclose(self.places(thing), vertices + 0.25 * (whole - vertices), atol=1e-7)
        self.assert_same_bits(self.places(thing)[~chosen], vertices[~chosen])

    def test_another_strength_computes_nothing(self):
        thing, vertices, faces, chosen = self.edited_patch()
        calls = []
        real, module().fair = module().fair, lambda *given, **options: calls.append(1) or real(*given, **options)
        self.addCleanup(setattr, module(), "fair", real)
        module().fair.__name__ = "fair"
        for strength in (1, 0.5, 0.2):
            fair('EXEC_DEFAULT', True, strength=strength)
            bpy.ops.ed.undo()
        self.assertEqual(len(calls), 1)
        fair(spacing='even')
        self.assertEqual(len(calls), 2)


class AllElseStays(Case):
    def test_undo_and_redo_are_one_step(self):
        thing, vertices, faces, chosen = self.edited_patch()
        fair('EXEC_DEFAULT', True)
        after = self.places(bpy.context.edit_object)
        self.assertFalse(np.array_equal(after, vertices))
        bpy.ops.ed.undo()
        self.assert_same_bits(self.places(bpy.context.edit_object), vertices)
        bpy.ops.ed.redo()
        self.assert_same_bits(self.places(bpy.context.edit_object), after)

    def test_uvs_groups_modifiers_and_selection(self):
        vertices, faces = grid()
        thing = self.add(vertices, faces)
        layer = thing.data.uv_layers.new(name="Map")
        layer.data.foreach_set("uv", np.linspace(0, 1, 2 * len(thing.data.loops)).astype(np.float32))
        thing.vertex_groups.new(name="Arm").add(list(range(20)), 0.3, 'REPLACE')
        thing.modifiers.new("Round", 'SUBSURF')
        thing.data.edges[5].use_seam = True
        chosen = within(vertices, 0.6)

        def kept():
            bpy.ops.object.mode_set(mode='OBJECT')
            mesh = thing.data
            found = ([tuple(loop.uv) for loop in mesh.uv_layers["Map"].data], [[(g.group, g.weight) for g in v.groups] for v in mesh.vertices],
                     [m.type for m in thing.modifiers], [e.use_seam for e in mesh.edges], [list(f.vertices) for f in mesh.polygons],
                     [v.select for v in mesh.vertices])
            bpy.ops.object.mode_set(mode='EDIT')
            return found

        self.edit(thing, selected=[chosen])
        before = kept()
        fair()
        self.assertFalse(np.array_equal(self.places(thing), vertices))
        self.assertEqual(kept(), before)

    def test_normals_follow(self):
        """Of few vertices that move, and of many."""
        for reach in (0.25, 0.9):
            thing, *_ = self.edited_patch(reach=reach, noise=0.05)
            fair()
            made = bmesh.from_edit_mesh(thing.data)
            found = [[one.normal[:] for one in ones] for ones in (made.faces, made.verts)]
            made.normal_update()
            for ones, others in zip(found, (made.faces, made.verts)):
                np.testing.assert_allclose(ones, [one.normal[:] for one in others], atol=1e-6)
            bpy.ops.object.mode_set(mode='OBJECT')

    def test_shape_keys(self):
        """The key that is edited moves; the basis stays."""
        vertices, faces = grid()
        thing = self.add(vertices, faces)
        thing.shape_key_add(name="Basis")
        key = thing.shape_key_add(name="Raised")
        raised = vertices + np.float32(0.1) * np.array([0, 0, 1], np.float32)
        raised[84, 2] += 0.2
        key.data.foreach_set("co", raised.ravel())
        thing.active_shape_key_index = 1
        chosen = within(vertices, 0.6)
        self.edit(thing, selected=[chosen])
        fair()
        bpy.ops.object.mode_set(mode='OBJECT')
        found = {}
        for name in ("Basis", "Raised"):
            found[name] = np.empty(vertices.size, np.float32)
            thing.data.shape_keys.key_blocks[name].data.foreach_get("co", found[name])
        self.assert_same_bits(found["Basis"], vertices.ravel())
        self.assert_same_bits(found["Raised"].reshape(-1, 3), module().fair(raised, faces, region=chosen).positions)

    def test_several_objects(self):
        one, two = (self.add(*grid(seed=seed), name=f"Part {seed}") for seed in (1, 2))
        before = [grid(seed=seed)[0] for seed in (1, 2)]
        self.edit(one, two, selected=[within(before[0], 0.6), within(before[1], 0.4)])
        fair('EXEC_DEFAULT', True)
        for thing, vertices, reach in ((one, before[0], 0.6), (two, before[1], 0.4)):
            self.assert_same_bits(self.places(thing), module().fair(vertices, grid()[1], region=within(vertices, reach)).positions)
        bpy.ops.ed.undo()
        for name, vertices in (("Part 1", before[0]), ("Part 2", before[1])):
            self.assert_same_bits(self.places(bpy.data.objects[name]), vertices)


class Mirrored(Case):
    def test_other_side_follows(self):
        """Of a mesh that is not even to the last digit, which the result is. Pins stay, and so do their partners."""
        vertices, faces = grid(noise=0)
        bumps, pins = [4 * 13 + 8, 8 * 13 + 8], [3 * 13 + 4, 9 * 13 + 4]
        vertices[bumps, 2] += 0.2
        vertices[:, 2] += np.where(vertices[:, 0] < 0, np.float32(8e-6), np.float32(0))
        thing = self.add(vertices, faces)
        thing.data.use_mirror_x = True
        self.group(thing, "Pins", pins[:1])
        side = (vertices[:, 0] < -0.1) & within(vertices, 0.9)
        self.edit(thing, selected=[side])
        fair(pins="Pins")
        after = self.places(thing)
        moved = (after != vertices).any(axis=1)
        image = after.reshape(13, 13, 3)[::-1].reshape(-1, 3) * np.array([-1, 1, 1], np.float32)
        np.testing.assert_array_equal(after[moved], image[moved])
        self.assertEqual(moved.sum(), 2 * (side.sum() - 1))
        self.assert_same_bits(after[pins], vertices[pins])
        self.assertGreater(vertices[bumps[1], 2] - after[bumps[1], 2], 0.1)

    def test_not_without_the_option(self):
        vertices, faces = grid(noise=0)
        thing = self.add(vertices, faces)
        side = (vertices[:, 0] < -0.1) & within(vertices, 0.9)
        vertices[4 * 13 + 8, 2] += 0.2
        self.edit(thing, selected=[side])
        fair()
        self.assert_same_bits(self.places(thing)[~side], grid(noise=0)[0][~side])


class Told(Case):
    def test_nothing_selected(self):
        self.edited_patch(reach=0)
        self.assert_refused("Select the vertices", fair)

    def test_object_mode(self):
        self.edited_patch()
        bpy.ops.object.mode_set(mode='OBJECT')
        self.assert_refused("Edit Mode", fair)

    def test_nothing_holds(self):
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=2)
        thing = bpy.context.object
        before = np.array([v.co[:] for v in thing.data.vertices], np.float32)
        self.edit(thing, selected=[slice(None)])
        self.assert_refused(f"{thing.name}: .*unselected, or put some in a vertex group and choose it for Pins", fair)
        self.assert_same_bits(self.places(thing), before)

    def test_no_faces(self):
        thing = self.add([(0, 0, 0), (1, 0, 0), (2, 1, 0)], edges=[(0, 1), (1, 2)])
        self.edit(thing, selected=[slice(None)])
        self.assert_refused("Fair Edge Loop", fair)

    def test_no_such_group_or_object(self):
        self.edited_patch()
        self.assert_refused("vertex group “Rim”", fair, normals="Rim")
        self.assert_refused("vertex group “Rim”", fair, pins="Rim")
        self.assert_refused("select it besides", fair, normals_from='OBJECT')

    def test_nothing_moved(self):
        self.edited_patch(reach=0)
        self.select(bpy.context.edit_object, [0, 1, 2])
        with told() as lines:
            fair()
        self.assertIn("No vertex moved: ", lines[0])

    def test_uneven_scale_and_what_moved(self):
        thing, vertices, faces, chosen = self.edited_patch()
        thing.scale = (1, 2, 1)
        bpy.context.view_layer.update()
        with told() as lines:
            fair()
        self.assertIn("Apply the scale", lines[0])
        self.assertIn(f"{chosen.sum()} vertices moved", lines[0])
        self.assert_same_bits(self.places(thing), module().fair(vertices, faces, region=chosen).positions)

    def test_warnings_of_the_library(self):
        vertices, faces = grid()
        faces = np.vstack([faces, [[60, 61, 74, 73]]])
        thing = self.add(np.vstack([vertices, [[0, 0, 1]]]), [*faces.tolist(), [84, 85, 169]])
        self.edit(thing, selected=[np.append(within(vertices, 0.6), False)])
        with told() as lines:
            fair()
        self.assertIn("Warning: Part: ", lines[0])


class Found(Case):
    def test_menu_and_panel(self):
        drawn = [function.__name__ for function in bpy.types.VIEW3D_MT_edit_mesh_vertices.draw._draw_funcs]
        self.assertIn("in_vertex_menu", drawn)
        self.assertEqual(bpy.types.VSPRING_PT_fair.bl_context, "mesh_edit")

    def test_disabled_and_enabled_again(self):
        bpy.ops.preferences.addon_disable(module="vspring_addon")
        drawn = [function.__name__ for function in bpy.types.VIEW3D_MT_edit_mesh_vertices.draw._draw_funcs]
        self.assertNotIn("in_vertex_menu", drawn)
        self.assertFalse(hasattr(bpy.types, "VSPRING_PT_fair"))
        bpy.ops.preferences.addon_enable(module="vspring_addon")
        self.assertTrue(hasattr(bpy.types, "VSPRING_PT_fair"))

