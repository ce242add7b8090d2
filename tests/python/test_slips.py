"""Slips that would pass in silence: each is refused, and says what to give."""
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


if __name__ == "__main__":
    unittest.main()
