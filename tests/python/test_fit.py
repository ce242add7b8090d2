"""Shapes drawn to points."""
import unittest
import warnings

import numpy as np
from support import Case, patch, vspring, wave


def scattered(count=400, seed=3):
    """Points on a saddle, their weights and normals."""
    random = np.random.default_rng(seed)
    x, y = random.uniform(-1, 1, (2, count))
    normals = np.column_stack([-x, y, np.ones(count)])
    points = np.column_stack([x, y, (x * x - y * y) / 2 + 0.1]) + 0.01 * random.standard_normal((count, 3))
    return points, random.uniform(0.5, 2, count), normals / np.linalg.norm(normals, axis=1)[:, None]


class Fits(Case):
    def setUp(self):
        super().setUp()
        warnings.simplefilter("ignore")

    def points_file(self, points, weights=None, normals=None):
        path = self.folder / "points.csv"
        columns = {"x": points[:, 0], "y": points[:, 1], "z": points[:, 2]}
        if normals is not None:
            columns |= {"nx": normals[:, 0], "ny": normals[:, 1], "nz": normals[:, 2]}
        if weights is not None:
            columns["weight"] = weights
        rows = np.column_stack(list(columns.values())).tolist()
        path.write_text("\n".join([",".join(columns), *(",".join(map(repr, row)) for row in rows)]) + "\n")
        return path

    def test_criteria_as_the_command_line(self):
        vertices, faces = patch()
        points, weights, normals = scattered()
        path = self.points_file(points)
        for options, flags in [({"weight": 0.01}, ["--weight", 0.01]), ({"smoothing_length": 0.2}, ["--smoothing-length", 0.2]),
                               ({"within": 0.06}, ["--within", 0.06]), ({"rms": 0.02}, ["--rms", 0.02]),
                               ({"weight": 0.01, "outliers": 0.1}, ["--weight", 0.01, "--outliers", 0.1]),
                               ({"weight": 0.001, "method": "sweep"}, ["--weight", 0.001, "--method", "sweep"])]:
            with self.subTest(options=options):
                self.assert_same_bits(vspring.fit(vertices, faces, points, **options).positions,
                                      self.by_command_line("fit", vertices, faces, "--points", path, *flags))

    def test_weights_and_normals_as_the_command_line(self):
        vertices, faces = patch()
        points, weights, normals = scattered()
        normals[:100] *= -1
        path = self.points_file(points, weights, normals)
        expected = self.by_command_line("fit", vertices, faces, "--points", path, "--weight", 0.01)
        self.assert_same_bits(vspring.fit(vertices, faces, points, weights=weights, normals=normals, weight=0.01).positions, expected)
        read = vspring.read_points(path)
        self.assert_same_bits(read.weights, weights)
        self.assert_same_bits(vspring.fit(vertices, faces, read, weight=0.01).positions, expected)
        for less in ({"weights": weights}, {"normals": normals}):
            self.assertTrue((vspring.fit(vertices, faces, points, weight=0.01, **less).positions != expected).any())

    def test_weights_and_normals_replace_those_of_points(self):
        vertices, faces = patch()
        points, weights, normals = scattered()
        normals[:100] *= -1
        scan = vspring.Points(points, weights[::-1], -normals)
        for less in ({"weights": weights}, {"normals": normals}, {"weights": weights, "normals": normals}):
            whole = {"weights": scan.weights, "normals": scan.normals} | less
            self.assert_same_bits(vspring.fit(vertices, faces, scan, smoothing_length=0.2, **less).positions,
                                  vspring.fit(vertices, faces, points, smoothing_length=0.2, **whole).positions)

    def test_weights_of_the_shapes_own_nodes(self):
        vertices, faces = patch(noise=0)
        true = vertices[84, 2]
        vertices[84, 2] += 0.3
        weights = np.where(np.arange(169) == 84, 0, 1)
        without = vspring.fit(vertices, faces, weights=weights, smoothing_length=0.1)
        self.assertLess(abs(without.positions[84, 2] - true), 0.03)
        self.assertGreater(vspring.fit(vertices, faces, smoothing_length=0.1).positions[84, 2], true + 0.1)
        self.assertEqual(without.report.pulling_points, 120)

    def test_a_free_boundary_as_the_command_line(self):
        vertices, faces = patch()
        line = np.linspace(-1, 1, 61)
        x, y = (one.ravel() for one in np.meshgrid(line, line))
        points = np.column_stack([x, y, (x * x - y * y) / 2])
        positions, report = vspring.fit(vertices, faces, points, smoothing_length=0.1, fix="none")
        self.assert_same_bits(positions, self.by_command_line("fit", vertices, faces, "--points", self.points_file(points),
                                                              "--smoothing-length", 0.1, "--fix", "none"))
        told = report.boundary_of_points
        self.assertEqual((told.points, told.ends, told.inside, told.kept), (240, 48, 0, 0))
        self.assertTrue(report.boundary.converged)
        self.assertIsNone(vspring.fit(vertices, faces, points, smoothing_length=0.1).report.boundary_of_points)

    def test_own_nodes_as_the_command_line(self):
        vertices, faces = patch(cells=20, noise=0.004)
        for options, flags in [({"noise": 0.004}, ["--noise", 0.004]), ({"noise": "auto"}, ["--noise", "auto"]),
                               ({"within": "auto"}, ["--within", "auto"]), ({"rms": "auto"}, ["--rms", "auto"]),
                               ({"noise": "auto", "region": "sphere:0.3,0.2,0,0.6"}, ["--noise", "auto", "--region", "sphere:0.3,0.2,0,0.6"]),
                               ({"smoothing_length": 0.1, "distribution": "smooth"}, ["--smoothing-length", 0.1, "--distribution", "smooth"])]:
            with self.subTest(options=options):
                expected = self.by_command_line("fair", vertices, faces, *flags)
                self.assert_same_bits(vspring.fair(vertices, faces, **options).positions, expected)
                if "distribution" not in options:
                    self.assert_same_bits(vspring.fit(vertices, faces, **options).positions, expected)

    def test_curves_as_the_command_line(self):
        curve = wave(noise=0.01)
        for options, flags in [({"within": 0.05}, ["--within", 0.05]), ({"noise": "auto"}, ["--noise", "auto"]),
                               ({"rms": "auto"}, ["--rms", "auto"]), ({"within": 0.05, "min_radius": 2.0}, ["--within", 0.05, "--min-radius", 2]),
                               ({"within": 0.05, "move": "yz"}, ["--within", 0.05, "--move", "yz"]),
                               ({"noise": "auto", "move": "y"}, ["--noise", "auto", "--move", "y"]),
                               ({"noise": "auto", "region": "box:1,-9,-9,5,9,9"}, ["--noise", "auto", "--region", "box:1,-9,-9,5,9,9"]), ({"sharp": 30}, ["--sharp", 30])]:
            with self.subTest(options=options):
                positions, report = vspring.fair_curve(curve, **options)
                self.assert_same_bits(positions, self.by_command_line("curve", curve, None, *flags))
        self.assertGreater(report.corners, 0)
        points = curve[::3] + 0.02
        path = self.points_file(points)
        self.assert_same_bits(vspring.fit(curve, None, points, smoothing_length=0.3).positions,
                              self.by_command_line("fit", curve, None, "--points", path, "--smoothing-length", 0.3))

    def test_heights_alone_move(self):
        flat = wave(noise=0.01)[:, :2]
        fair = vspring.fair_curve(flat, within=0.05, move="y").positions
        self.assert_same_bits(fair[:, 0], flat[:, 0])
        self.assertTrue((fair[1:-1, 1] != flat[1:-1, 1]).all())

    def test_report(self):
        vertices, faces = patch()
        points, weights, _ = scattered()
        weights[:50] = 0
        report = vspring.fit(vertices, faces, points, weights=weights, within=0.06).report
        self.assertEqual(report.points, 400)
        self.assertLessEqual(report.pulling_points, 350)
        self.assertEqual(report.distances.shape, (400,))
        self.assertEqual(report.distances[report.after.point], report.after.greatest)
        # Those above corners, of which no node moves, do not count.
        self.assertGreater(report.points_at_held, 0)
        self.assertEqual(report.distances.max(), max(report.after.greatest, report.greatest_at_held))
        squares = (report.distances**2).sum() - report.after.rms**2 * (400 - report.points_at_held)
        self.assertGreater(squares, 0)
        self.assertLess(squares, report.points_at_held * report.greatest_at_held**2)
        self.assertLess(report.after.rms, report.before.rms)
        self.assertIn("400 points", repr(report))

    def test_refused(self):
        vertices, faces = patch()
        points, weights, normals = scattered()
        for words, call in [("one of weight", lambda: vspring.fit(vertices, faces, points)),
                            ("only one of weight", lambda: vspring.fit(vertices, faces, points, weight=1, rms=1)),
                            ("outliers needs", lambda: vspring.fair(vertices, faces, outliers=0.1)),
                            ("weight", lambda: vspring.fit(vertices, faces, points, weights=weights[1:], weight=1)),
                            ("weights", lambda: vspring.fit(vertices, faces, weights=weights[:3], weight=1)),
                            ("weights", lambda: vspring.fit(vertices, faces, vspring.Points(points), weights=[1, 2, 3], weight=1)),
                            ("normals", lambda: vspring.fit(vertices, faces, vspring.Points(points), normals=normals[1:], weight=1)),
                            (r"points.*\(n, 3\)", lambda: vspring.fit(vertices, faces, points[:, :2], weight=1)),
                            ("points", lambda: vspring.fit(wave(), None, points[:, :1], weight=1)),
                            ("a number is needed", lambda: vspring.fair(vertices, faces, weight="auto")),
                            ("point 7", lambda: vspring.fit(vertices, faces, np.where(np.arange(400)[:, None] == 7, np.nan, points), weight=1))]:
            with self.subTest(words), self.assertRaisesRegex(vspring.Error, words):
                call()


if __name__ == "__main__":
    unittest.main()
