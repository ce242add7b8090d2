"""fair() and fair_curve(): results, what arrays go in and come out."""
import unittest
import warnings

import numpy as np
from support import Case, boundary_of, patch, vspring, wave


class SameAsTheCommandLine(Case):
    def test_surface(self):
        vertices, quads = patch()
        statuses = set()
        triangles = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
        for options, flags in [({}, []),
                               ({"fix_normals": "boundary"}, ["--fix-normals", "boundary"]),
                               ({"springs": "edge", "tolerance": 1e-8}, ["--springs", "edge", "--tolerance", 1e-8]),
                               ({"fair_by": "bending", "strength": 0.5}, ["--fair-by", "bending", "--strength", 0.5]),
                               ({"pseudo_normals": "angle", "distribution": "even"}, ["--pseudo-normals", "angle", "--distribution", "even"]),
                               ({"method": "multigrid", "levels": 2, "pre_smoothing": 3}, ["--method", "multigrid", "--levels", 2, "--pre-smoothing", 3]),
                               ({"method": "sweep", "step_tolerance": 0.01}, ["--method", "sweep", "--step-tolerance", 0.01]),
                               ({"max_iterations": 2}, ["--max-iterations", 2]), ({"paper": True}, ["--paper"]),
                               ({"paper": True, "method": "multigrid"}, ["--paper", "--method", "multigrid"]),
                               ({"paper": True, "method": "equilibrium"}, ["--paper", "--method", "equilibrium"]),
                               ({"paper": True, "weight": 0.1}, ["--paper", "--weight", 0.1])]:
            for faces in (quads, triangles):
                with self.subTest(options=options, faces=faces.shape), warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    positions, report = vspring.fair(vertices, faces, **options)
                    self.assert_same_bits(positions, self.by_command_line("fair", vertices, faces, *flags))
                    self.assertEqual(report.usable, self.status == 0)
                    statuses.add(self.status)
        self.assertEqual(statuses, {0, 3})

    def test_boundary_that_is_faired_first(self):
        vertices, faces = patch()
        corners = {0, 12, 156, 168}
        held = [{"nodes": sorted(corners), "position": "fixed"}]
        rules = self.folder / "rules.json"
        rules.write_text(str({"rules": held}).replace("'", '"'))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            positions, report = vspring.fair(vertices, faces, fair_boundary=True, fix=sorted(corners))
        self.assertEqual(report.boundary.outcome, "converged")
        self.assert_same_bits(positions, self.by_command_line("fair", vertices, faces, "--fair-boundary", "--constraints", rules))

    def test_curve(self):
        curve = wave()
        for options, flags in [({}, []), ({"fix_normals": "boundary"}, ["--fix-normals", "boundary"]), ({"paper": True}, ["--paper"]),
                               ({"region": np.flatnonzero(np.abs(curve[:, 0] - 1.5) < 0.5), "continuity": "curvature"}, ["--region", "box:1,-9,-9,2,9,9", "--continuity", "curvature"]),
                               ({"normal_plane": "principal"}, ["--normal-plane", "principal"])]:
            with self.subTest(options=options), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                self.assert_same_bits(vspring.fair_curve(curve, **options).positions,
                                      self.by_command_line("curve", curve, None, *flags))

    def test_paper_says_what_others_would(self):
        for options in ({"springs": "sphere"}, {"pseudo_normals": "angle"}):
            with self.subTest(options=options), self.assertRaisesRegex(vspring.Error, "paper says which"):
                vspring.fair(*patch(), paper=True, **options)
        with self.assertRaisesRegex(vspring.Error, "normal_plane: paper says which"):
            vspring.fair_curve(wave(), paper=True, normal_plane="full")


