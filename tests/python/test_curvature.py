"""curvatures(), colours(), chains_of()."""
import re
import unittest

import numpy as np
from support import ROOT, Case, patch, vspring, wave


def torus(major=2.0, minor=1.0, around=96, across=60):
    """Vertices, quads, and the angle across at each vertex, 0 outside."""
    u, v = (one.ravel() for one in np.meshgrid(np.arange(around) * 2 * np.pi / around, np.arange(across) * 2 * np.pi / across, indexing="ij"))
    away = major + minor * np.cos(v)
    node = np.arange(around * across).reshape(around, across)
    right, up = np.roll(node, -1, axis=0), np.roll(node, -1, axis=1)
    quads = np.stack([node, right, np.roll(right, -1, axis=1), up], axis=-1).reshape(-1, 4)
    return np.column_stack([away * np.cos(u), away * np.sin(u), minor * np.sin(v)]), quads, v


class Bends(Case):
    def test_torus(self):
        vertices, quads, v = torus()
        bends = vspring.curvatures(vertices, quads)
        across = np.cos(v) / (2 + np.cos(v))
        np.testing.assert_allclose(bends.k1, 1, atol=2e-3)
        np.testing.assert_allclose(bends.k2, across, atol=5e-3)
        np.testing.assert_allclose(bends.mean, (1 + across) / 2, atol=5e-3)
        np.testing.assert_allclose(bends.gaussian, across, atol=5e-3)
        outward = np.column_stack([vertices[:, :2] * (1 - 2 / np.linalg.norm(vertices[:, :2], axis=1, keepdims=True)), vertices[:, 2]])
        np.testing.assert_allclose(bends.normals, outward, atol=2e-3)
        np.testing.assert_allclose(np.abs(bends.directions2[:, 2]), 0, atol=2e-2)
        np.testing.assert_allclose(np.einsum("ij,ij->i", bends.directions1, bends.directions2), 0, atol=1e-9)

    def test_same_on_any_number_of_threads_and_from_a_file(self):
        vertices, faces = patch()
        one = vspring.curvatures(vertices, faces, threads=1)
        vspring.write(self.folder / "part.obj", vertices, faces)
        for other in (vspring.curvatures(vertices, faces, threads=3), vspring.curvatures(vspring.read(self.folder / "part.obj"))):
            for left, right in zip(one, other):
                self.assert_same_bits(left, right)

    def test_refused(self):
        with self.assertRaisesRegex(vspring.Error, "face 0"):
            vspring.curvatures([[0, 0, 0]], [[0, 1, 2]])
        with self.assertRaisesRegex(TypeError, "faces are missing"):
            vspring.curvatures([[0, 0, 0]])


class Colours(unittest.TestCase):
    def test_ends_and_middle(self):
        shades, (low, high) = vspring.colours(np.linspace(0, 1, 1001))
        self.assertAlmostEqual(low, 0.02)
        self.assertAlmostEqual(high, 0.98)
        np.testing.assert_allclose(shades[[0, -1]] * 255, [[0x44, 0x01, 0x54], [0xfd, 0xe7, 0x25]])
        shades, (low, high) = vspring.colours([-2, 3, 8], about=3)
        np.testing.assert_allclose(shades[1] * 255, [0xf7] * 3)
        self.assertAlmostEqual(low + high, 6)

    def test_all_alike(self):
        for about in (None, 5.0, 0.0):
            shades, (low, high) = vspring.colours(np.full(7, 5.0), about=about)
            self.assertLess(low, high)
            self.assertEqual(len(np.unique(shades, axis=0)), 1)
        self.assertEqual(vspring.colours([])[0].shape, (0, 3))

    def test_over_others(self):
        shades, ends = vspring.colours([5, 50, 500], over=np.linspace(0, 100, 1001))
        np.testing.assert_allclose(ends, [2, 98])
        np.testing.assert_allclose(shades[2] * 255, [0xfd, 0xe7, 0x25])
        np.testing.assert_allclose(shades[1] * 255, [0x21, 0x90, 0x8c])

    def test_refused(self):
        with self.assertRaisesRegex(vspring.Error, "over: number 0 is"):
            vspring.colours([0], over=[np.inf])
        with self.assertRaisesRegex(vspring.Error, "number 1 is not finite"):
            vspring.colours([0, np.nan])

    def test_maps_are_those_of_the_page(self):
        page = (ROOT / "page/colours.js").read_text()
        for name, ours in (("sequential", vspring._curvature.SEQUENTIAL), ("diverging", vspring._curvature.DIVERGING)):
            self.assertEqual(re.search(rf"{name} = hex\('([^']+)'\)", page).group(1), ours)


class Chains(unittest.TestCase):
    def chains(self, edges):
        found = vspring.chains_of(edges)
        return [chain.tolist() for chain in found.chains], found.closed

    def test_open_closed_and_meeting(self):
        self.assertEqual(self.chains([(2, 1), (0, 1), (2, 3)]), ([[0, 1, 2, 3]], [False]))
        self.assertEqual(self.chains([(5, 6), (7, 6), (7, 5)]), ([[5, 6, 7]], [True]))
        self.assertEqual(self.chains([(0, 1), (1, 2), (1, 3), (0, 1)]), ([[0, 1], [1, 2], [1, 3]], [False] * 3))
        # A loop that hangs at a node where others meet starts and ends there.
        self.assertEqual(self.chains([(0, 1), (1, 2), (2, 3), (3, 1)]), ([[0, 1], [1, 2, 3]], [False, True]))
        self.assertEqual(self.chains(np.zeros((0, 2), int)), ([], []))

    def test_faired_as_in_a_row(self):
        curve = wave()
        edges = np.random.default_rng(0).permutation(np.column_stack([np.arange(59), np.arange(1, 60)]))
        one = vspring.fair_curve(curve, **vspring.chains_of(edges)._asdict())
        self.assertEqual(one.positions.tobytes(), vspring.fair_curve(curve).positions.tobytes())

    def test_refused(self):
        with self.assertRaisesRegex(vspring.Error, "node 3 to itself"):
            vspring.chains_of([(3, 3)])
        with self.assertRaisesRegex(vspring.Error, r"\(m, 2\)"):
            vspring.chains_of([0, 1])


if __name__ == "__main__":
    unittest.main()
