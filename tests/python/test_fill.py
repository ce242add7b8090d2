"""Holes that are filled."""
import unittest
import warnings

import numpy as np
from support import Case, patch, vspring


def sphere(rows=16, columns=32, first=2):
    """A sphere of quads between two holes at its poles."""
    down, around = np.meshgrid(np.linspace(0, np.pi, rows + 1)[first:-first], 2 * np.pi * np.arange(columns) / columns, indexing="ij")
    vertices = np.column_stack([(np.sin(down) * np.cos(around)).ravel(), (np.sin(down) * np.sin(around)).ravel(), np.cos(down).ravel()])
    rings = len(vertices) // columns
    faces = [[columns * i + k, columns * (i + 1) + k, columns * (i + 1) + (k + 1) % columns, columns * i + (k + 1) % columns]
             for i in range(rings - 1) for k in range(columns)]
    return vertices, faces


class Fills(Case):
    def test_the_holes_of_a_sphere_become_that_sphere(self):
        vertices, faces = sphere()
        before = vertices.copy()
        filled = vspring.fill(vertices, faces, tolerance=1e-8)
        self.assertEqual([hole.state for hole in filled.holes], ["filled", "filled"])
        self.assertEqual([hole.outcome for hole in filled.holes], ["converged", "converged"])
        self.assertTrue(filled.report.converged)
        np.testing.assert_array_equal(vertices, before)
        np.testing.assert_array_equal(filled.vertices[:len(vertices)], vertices)
        new = filled.vertices[len(vertices):]
        self.assertGreater(len(new), 20)
        self.assertEqual(len(new), sum(hole.node_count for hole in filled.holes))
        self.assertLess(np.abs(np.linalg.norm(new, axis=1) - 1).max(), 1e-5)
        corners, offsets = filled.faces
        self.assertEqual(corners[:4 * len(faces)].reshape(-1, 4).tolist(), faces)
        self.assertEqual(offsets[-1], len(corners))
        # No edge has one face alone any more; what comes back is taken again.
        self.assertEqual(vspring.fill(filled.vertices, filled.faces).holes, [])

    def test_a_patch_meets_the_curvature_around(self):
        vertices, faces = sphere(32, 64, 4)
        vertices = vertices * (1.5, 1.0, 0.8)
        off = {}
        for continuity in ("tangent", "curvature"):
            filled = vspring.fill(vertices, faces, continuity=continuity)
            self.assertEqual(filled.report.continuity, continuity)
            off[continuity] = np.abs(np.linalg.norm(filled.vertices / (1.5, 1.0, 0.8), axis=1) - 1).max()
        self.assertLess(off["curvature"], 0.8 * off["tangent"])

    def test_only_the_holes_that_are_asked_for(self):
        vertices, faces = sphere()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for options, states in [({"at": [0]}, ["filled", "elsewhere"]), ({"max_size": 0.1}, ["too-large", "too-large"]),
                                    ({"max_edges": 31}, ["too-large", "too-large"])]:
                self.assertEqual([hole.state for hole in vspring.fill(vertices, faces, **options).holes], states, options)
        flat = vspring.fill(vertices, faces, flat=True)
        self.assertGreater(np.abs(np.linalg.norm(flat.vertices, axis=1) - 1).max(), 0.01)
        self.assertEqual([hole.outcome for hole in flat.holes], [None, None])

    def test_what_cannot_be_filled_is_not_usable(self):
        vertices, faces = patch(noise=0)
        vertices[:, 2] = 0
        with self.assertWarns(vspring.Warning):
            filled = vspring.fill(vertices, faces, outer_rims=True)
        self.assertEqual([hole.state for hole in filled.holes], ["unfillable"])
        self.assertEqual((filled.report.outcome, filled.report.usable), ("converged", False))
        self.assertTrue(vspring.fill(*sphere()).report.usable)

    def test_triangles_stay_an_array_and_what_cannot_be_is_refused(self):
        vertices, faces = sphere()
        triangles = np.array([corners for a, b, c, d in faces for corners in ([a, b, c], [a, c, d])])
        filled = vspring.fill(vertices, triangles)
        self.assertEqual(filled.faces.shape[1], 3)
        np.testing.assert_array_equal(filled.faces[:len(triangles)], triangles)
        for at in ([40], [len(vertices)], []):
            with self.assertRaises(vspring.Error):
                vspring.fill(vertices, triangles, at=at)


if __name__ == "__main__":
    unittest.main()
