"""New nodes, welded ones, and rows in no order."""
import unittest
import warnings

import numpy as np
from support import Case, boundary_of, patch, vspring, wave


def in_two_parts(cells=12):
    """A patch whose nodes come twice along the middle, and faces that do not meet there."""
    vertices, quads = patch(cells)
    row = np.arange(len(vertices)) // (cells + 1)
    seam = np.flatnonzero(row == cells // 2)
    number = np.arange(len(vertices))
    number[seam] = len(vertices) + np.arange(len(seam))
    beyond = row[quads].min(axis=1) >= cells // 2
    return np.vstack([vertices, vertices[seam]]), np.where(beyond[:, None], number[quads], quads), seam


class NewNodes(Case):
    def test_same_as_the_command_line(self):
        curve = wave()
        held = [0, 20, 59]
        rules = self.folder / "rules.json"
        rules.write_text(f'{{"rules": [{{"nodes": {held}, "position": "fixed"}}]}}')
        for options, flags in [({"resample": 90}, ["--resample", 90]),
                               ({"spacing": 0.11, "resample_by": "cosine"}, ["--spacing", 0.11, "--resample-by", "cosine"]),
                               ({"resample": 40, "within": 0.05}, ["--resample", 40, "--within", 0.05]),
                               ({"resample": 70, "rms": 0.02, "resample_by": "curvature"},
                                ["--resample", 70, "--rms", 0.02, "--resample-by", "curvature"])]:
            with self.subTest(options=options), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                found = vspring.fair_curve(curve, fix=held, **options)
                self.assert_same_bits(found.positions, self.by_command_line("curve", curve, None, "--constraints", rules, *flags))

    def test_corners_stay(self):
        line = np.linspace(0, 1, 12)
        bent = np.vstack([np.column_stack([line, 0 * line, 0 * line]), np.column_stack([1 + 0 * line, line, 0 * line])[1:]])
        found = vspring.fair_curve(bent, resample=40, sharp=60)
        self.assertEqual(found.report.corners, 1)
        self.assertLess(np.linalg.norm(found.positions - [1, 0, 0], axis=1).min(), 1e-12)
        self.assert_same_bits(found.positions, self.by_command_line("curve", bent, None, "--resample", 40, "--sharp", 60))

    def test_report_says_where_nodes_come_from(self):
        curve = wave().astype(np.float32)
        positions, report = vspring.fair_curve(curve, fix=[0, 20, 59], resample=90)
        self.assertEqual((positions.shape, positions.dtype), ((90, 3), np.float32))
        self.assertEqual(report.origin.tolist().count(-1), 87)
        kept = np.flatnonzero(report.origin >= 0)
        self.assertEqual(report.origin[kept].tolist(), [0, 20, 59])
        self.assert_same_bits(positions[kept], curve[[0, 20, 59]])
        self.assertEqual([chain.tolist() for chain in report.chains], [list(range(90))])
        self.assertIsNone(vspring.fair_curve(curve).report.origin)

    def test_what_goes_together(self):
        for options in ({"resample": 30, "spacing": 0.1}, {"resample_by": "cosine"}):
            with self.subTest(options=options), self.assertRaisesRegex(vspring.Error, "resampling needs|resample_by is for"):
                vspring.fair_curve(wave(), **options)


class WeldedNodes(Case):
    def test_same_as_the_command_line(self):
        vertices, quads, seam = in_two_parts()
        rules = self.folder / "rules.json"
        rules.write_text(f'{{"rules": [{{"nodes": [{len(vertices) - 4}], "position": "fixed"}}]}}')
        for options, flags in [({"weld": 0}, ["--weld", 0]), ({"weld": 1e-6, "fix_normals": "boundary"}, ["--weld", 1e-6, "--fix-normals", "boundary"]),
                               ({"weld": 0, "constraints": rules}, ["--weld", 0, "--constraints", rules]),
                               ({"weld": 0, "rms": 0.012}, ["--weld", 0, "--rms", 0.012]), ({"weld": 0, "noise": 0.02}, ["--weld", 0, "--noise", 0.02])]:
            with self.subTest(options=options), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                positions, report = vspring.fair(vertices, quads, **options)
                self.assert_same_bits(positions, self.by_command_line("fair", vertices, quads, *flags))
                self.assert_same_bits(positions[seam], positions[-len(seam):])

    def test_a_node_that_another_stands_for_can_be_held(self):
        vertices, quads, seam = in_two_parts()
        twin = len(vertices) - 4
        rim = np.append(boundary_of(), np.zeros(len(seam), bool))
        rim[twin] = True
        positions = vspring.fair(vertices, quads, weld=0, fix=rim).positions
        self.assert_same_bits(positions[[twin, seam[-4]]], vertices[[twin, seam[-4]]])
        with self.assertRaisesRegex(vspring.Error, "numbers 0 to"):
            vspring.fair(vertices, quads, weld=0, fix=[len(vertices)])

    def test_measure(self):
        vertices, quads, _ = in_two_parts()
        whole = vspring.measure(*patch())
        self.assertEqual(vspring.measure(vertices, quads, weld=0).bending_energy, whole.bending_energy)
        self.assertNotEqual(vspring.measure(vertices, quads).bending_energy, whole.bending_energy)

    def test_curves_are_refused(self):
        with self.assertRaisesRegex(vspring.Error, "surfaces"):
            vspring.fit(wave(), points=wave(), weld=0, weight=1)


class Order(Case):
    def test_rows_in_no_order(self):
        curve = wave(noise=0)
        shuffled = np.random.default_rng(3).permutation(len(curve))
        found = shuffled[vspring.order(curve[shuffled])]
        self.assertIn(found.tolist(), [list(range(60)), list(range(59, -1, -1))])
        angle = np.random.default_rng(4).permutation(50) * 2 * np.pi / 50
        ring = np.column_stack([np.cos(angle), np.sin(angle)])
        around = ring[vspring.order(ring, closed=True)]
        steps = np.linalg.norm(around - np.roll(around, 1, axis=0), axis=1)
        self.assertLess(steps.max(), 1.01 * steps.min())


if __name__ == "__main__":
    unittest.main()