class Arrays(Case):
    def test_all_kinds_of_faces_give_the_same(self):
        vertices, quads = patch()
        expected = vspring.fair(vertices, quads).positions
        offsets = np.arange(0, quads.size + 1, 4)
        for faces in (quads.astype(np.int32), quads.astype(np.uint64), quads.tolist(), np.asfortranarray(quads), (quads.ravel(), offsets),
                      [tuple(face) for face in quads]):
            self.assert_same_bits(vspring.fair(vertices, faces).positions, expected)
        for given in (vertices.tolist(), np.asfortranarray(vertices), np.repeat(vertices, 2, axis=0)[::2]):
            self.assert_same_bits(vspring.fair(given, quads).positions, expected)

    def test_mixed_faces(self):
        vertices, quads = patch()
        mixed = quads[1:].tolist() + [quads[0, :3].tolist(), quads[0, [0, 2, 3]].tolist()]
        offsets = np.cumsum([0, *map(len, mixed)])
        self.assert_same_bits(vspring.fair(vertices, mixed).positions, vspring.fair(vertices, (np.concatenate(mixed), offsets)).positions)
        self.assert_same_bits(vspring.fair(vertices, mixed).positions, self.by_command_line("fair", vertices, mixed))

    def test_blocks_as_of_meshio(self):
        import meshio

        vertices, quads = patch()
        cells = [("quad", quads[1:]), ("triangle", np.array([quads[0, :3], quads[0, [0, 2, 3]]]))]
        meshio.write_points_cells(self.folder / "part.obj", vertices, cells)
        mesh = meshio.read(self.folder / "part.obj")
        self.assertEqual([block.type for block in mesh.cells], ["quad", "triangle"])
        blocks = [block.data for block in mesh.cells]
        mixed = [face.tolist() for block in blocks for face in block]
        self.assert_same_bits(vspring.fair(mesh.points, blocks).positions, vspring.fair(mesh.points, mixed).positions)
        self.assert_same_bits(vspring.fair(mesh.points, [quads]).positions, vspring.fair(mesh.points, quads).positions)

    def test_single_precision_comes_back_as_such(self):
        vertices, faces = patch()
        single = vertices.astype(np.float32)
        fair = vspring.fair(single, faces).positions
        self.assert_same_bits(fair, vspring.fair(single.astype(float), faces).positions.astype(np.float32))
        self.assert_same_bits(fair[boundary_of()], single[boundary_of()])

    def test_arguments_stay_as_they_are(self):
        vertices, faces = patch()
        before = vertices.copy(), faces.copy()
        vertices.flags.writeable = faces.flags.writeable = False
        positions = vspring.fair(vertices, faces).positions
        self.assert_same_bits(vertices, before[0])
        self.assert_same_bits(faces, before[1])
        self.assertFalse(np.shares_memory(positions, vertices))
        positions[0] = 0  # the caller's own

    def test_curve_in_a_plane(self):
        flat = wave()[:, :2]
        in_space = np.column_stack([flat, np.zeros(len(flat))])
        fair = vspring.fair_curve(flat).positions
        self.assertEqual(fair.shape, flat.shape)
        self.assert_same_bits(fair, np.ascontiguousarray(vspring.fair_curve(in_space).positions[:, :2]))

    def test_chains(self):
        curve = wave(40)
        loop = np.column_stack([np.cos(angle := np.arange(12) * np.pi / 6), np.sin(angle), 0.1 * np.cos(2 * angle)])
        both = np.vstack([curve, loop])
        chains = [np.arange(40), np.arange(40, 52)]
        fair = vspring.fair_curve(both, chains=chains, closed=[False, True], fix=[0, 39, 40, 44, 48]).positions
        np.testing.assert_allclose(fair[:40], vspring.fair_curve(curve).positions, atol=1e-4)
        self.assertAlmostEqual(np.ptp(np.linalg.norm(fair[40:, :2], axis=1)), 0, delta=0.02)


class Held(Case):
    def test_masks_and_numbers(self):
        vertices, faces = patch()
        mask = boundary_of()
        mask[60] = True
        by_mask = vspring.fair(vertices, faces, fix=mask).positions
        self.assert_same_bits(by_mask[mask], vertices[mask])
        self.assertTrue((by_mask[~mask] != vertices[~mask]).any(axis=1).all())
        self.assert_same_bits(by_mask, vspring.fair(vertices, faces, fix=np.flatnonzero(mask)).positions)
        self.assert_same_bits(vspring.fair(vertices, faces, fix=boundary_of()).positions, vspring.fair(vertices, faces).positions)

    def test_a_single_number(self):
        vertices, faces = patch()
        self.assertEqual(*(vspring.measure(vertices, faces, fix=node).greatest_turn for node in (84, [84])))
        for name in ("fix_normals", "region"):
            self.assert_same_bits(*(vspring.fair(vertices, faces, **{name: node}).positions for node in (84, [84])))

    def test_directions(self):
        vertices, faces = patch()
        self.assert_same_bits(vspring.fair(vertices, faces, fix_normals=boundary_of()).positions,
                              vspring.fair(vertices, faces, fix_normals="boundary").positions)
        curve = wave()
        ends = vspring.fair_curve(curve, fix_normals=[0, 59])
        self.assert_same_bits(ends.positions, vspring.fair_curve(curve, fix_normals="boundary").positions)
        self.assertEqual(ends.report.fixed_tangents, 2)


