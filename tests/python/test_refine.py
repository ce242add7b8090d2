"""Surfaces of which the moving part is refined."""
import pathlib
import tempfile
import unittest

import numpy as np
from support import Case, patch, vspring


class Refines(Case):
    def test_new_nodes_follow_and_carry_numbers(self):
        vertices, faces = patch(4, noise=0)
        refined = vspring.refine(vertices, faces, length=0.2)
        np.testing.assert_array_equal(refined.vertices[:len(vertices)], vertices)
        corners, offsets = refined.faces
        self.assertEqual(set(np.diff(offsets)), {4})
        ends = refined.vertices[corners.reshape(-1, 4)]
        # On this saddle sides of cells are up to 0.7 long.
        self.assertLessEqual(np.linalg.norm(ends - np.roll(ends, 1, axis=1), axis=2).max(), 0.2)
        self.assertEqual(len(refined.face_from), len(offsets) - 1)
        np.testing.assert_allclose(refined.at_nodes(vertices), refined.vertices, atol=1e-14)
        np.testing.assert_allclose(refined.at_nodes(vertices[:, 1]), refined.vertices[:, 1], atol=1e-14)
        result = vspring.fair(refined.vertices, refined.faces, region=refined.free)
        self.assertTrue(result.report.usable)
        held = np.setdiff1d(np.arange(len(refined.vertices)), refined.free)
        np.testing.assert_array_equal(result.positions[held], refined.vertices[held])

    def test_triangles_and_turns(self):
        vertices, quads = patch(3, noise=0)
        triangles = np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])
        refined = vspring.refine(vertices, triangles, turn=10, fix="none")
        self.assertEqual(refined.faces.shape[1], 3)
        self.assertEqual(len(refined.free), len(refined.vertices))
        self.assertIsNone(refined.surface)

    def test_the_boundary_looks_as_far_for_points_as_before(self):
        across = np.linspace(0, 1, 4)
        vertices = np.array([(x, y, 0) for y in across for x in across])
        faces = [(4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4) for j in range(3) for i in range(3)]
        along = np.linspace(0, 1, 21)
        points = np.array([(x, y, 0.2 * np.sin(3 * x)) for x in along for y in along])
        refined = vspring.refine(vertices, faces, length=0.06, fix="none")
        self.assertAlmostEqual(refined.boundary_reach, 2 / 3)
        fitted = lambda **reach: vspring.fit(refined.vertices, refined.faces, points, weight=1, fix="none", **reach).report
        self.assertGreater(fitted().boundary_of_points.kept, 0)
        report = fitted(boundary_reach=refined.boundary_reach)
        self.assertTrue(report.usable)
        self.assertEqual(report.boundary_of_points.kept, 0)
        self.assertLess(report.after.rms, 0.003)

    def test_a_file_keeps_what_it_carried(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.obj"
            path.write_text("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 1\ng roof\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n")
            refined = vspring.refine(vspring.read(path), length=0.5)
            self.assertEqual(len(refined.surface.vertices), len(refined.vertices))
            self.assertEqual(len(refined.surface.groups["roof"]), len(refined.vertices))
            positions, _ = vspring.fair(refined.surface)
            vspring.write(path, positions, source=refined.surface)
            self.assertEqual(len(vspring.read(path).vertices), len(refined.vertices))

    def test_even_triangles(self):
        vertices, faces = patch(6, noise=0)
        remeshed = vspring.remesh(vertices, faces, length=0.3)
        self.assertEqual(remeshed.length, 0.3)
        kept = remeshed.node_from[remeshed.node_from >= 0]
        np.testing.assert_array_equal(remeshed.vertices[:len(kept)], vertices[kept])
        self.assertTrue(np.all(remeshed.node_from[len(kept):] == -1))
        self.assertEqual(remeshed.faces.shape[1], 3)
        self.assertEqual(len(remeshed.face_from), len(remeshed.faces))
        np.testing.assert_allclose(remeshed.at_nodes(vertices), remeshed.vertices, atol=1e-12)
        result = vspring.fair(remeshed.vertices, remeshed.faces, region=remeshed.free)
        self.assertTrue(result.report.usable)
        self.assertGreater(vspring.remesh(vertices, faces).length, 0)
        edge = faces[14][:2]
        creased = vspring.remesh(vertices, faces, length=0.3, fix="none", sharp_edges=[edge])
        self.assertLessEqual(set(edge), set(creased.node_from[creased.sharp_edges].ravel()))
        for options in ({"length": 0}, {"length": 1e-9}):
            with self.assertRaises(vspring.Error):
                vspring.remesh(vertices, faces, **options)

    def test_what_cannot_be_refined_is_refused(self):
        vertices, faces = patch(3)
        for options in ({}, {"length": 0}, {"turn": 180}, {"length": 1, "turn": 1}, {"length": 1e-9}):
            with self.assertRaises(vspring.Error):
                vspring.refine(vertices, faces, **options)
        with self.assertRaises(vspring.Error):
            vspring.refine(vertices, faces, length=0.1).at_nodes(np.zeros(7))


if __name__ == "__main__":
    unittest.main()
