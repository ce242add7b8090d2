"""Sharp edges."""
import json

import numpy as np

from support import Case, vspring, write_obj


def roof(cells=12, noise=0.003):
    """Two planes that meet at y = 0.5, with noise inside: vertices, quads and the nodes of the ridge."""
    line = np.linspace(0, 1, cells + 1)
    x, y = (one.ravel() for one in np.meshgrid(line, line, indexing="ij"))
    vertices = np.column_stack([x, y, -np.abs(y - 0.5)])
    inside = (np.abs(x - 0.5) < 0.49) & (np.abs(y - 0.5) < 0.49) & (y != 0.5)
    vertices[inside] += noise * np.random.default_rng(3).standard_normal((inside.sum(), 3))
    node = np.arange(len(vertices)).reshape(cells + 1, cells + 1)
    quads = np.stack([node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]], axis=-1).reshape(-1, 4)
    return vertices, quads, np.flatnonzero(y == 0.5)


def off(positions):
    """How far the furthest node is from the two planes."""
    return np.abs(positions[:, 2] + np.abs(positions[:, 1] - 0.5)).max()


class Sharp(Case):
    def test_they_are_found_with_their_chains(self):
        vertices, faces, ridge = roof()
        found = vspring.find_sharp_edges(vertices, faces, angle=40)
        np.testing.assert_array_equal(found.edges, np.column_stack([ridge[:-1], ridge[1:]]))
        self.assertEqual(([*found.chains[0]] in ([*ridge], [*ridge[::-1]]), found.closed, len(found.corners)), (True, [False], 0))
        np.testing.assert_allclose(found.lengths, [1])
        self.assertEqual(len(vspring.find_sharp_edges(vertices, faces, angle=100).edges), 0)
        noisy = vertices + 0.02 * np.random.default_rng(2).standard_normal(vertices.shape)
        with_edges_of_noise = vspring.find_sharp_edges(noisy, faces, angle=30)
        for noise in (0.02, "auto"):
            self.assertLess(len(vspring.find_sharp_edges(noisy, faces, angle=30, noise=noise).edges), len(with_edges_of_noise.edges))
        for wrong in ({"angle": 0}, {"angle": 40, "noise": "much"}):
            with self.assertRaises(vspring.Error):
                vspring.find_sharp_edges(vertices, faces, **wrong)

    def test_each_side_is_fair_by_itself(self):
        vertices, faces, _ = roof()
        self.assertGreater(off(vspring.fair(vertices, faces).positions), 0.01)
        found = vspring.find_sharp_edges(vertices, faces, angle=40)
        for edges in (found, found.edges, found.edges.tolist(), found.edges[:, ::-1].astype(np.int64)):
            positions, report = vspring.fair(vertices, faces, sharp_edges=edges, tolerance=1e-12)
            self.assertLess(off(positions), 1e-9)
            self.assertEqual(report.sharp_edges, 12)
        self.assertEqual(vspring.fair(vertices, faces, sharp_edges=np.zeros((0, 2), int)).report.sharp_edges, 0)

    def test_results_are_those_of_the_command_line(self):
        vertices, faces, _ = roof()
        for options, words in (({}, []), ({"fix_normals": "boundary"}, ["--fix-normals", "boundary"]),
                               ({"sharp_curves": "fit"}, ["--sharp-curves", "fit"]), ({"within": 0.01, "sharp": 40}, ["--within", 0.01])):
            edges = vspring.find_sharp_edges(vertices, faces, angle=40, noise="auto" if "within" in options else 0)
            positions = vspring.fair(vertices, faces, sharp_edges=edges, **options).positions
            np.testing.assert_array_equal(positions, self.by_command_line("fair", vertices, faces, "--sharp", 40, *words), str(options))

    def test_rules_and_files_name_them(self):
        vertices, faces, ridge = roof()
        expected = vspring.fair(vertices, faces, sharp_edges=np.column_stack([ridge[:-1], ridge[1:]])).positions
        mask = np.zeros(len(vertices), bool)
        mask[ridge] = True
        path = self.folder / "rules.json"
        path.write_text(json.dumps({"rules": [{"nodes": ridge.tolist(), "sharp": "path"}]}))
        for rules in ([{"nodes": ridge, "sharp": "path"}], [{"nodes": mask, "sharp": True}], path):
            np.testing.assert_array_equal(vspring.fair(vertices, faces, constraints=rules).positions, expected)
        np.testing.assert_array_equal(self.by_command_line("fair", vertices, faces, "--constraints", path), expected)
        marked = self.folder / "marked.obj"
        write_obj(marked, vertices, faces)
        with marked.open("a") as more:
            more.write("l " + " ".join(str(k + 1) for k in ridge) + "\n")
        surface = vspring.read(marked)
        np.testing.assert_array_equal(surface.marked_edges, np.column_stack([ridge[:-1], ridge[1:]]))
        np.testing.assert_array_equal(vspring.fair(surface, sharp_edges=surface.marked_edges).positions, expected)

    def test_of_welded_and_refined_surfaces(self):
        vertices, faces, ridge = roof(8)
        apart = vertices[faces.ravel()]
        soup = np.arange(len(apart)).reshape(-1, 4)
        # Each side of the ridge by nodes of its own.
        beside = [[face[k], face[(k + 1) % 4]] for face, own in zip(soup, faces) for k in range(4)
                  if own[k] in ridge and own[(k + 1) % 4] in ridge]
        report = vspring.fair(apart, soup, weld=0, sharp_edges=beside).report
        self.assertEqual(report.sharp_edges, 8)
        edges = vspring.find_sharp_edges(vertices, faces, angle=40).edges
        refined = vspring.refine(vertices, faces, length=0.08)
        parts = refined.parts_of(edges)
        self.assertEqual(parts.shape, (16, 2))
        self.assertEqual(vspring.fair(refined.vertices, refined.faces, sharp_edges=parts).report.sharp_edges, 16)

    def test_sessions_keep_them(self):
        vertices, faces, ridge = roof()
        edges = vspring.find_sharp_edges(vertices, faces, angle=40)
        for options in ({"sharp_edges": edges}, {"constraints": [{"nodes": ridge, "sharp": "path"}]}):
            session = vspring.Session(vertices, faces, **options)
            np.testing.assert_array_equal(session.fair().positions, vspring.fair(vertices, faces, sharp_edges=edges).positions)
            session.hold(30, vertices[30] + [0, 0, 0.05])
            self.assertEqual(session.update().report.sharp_edges, 12)

    def test_a_fit_keeps_them(self):
        vertices, faces, ridge = roof()
        points = vertices + [0, 0, 0.01]
        edges = vspring.find_sharp_edges(vertices, faces, angle=40)
        positions, report = vspring.fit(vertices, faces, points, smoothing_length=0.05, sharp_edges=edges)
        np.testing.assert_array_equal(positions[ridge], vertices[ridge])
        self.assertEqual(report.sharp_edges, 12)

    def test_bad_ones_are_refused_with_the_reason(self):
        vertices, faces, ridge = roof()
        for edges, why in (([[0, 1]], "boundary"), ([[0, 40]], "no face has this edge"), ([[0, 999]], "there is no node 999"), ([0, 1], "(k, 2)"),
                           ([[0, 1.5]], "whole numbers")):
            with self.assertRaises(vspring.Error) as raised:
                vspring.fair(vertices, faces, sharp_edges=edges)
            self.assertIn(why, str(raised.exception))
        for call in (lambda: vspring.fit(vertices[:5], within=0.1, sharp_edges=[[0, 1]]),
                     lambda: vspring.Session(vertices, faces, sharp_edges=[[0, 1]]),
                     lambda: vspring.fair(vertices, faces, constraints=[{"nodes": ridge[::2], "sharp": "path"}])):
            with self.assertRaises(vspring.Error):
                call()


if __name__ == "__main__":
    import unittest
    unittest.main()