class Refused(Case):
    def assert_refused(self, code, words, call):
        with self.assertRaisesRegex(vspring.Error, words) as caught:
            call()
        self.assertEqual(caught.exception.code, code)
        self.assertIsInstance(caught.exception, ValueError)

    def test_with_a_code(self):
        vertices, faces = patch()
        refused = self.assert_refused
        refused("unusable-constraint", "nothing holds", lambda: vspring.fair(vertices, faces, fix="none"))
        refused("unusable-shape", "face 1", lambda: vspring.fair(vertices, [[0, 1, 2], [0, 2, 999]]))
        refused("unusable-constraint", "999", lambda: vspring.fair(vertices, faces, fix=[999]))
        refused("unusable-constraint", "-1", lambda: vspring.fair(vertices, faces, fix_normals=[-1]))
        refused("invalid-argument", "tolerance", lambda: vspring.fair(vertices, faces, tolerance=-1.0))
        refused("invalid-argument", "threads: 1 to", lambda: vspring.fair(vertices, faces, threads=-1))
        refused("invalid-argument", "method.*one of equilibrium", lambda: vspring.fair(vertices, faces, method="newton"))
        refused("invalid-argument", r"vertices.*\(n, 3\).*\(169, 2\)", lambda: vspring.fair(vertices[:, :2], faces))
        refused("invalid-argument", "vertices: not an array", lambda: vspring.fair([[0, 0, 0], [1, 2]], faces))
        refused("invalid-argument", "faces: whole numbers", lambda: vspring.fair(vertices, faces.astype(float)))
        refused("invalid-argument", "out of the range", lambda: vspring.fair(vertices, faces + 2**32))
        refused("invalid-argument", "mask of 169", lambda: vspring.fair(vertices, faces, fix=[True, False]))
        refused("invalid-argument", "fix:.*rim", lambda: vspring.fair(vertices, faces, fix="rim"))
        vertices[80, 1] = np.nan
        refused("unusable-shape", "node 80", lambda: vspring.fair(vertices, faces))

    def test_what_would_be_another_thing(self):
        vertices, faces = patch()
        for region in (np.zeros(169, bool), [], "sphere:9,9,9,0.1"):
            self.assert_refused("unusable-constraint", "region.*no node lies in it", lambda: vspring.fair(vertices, faces, region=region))
        for chains in (np.arange(60, dtype="i4"), [0, 1, 2], [[[0, 1]]]):
            self.assert_refused("invalid-argument", "a list of chains", lambda: vspring.fair_curve(wave(), chains=chains))
        for call in (lambda weld: vspring.fair(vertices, faces, weld=weld), lambda weld: vspring.find_sharp_edges(vertices, faces, angle=40, weld=weld)):
            for weld in (True, False, np.True_, "auto"):
                with self.assertRaisesRegex(TypeError, f"weld: a number is needed, not {weld!r}"):
                    call(weld)
        for options in ({"tolerance": True}, {"within": True}, {"max_iterations": True}):
            with self.assertRaisesRegex(TypeError, ": a (whole )?number is needed, not True"):
                vspring.fair(vertices, faces, **options)

    def test_errors_name_the_argument(self):
        vertices, faces = patch()
        for words, call in [("symmetry: .*not 5", lambda: vspring.fair(vertices, faces, symmetry=5)),
                            ("plane: .*not 5", lambda: vspring.find_symmetry(vertices, faces, plane=5)),
                            ("length: a number", lambda: vspring.refine(vertices, faces, length="x")),
                            ("turn: a number", lambda: vspring.refine(vertices, faces, turn=[20])),
                            ("angle: a number", lambda: vspring.find_sharp_edges(vertices, faces, angle=None)),
                            ("time_limit: a number", lambda: vspring.fair(vertices, faces, time_limit="x")),
                            ("threads: a whole number", lambda: vspring.measure(vertices, faces, threads="x")),
                            ("threads: a whole number", lambda: vspring.curvatures(vertices, faces, threads=1.5))]:
            with self.subTest(words), self.assertRaisesRegex(TypeError, words):
                call()
        ring = np.delete(faces, 70, axis=0)
        for words, call in [("^max_size is 0", lambda: vspring.fill(vertices, ring, max_size=0)),
                            ("^max_edges is 2", lambda: vspring.fill(vertices, ring, max_edges=2)),
                            ("^length is 0", lambda: vspring.span([vertices[:13]], length=0)),
                            ("threads: .*out of range", lambda: vspring.curvatures(vertices, faces, threads=2**40))]:
            self.assert_refused("invalid-argument", words, call)
        self.assertEqual(vspring.find_sharp_edges(vertices, faces, angle=179, threads=None).edges.shape, (0, 2))

    def test_arguments_of_another_kind(self):
        vertices, faces = patch()
        with self.assertRaisesRegex(TypeError, "no argument 'tolerence'"):
            vspring.fair(vertices, faces, tolerence=1e-6)
        with self.assertRaisesRegex(TypeError, "normal_plane"):
            vspring.fair(vertices, faces, normal_plane="full")
        with self.assertRaisesRegex(TypeError, "levels: a whole number is needed, not 'many'"):
            vspring.fair(vertices, faces, method="multigrid", levels="many")


