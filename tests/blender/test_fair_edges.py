"""Fair Edge Loop: chains of selected edges."""
import bpy
import numpy as np
from support import Case, grid, module

fair_edges = bpy.ops.mesh.vspring_fair_edges


def ring(count=24, noise=0.03, radius=1.0):
    """A closed loop with noise, and the radii of its vertices."""
    angle = np.arange(count) * 2 * np.pi / count
    places = radius * np.column_stack([np.cos(angle), np.sin(angle), np.zeros(count)])
    places *= 1 + noise * np.random.default_rng(3).standard_normal((count, 1))
    return places.astype(np.float32), [(k, (k + 1) % count) for k in range(count)]


class Chains(Case):
    def row(self):
        """A grid whose middle row is selected: the object, its vertices, the row."""
        vertices, faces = grid()
        thing = self.add(vertices, faces)
        chain = np.arange(6 * 13, 7 * 13)
        self.edit(thing, selected=[chain])
        return thing, vertices, chain

    def test_open_chain_on_a_surface(self):
        thing, vertices, chain = self.row()
        fair_edges()
        after = self.places(thing)
        expected = module().fair_curve(vertices, chains=[chain], fix_normals="boundary").positions
        self.assert_same_bits(after, expected)
        self.assert_same_bits(np.delete(after, chain[1:-1], axis=0), np.delete(vertices, chain[1:-1], axis=0))
        self.assertTrue((after[chain[1:-1]] != vertices[chain[1:-1]]).any(axis=1).all())

    def test_ends_that_turn(self):
        thing, vertices, chain = self.row()
        fair_edges(join='POSITION')
        ends = vertices[chain[[0, -1]]].astype(float)
        along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
        away = self.places(thing)[chain] - ends[0]
        self.assertLess(np.linalg.norm(away - np.outer(away @ along, along), axis=1).max(), 1e-4)

    def test_edges_that_no_face_has(self):
        places, edges = ring()
        thing = self.add(places[:13], edges=edges[:12])
        self.edit(thing, selected=[slice(None)])
        fair_edges()
        self.assert_same_bits(self.places(thing), module().fair_curve(places[:13], fix_normals="boundary").positions)

    def test_undo(self):
        thing, vertices, _ = self.row()
        fair_edges('EXEC_DEFAULT', True)
        bpy.ops.ed.undo()
        self.assert_same_bits(self.places(bpy.context.edit_object), vertices)

    def test_mirrored(self):
        vertices, faces = grid(noise=0)
        column, pins = np.arange(1, 6) * 13 + 6, [4 * 13 + 6, 8 * 13 + 6]
        vertices[[2 * 13 + 6, 10 * 13 + 6], 2] += 0.1
        vertices[:, 2] += np.where(vertices[:, 0] < 0, np.float32(8e-6), np.float32(0))
        thing = self.add(vertices, faces)
        thing.data.use_mirror_x = True
        self.group(thing, "Pins", pins[1:])
        self.edit(thing, selected=[column])
        fair_edges(pins="Pins")
        after = self.places(thing)
        moved = (after != vertices).any(axis=1)
        image = after.reshape(13, 13, 3)[::-1].reshape(-1, 3) * np.array([-1, 1, 1], np.float32)
        np.testing.assert_array_equal(after[moved], image[moved])
        self.assertTrue(moved[[2 * 13 + 6, 10 * 13 + 6]].all())
        self.assert_same_bits(after[pins], vertices[pins])


class Loops(Case):
    def test_three_pins_make_a_circle(self):
        places, edges = ring()
        thing = self.add(places, edges=edges)
        pins = [0, 8, 16]
        places[pins] /= np.linalg.norm(places[pins], axis=1, keepdims=True)
        thing.data.vertices.foreach_set("co", places.ravel())
        self.group(thing, "Pins", pins)
        self.edit(thing, selected=[slice(None)])
        fair_edges(pins="Pins")
        after = self.places(thing)
        self.assertLess(np.abs(np.linalg.norm(after, axis=1) - 1).max(), 1e-4)
        self.assert_same_bits(after[pins], places[pins])

    def test_within_a_distance(self):
        places, edges = ring()
        thing = self.add(places, edges=edges)
        self.edit(thing, selected=[slice(None)])
        fair_edges(within=0.1)
        after = self.places(thing)
        self.assertLess(np.linalg.norm(after - places, axis=1).max(), 0.101)
        self.assertLess(np.ptp(np.linalg.norm(after, axis=1)), np.ptp(np.linalg.norm(places, axis=1)) / 2)

    def test_refused(self):
        places, edges = ring()
        thing = self.add(places, edges=edges)
        self.edit(thing, selected=[slice(None)])
        self.assert_refused("closed loop, as through vertex 0.*Pins.*distance", fair_edges)
        bpy.ops.mesh.select_all(action='DESELECT')
        self.select(thing, [0, 2])
        self.assert_refused("select edges", fair_edges)
