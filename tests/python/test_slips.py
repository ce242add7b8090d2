"""Slips that would pass in silence: each is refused, and says what to give."""
import pathlib
import tempfile
import unittest

import numpy as np
from support import vspring

GRID = np.array([[i, j, 0.2 * ((i * j) % 3)] for j in range(6) for i in range(6)], float)
FACES = np.array([[j * 6 + i, j * 6 + i + 1, j * 6 + i + 7, j * 6 + i + 6] for j in range(5) for i in range(5)])
ARC = np.c_[np.linspace(0, 3, 30), np.sin(np.linspace(0, 3, 30))]


class Slips(unittest.TestCase):
    def refused(self, words, call, *given, **named):
        with self.assertRaisesRegex(vspring.Error, words):
            call(*given, **named)

    def test_a_mask_of_numbers(self):
        mask = (GRID[:, 0] > 2).astype(int)
        self.refused(r"region: 0 and 1 alone .* region\.astype\(bool\)", vspring.fair, GRID, FACES, region=mask)
        self.refused("fix: 0 and 1 alone", vspring.fair, GRID, FACES, fix=mask.astype(np.uint8))
        vspring.fair(GRID, FACES, region=mask.astype(bool))
        # A few nodes may be these.
        vspring.fair(GRID, FACES, fix_normals=[0, 1])

    def test_sharp_of_a_surface_is_by_its_edges(self):
        self.refused("find_sharp_edges", vspring.fair, GRID, FACES, sharp=40)
        edges = vspring.find_sharp_edges(GRID, FACES, angle=5)
        vspring.fit(GRID, FACES, points=GRID, within=0.1, sharp=40, sharp_edges=edges)

    def test_closed_is_no_word(self):
        self.refused("closed: True or False", vspring.fair_curve, ARC, closed="no")

    def test_numbers_that_are_not_finite(self):
        rules = [{"nodes": [3], "position": [0, float("nan"), 0]}]
        self.refused("constraints: a number is not finite", vspring.fair, GRID, FACES, constraints=rules)
        session = vspring.Session(GRID, FACES)
        self.refused("position: .* is not finite", session.hold, 14, [0, 0, np.nan])
        vertices, curve = GRID.copy(), ARC.copy()
        vertices[14, 2] = curve[4, 1] = np.nan
        self.refused("node 14: ", vspring.curvatures, vertices, FACES)
        self.refused("node 14: ", vspring.find_sharp_edges, vertices, FACES, angle=5)
        self.refused("node 14: ", vspring.find_sharp_edges, vertices, FACES, angle=5, noise=0.01)
        self.refused("node 4: ", vspring.fair_curve, curve, within=0.1)

    def test_a_curve_of_two_columns_stays_in_its_plane(self):
        points = np.c_[ARC, np.full(30, 0.5)]
        self.refused("left the plane z = 0.*third column", vspring.fit, ARC, points=points, within=0.05)
        self.refused("left the plane z = 0", vspring.fair_curve, ARC, constraints=[{"nodes": [15], "position": [1.5, 1, 2]}])
        points[:, 2] = 0
        positions, report = vspring.fit(ARC, points=points, within=0.05)
        self.assertEqual(positions.shape, ARC.shape)
        self.assertTrue(report.usable)


    def mistaken(self, words, call, *given, **named):
        with self.assertRaisesRegex(TypeError, words):
            call(*given, **named)

    def test_options_that_need_points(self):
        self.refused("min_radius needs one of weight", vspring.fair_curve, ARC, min_radius=1)
        self.refused("move needs one of weight", vspring.fair_curve, ARC, move="y")
        self.refused("min_radius: that is for curves", vspring.fit, GRID, FACES, points=GRID, within=1, min_radius=1)

    def test_auto_beside_points(self):
        for name in ("noise", "within", "rms"):
            self.refused(f"{name}: a number is needed where points are given", vspring.fit, GRID, FACES, points=GRID, **{name: "auto"})
        soup = GRID[FACES].reshape(-1, 3)
        self.refused("noise: no two faces share a node.* weld=0", vspring.fair, soup, np.arange(100).reshape(-1, 4), noise="auto")

    def test_numbers_out_of_range(self):
        self.refused("resample: 10000000000 is out of range", vspring.fair_curve, ARC, within=0.1, resample=10**10)
        self.mistaken("resample: a whole number is needed, not 2.5", vspring.fair_curve, ARC, within=0.1, resample=2.5)
        self.mistaken("tolerance: a number is needed, not 'x'", vspring.fair, GRID, FACES, tolerance="x")
        self.mistaken("paper: True or False is needed, not 'yes'", vspring.fair, GRID, FACES, paper="yes")
        self.mistaken("method: a word is needed, not 3", vspring.fair, GRID, FACES, method=3)
        self.refused("edges: nodes count from 0", vspring.chains_of, [[0, -1]])

    def test_other_kinds(self):
        for call in (vspring.fair, vspring.fair_curve, vspring.measure, vspring.fit, vspring.curvatures, vspring.Session):
            self.mistaken(r"'m.obj' is a path; give read\('m.obj'\)", call, "m.obj")
        self.mistaken("'c.csv' is a path", vspring.fair_curve, pathlib.Path("c.csv"))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            vspring.write(path / "m.obj", GRID, FACES)
            vspring.write(path / "c.csv", ARC)
            surface, curve = vspring.read(path / "m.obj"), vspring.read(path / "c.csv")
            self.mistaken(r"fair\(\) fairs it", vspring.fair_curve, surface)
            self.mistaken("a curve has no faces; fair_curve", vspring.fair, curve)
            self.mistaken("a curve has no faces", vspring.measure, curve, FACES)
            self.mistaken("source=", vspring.write, path / "z.obj", GRID, surface)
            self.mistaken("faces: a shape of read", vspring.fair, GRID, surface)
            self.mistaken("give its positions", vspring.write, path / "z.obj", vspring.fair(surface), source=surface)
            self.mistaken("points: .* is a path; give read_points", vspring.fit, surface, points=path / "m.obj", within=1)
            self.mistaken("points: a shape of read", vspring.fit, surface, points=surface, within=1)


if __name__ == "__main__":
    unittest.main()