class Told(Case):
    def test_report(self):
        vertices, faces = patch()
        positions, report = vspring.fair(vertices, faces, threads=1)
        self.assertTrue(report.converged)
        self.assertEqual((report.nodes, report.faces, report.moving_nodes, report.threads), (169, 144, 121, 1))
        self.assertEqual((report.fixed_positions, report.fixed_normals), (48, 0))
        self.assertLess(report.expected_error, 1e-5)
        self.assertEqual(len(report.history), report.iterations)
        self.assertEqual(report.levels[-1].moving_nodes, 121)
        moves = np.linalg.norm(positions - vertices, axis=1)
        self.assertAlmostEqual(report.greatest_move, moves.max(), delta=1e-12)
        self.assertLessEqual(len(repr(report).splitlines()), 3)
        self.assertIn("converged", repr(report))

    def test_warnings_have_codes(self):
        vertices, faces = patch()
        with self.assertWarns(vspring.Warning) as caught:
            report = vspring.fair(vertices, faces, fix=range(13)).report
        self.assertEqual(caught.filename, __file__)
        self.assertEqual(caught.warning.code, "free-boundary")
        self.assertIn(caught.warning.code, [warning.code for warning in report.warnings])
        self.assertIn("free-boundary", repr(report))


class Measured(Case):
    def test_closed_forms(self):
        vertices, faces = patch(cells=24, noise=0)
        figures = vspring.measure(vertices, faces)
        x, y = vertices[:, 0], vertices[:, 1]
        self.assertAlmostEqual(figures.diagonal, np.linalg.norm(np.ptp(vertices, axis=0)), places=12)
        self.assertAlmostEqual(figures.area, np.sqrt(1 + x * x + y * y).mean() * 4, delta=0.1)
        self.assertEqual(figures["self_intersections"].value, 0)
        self.assertEqual(figures["greatest_turn"].unit, "°")
        angle = np.arange(100) * 2 * np.pi / 100
        circle = vspring.measure(3 * np.column_stack([np.cos(angle), np.sin(angle)]), closed=True)
        self.assertAlmostEqual(circle.length, 6 * np.pi, delta=0.02)
        self.assertAlmostEqual(circle.curvature_variation, 0, delta=1e-9)

    def test_places_that_are_no_numbers(self):
        vertices, faces = patch()
        vertices[[20, 30], 1] = np.nan
        curve, ring = wave(), wave()
        curve[7], ring[0] = np.inf, np.nan
        for node, call in [(20, lambda: vspring.measure(vertices, faces)), (7, lambda: vspring.measure(curve)),
                           (0, lambda: vspring.measure(ring, closed=True, region=[59]))]:
            with self.assertRaisesRegex(vspring.Error, f"node {node}: a coordinate is not finite") as caught:
                call()
            self.assertEqual(caught.exception.code, "unusable-shape")

    def test_only_what_moves(self):
        vertices, faces = patch()
        vertices[84, 2] += 0.5
        far = vspring.measure(vertices, faces, fix=np.arange(169) != 14)
        self.assertLess(far.greatest_turn, vspring.measure(vertices, faces).greatest_turn / 2)
        vertices[14] = np.nan
        self.assertGreater(vspring.measure(vertices, faces, region=[84]).bending_energy, 0)
        with self.assertRaisesRegex(AttributeError, "no figure 'beauty'"):
            far.beauty
        self.assertIn("bending energy", repr(far))


if __name__ == "__main__":
    unittest.main()
