"""Rules and regions in all their forms."""
import json
import unittest

import numpy as np
from support import Case, boundary_of, patch, vspring, wave

RULES = [{"nodes": "boundary", "position": "fixed"},
         {"nodes": [60, 84], "position": [[-0.3, 0.1, 0.2], [0, 0, 0.3]]},
         {"nodes": [110], "normal": [0.1, 0, 1]}]


class Rules(Case):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "rules.json"
        self.path.write_text(json.dumps({"rules": RULES}))

    def test_file_dict_and_list_hold_as_the_command_line(self):
        vertices, faces = patch()
        expected = self.by_command_line("fair", vertices, faces, "--constraints", self.path)
        for rules in (self.path, str(self.path), {"rules": RULES}, RULES, tuple(RULES)):
            positions, report = vspring.fair(vertices, faces, constraints=rules)
            self.assert_same_bits(positions, expected)
        self.assertEqual(positions[60].tolist(), [-0.3, 0.1, 0.2])
        self.assertEqual((report.fixed_positions, report.fixed_normals), (50, 1))

    def test_nodes_slide(self):
        vertices, faces = patch()
        side = np.flatnonzero(vertices[:, 0] > vertices[:, 0].max() - 1e-9)[1:-1].tolist()
        place = float(vertices[:, 0].max())
        rules = [{"nodes": "boundary", "position": "fixed", "normal": "fixed"},
                 {"nodes": side, "slide": {"plane": {"point": [place, 0, 0], "normal": [1, 0, 0]}}}]
        positions, report = vspring.fair(vertices, faces, constraints=rules)
        self.assertEqual(report.sliding_nodes, len(side))
        self.assertTrue(np.all(np.abs(positions[side, 0] - place) < 1e-15))

    def test_arrays_in_rules(self):
        vertices, faces = patch()
        mask = np.zeros(169, bool)
        mask[[60, 84]] = True
        rules = [RULES[0], {"nodes": mask, "position": np.array(RULES[1]["position"])}, {"nodes": np.array([110]), "normal": np.float32([0.5, 0, 5])}]
        exact = [*RULES[:2], {"nodes": [110], "normal": [0.5, 0, 5]}]
        self.assert_same_bits(vspring.fair(vertices, faces, constraints=rules).positions,
                              vspring.fair(vertices, faces, constraints=exact).positions)

    def test_tangents(self):
        curve = wave()
        rules = [{"nodes": [0], "tangent": [1, 0, 0]}, {"nodes": [30], "position": "fixed", "tangent": "fixed"}]
        self.path.write_text(json.dumps({"rules": rules}))
        positions, report = vspring.fair_curve(curve, constraints=rules)
        self.assertEqual((report.fixed_positions, report.fixed_tangents), (3, 2))
        self.assert_same_bits(positions, self.by_command_line("curve", curve, None, "--constraints", self.path))

    def test_faults_name_file_and_rule(self):
        vertices, faces = patch()
        self.path.write_text('{"rules": [{"nodes": [999], "position": "fixed"}]}')
        for rules, words in [(self.path, "rules.json: .*999"), ([{"nodes": [999], "position": "fixed"}], "999"),
                             ({"rule": []}, "rules"), ([{"nodes": np.array([True]), "position": "fixed"}], "mask of 169")]:
            with self.assertRaisesRegex(vspring.Error, words):
                vspring.fair(vertices, faces, constraints=rules)
        with self.assertRaises(vspring.Error) as caught:
            vspring.fair(vertices, faces, constraints=self.folder / "none.json")
        self.assertEqual(caught.exception.code, "unusable-file")


class Regions(Case):
    def test_all_forms_hold_as_the_command_line(self):
        vertices, faces = patch()
        inside = np.linalg.norm(vertices, axis=1) <= 0.6
        listed = self.folder / "nodes.json"
        listed.write_text(json.dumps(np.flatnonzero(inside).tolist()))
        expected = self.by_command_line("fair", vertices, faces, "--region", "sphere:0,0,0,0.6")
        for region in ("sphere:0,0,0,0.6", inside, np.flatnonzero(inside), str(listed)):
            positions = vspring.fair(vertices, faces, region=region).positions
            self.assert_same_bits(positions, expected)
        self.assert_same_bits(positions[~inside], vertices[~inside])
        self.assertTrue((positions[inside] != vertices[inside]).any())

    def test_of_a_boundary_that_is_faired(self):
        vertices, faces = patch()
        region = vertices[:, 0] > 0.3
        fair = vspring.fair(vertices, faces, fair_boundary=True, region=region, constraints=[{"nodes": [156, 168], "position": "fixed"}])
        self.assertIsNotNone(fair.report.boundary)
        self.assert_same_bits(fair.positions[~region], vertices[~region])
        rim = region & boundary_of()
        self.assertTrue((fair.positions[rim] != vertices[rim]).any())


if __name__ == "__main__":
    unittest.main()
