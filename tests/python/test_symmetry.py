"""Symmetric shapes."""
import numpy as np

from support import Case, patch, vspring, wave, write_obj


def half():
    """Half a saddle, which ends in the plane x = 0: vertices and quads."""
    vertices, faces = patch()
    middle = np.abs(vertices[:, 0]) < 0.05
    vertices[middle, 0] = 0
    keep = np.flatnonzero(vertices[:, 0] >= 0)
    number = np.full(len(vertices), -1)
    number[keep] = np.arange(len(keep))
    inside = (number[faces] >= 0).all(axis=1)
    return vertices[keep], number[faces[inside]]


def whole():
    """A saddle that is nearly symmetric about x = 0."""
    return patch(noise=0.01)


class Symmetry(Case):
    def test_a_half_is_found_with_its_whole(self):
        vertices, faces = half()
        found = vspring.find_symmetry(vertices, faces, plane="x")
        on_plane = int((vertices[:, 0] == 0).sum())
        self.assertEqual((found.is_half, found.on_plane, found.pairs), (True, on_plane, len(vertices) - on_plane))
        self.assertEqual(len(found.vertices), 2 * len(vertices) - on_plane)
        np.testing.assert_array_equal(found.vertices[found.partner], found.vertices * [-1, 1, 1])
        np.testing.assert_array_equal(found.vertices[:len(vertices)], vertices)
        corners, offsets = found.faces
        self.assertEqual(len(offsets) - 1, 2 * len(faces))
        self.assertIsNone(found.chains)
        # Its whole is faired as the half is.
        np.testing.assert_allclose(vspring.fair(found.vertices, found.faces).positions[:len(vertices)],
                                   vspring.fair(vertices, faces, symmetry="x").positions, atol=1e-9)

    def test_a_curve_is_found_with_its_whole(self):
        vertices = np.array([[0, 0], [1, 1.0], [2, 0.5], [3, 0]])
        found = vspring.find_symmetry(vertices, plane="y")
        self.assertEqual((found.is_half, found.faces, found.closed), (True, None, [True]))
        self.assertEqual((len(found.vertices), len(found.chains), len(found.chains[0])), (6, 1, 6))

    def test_what_is_not_symmetric_is_refused(self):
        vertices, faces = half()
        for plane, why in (("y=0.1", "mirror image"), ("x=9", "plane"), ("w", "plane"), ("x=0.5", "node")):
            with self.assertRaises(vspring.Error) as raised:
                vspring.find_symmetry(vertices, faces, plane=plane)
            self.assertIn(why, str(raised.exception))

    def test_results_are_those_of_the_command_line(self):
        vertices, faces = half()
        for options, words in (({}, []), ({"fix_normals": "boundary"}, ["--fix-normals", "boundary"]), ({"within": 0.03}, ["--within", 0.03]),
                               ({"region": "sphere:0,0,0,0.7"}, ["--region", "sphere:0,0,0,0.7"])):
            positions = vspring.fair(vertices, faces, symmetry="x", **options).positions
            np.testing.assert_array_equal(positions, self.by_command_line("fair", vertices, faces, "--symmetry", "x", *words), str(options))
            self.assertEqual(set(positions[vertices[:, 0] == 0][:, 0]), {0})
        points = vertices * [-1, 1, 1] + [0, 0, 0.02]
        write_obj(self.folder / "points.obj", points, faces)
        positions = vspring.fit(vertices, faces, points, smoothing_length=0.1, symmetry="x").positions
        np.testing.assert_array_equal(positions, self.by_command_line(
            "fit", vertices, faces, "--points", self.folder / "points.obj", "--ignore-point-normals", "--smoothing-length", 0.1, "--symmetry", "x"))

    def test_a_whole_comes_out_symmetric(self):
        vertices, faces = whole()
        partner = vspring.find_symmetry(vertices, faces, plane="x").partner
        positions = vspring.fair(vertices, faces, symmetry="x").positions
        np.testing.assert_array_equal(positions[partner], positions * [-1, 1, 1])

    def test_what_holds_a_half_holds_the_whole(self):
        vertices, faces = half()
        inner = int(np.argmin(np.linalg.norm(vertices - [0.5, 0, 0], axis=1)))
        raised = vertices[inner] + [0, 0, 0.1]
        by_rule = vspring.fair(vertices, faces, symmetry="x", constraints=[{"nodes": [inner], "position": raised}]).positions
        np.testing.assert_array_equal(by_rule[inner], raised)
        mask = np.linalg.norm(vertices, axis=1) < 0.7
        np.testing.assert_array_equal(vspring.fair(vertices, faces, symmetry="x", region=mask).positions,
                                      vspring.fair(vertices, faces, symmetry="x", region="sphere:0,0,0,0.7").positions)
        bent = np.column_stack([vertices[:, :2], -np.abs(vertices[:, 0])])
        edge = np.flatnonzero(vertices[:, 0] == 0)
        edge = edge[np.argsort(vertices[edge, 1])]
        report = vspring.fair(bent, faces, symmetry="x", constraints=[{"nodes": edge, "sharp": "path"}]).report
        self.assertEqual(report.sharp_edges, len(edge) - 1)

    def test_curves(self):
        vertices = wave()[:, :2] * [1, 1]
        vertices[:, 1] += 0.5
        vertices[0, 1] = vertices[-1, 1] = 0
        positions = vspring.fair_curve(vertices, symmetry="y", fix=[20, 40]).positions
        self.assertEqual(positions.shape, vertices.shape)
        self.assertEqual((positions[0, 1], positions[-1, 1]), (0, 0))
        np.testing.assert_array_equal(positions[[20, 40]], vertices[[20, 40]])
        with self.assertRaises(vspring.Error):
            vspring.fair_curve(vertices, symmetry="y", resample=40)


if __name__ == "__main__":
    import unittest
    unittest.main()
