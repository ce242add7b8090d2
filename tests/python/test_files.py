"""Files, and all that they carry."""
import subprocess
import unittest
import warnings

import numpy as np
from support import BUILD, ROOT, Case, patch, vspring, wave

EXAMPLES = ROOT / "examples"


class Surfaces(Case):
    def test_formats(self):
        vertices, faces = patch()
        triangles = np.vstack([faces[:, :3], faces[:, [0, 2, 3]]])
        for extension, held in [("obj", vertices), ("off", vertices), ("ply", vertices), ("stl", vertices.astype(np.float32).astype(float))]:
            path = self.folder / f"shape.{extension}"
            vspring.write(path, vertices, triangles)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # corners of STL are welded
                surface = vspring.read(path)
            self.assertEqual(surface.format, extension)
            self.assertEqual(surface.faces.shape, triangles.shape)
            self.assert_same_bits(surface.vertices[surface.faces], held[triangles])
        mixed = faces[1:].tolist() + [faces[0, :3].tolist()]
        vspring.write(self.folder / "mixed.off", vertices, mixed)
        corners, offsets = vspring.read(self.folder / "mixed.off").faces
        self.assert_same_bits(corners, np.concatenate(mixed).astype(np.int32))
        self.assert_same_bits(offsets, np.cumsum([0, *map(len, mixed)]).astype(np.int32))

    def test_a_file_keeps_what_it_carried(self):
        given, fair, expected = (self.folder / name for name in ("given.obj", "fair.obj", "expected.obj"))
        given.write_text("# from a CAD program\nmtllib car.mtl\n" + (EXAMPLES / "annulus.obj").read_text().replace("f ", "usemtl red\nf ", 1))
        subprocess.run([BUILD / "vspring", "fair", given, "-o", expected, "--quiet"], check=True)
        surface = vspring.read(given)
        positions, report = vspring.fair(surface)
        vspring.write(fair, positions, source=surface)
        self.assertEqual(fair.read_bytes(), expected.read_bytes())
        vspring.write(fair, surface)
        self.assertEqual(fair.read_bytes(), given.read_bytes())

    def test_losses_are_warned_of(self):
        given = self.folder / "given.obj"
        given.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\ng rim\nf 1/1 2/1 3/1\n")
        surface = vspring.read(given)
        self.assertEqual(surface.groups["rim"].tolist(), [0, 1, 2])
        with self.assertWarns(vspring.Warning) as caught:
            vspring.write(self.folder / "other.off", surface)
        self.assertEqual((caught.warning.code, caught.filename), ("writing", __file__))

    def test_groups_and_normals_of_the_file_in_rules(self):
        path = EXAMPLES / "figure-8.obj"
        surface = vspring.read(path)
        group = self.folder / "group.obj"
        lines = path.read_text().splitlines()
        first = next(k for k, line in enumerate(lines) if line.startswith("f "))
        group.write_text("\n".join([*lines[:first], "g part", *lines[first:first + 8], "g rest", *lines[first + 8:]]) + "\n")
        surface = vspring.read(group)
        inside = surface.groups["part"]
        fair = vspring.fair(surface, constraints=[{"nodes": {"group": "part"}, "position": "fixed"}]).positions
        self.assert_same_bits(fair[inside], surface.vertices[inside])
        by_region = vspring.fair(surface, region="group:rest").positions
        outside = np.setdiff1d(np.arange(len(fair)), surface.groups["rest"])
        self.assert_same_bits(by_region[outside], surface.vertices[outside])

    def test_arrays_are_read_only_views_that_outlive_the_file(self):
        surface = vspring.read(EXAMPLES / "annulus.obj")
        vertices, faces = surface.vertices, surface.faces
        self.assertTrue(np.shares_memory(vertices, surface.vertices))
        with self.assertRaises(ValueError):
            vertices[0] = 0
        before = vertices.copy()
        del surface
        self.assert_same_bits(vertices, before)
        self.assertEqual(faces.dtype, np.int32)
        self.assert_same_bits(vspring.fair(vertices, faces).positions, vspring.fair(vspring.read(EXAMPLES / "annulus.obj")).positions)


class Examples(Case):
    def test_files_are_those_of_the_command_line(self):
        for name, call, options, flags in [("annulus.obj", vspring.fair, {"fix_normals": "boundary"}, ["fair", "--fix-normals", "boundary"]),
                                           ("pipe-blend.obj", vspring.fair, {}, ["fair"]),
                                           ("saddle.ply", vspring.fair, {"noise": "auto"}, ["fair", "--noise", "auto"]),
                                           ("spot.obj", vspring.fair, {"constraints": EXAMPLES / "spot-horns.json"},
                                            ["fair", "--constraints", EXAMPLES / "spot-horns.json"]),
                                           ("trefoil.obj", vspring.fair_curve, {"constraints": EXAMPLES / "trefoil.json"},
                                            ["curve", "--constraints", EXAMPLES / "trefoil.json"]),
                                           ("naca-2412.dat", vspring.fair_curve, {"within": 0.0003}, ["curve", "--within", "0.0003"]),
                                           ("track.csv", vspring.fair_curve, {"smoothing_length": 20.0}, ["curve", "--smoothing-length", "20"])]:
            with self.subTest(name), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                fair, expected = self.folder / ("fair-" + name), self.folder / ("expected-" + name)
                done = subprocess.run([BUILD / "vspring", *flags, EXAMPLES / name, "-o", expected, "--quiet"], capture_output=True, text=True)
                self.assertIn(done.returncode, (0, 3), done.stderr)
                shape = vspring.read(EXAMPLES / name)
                vspring.write(fair, call(shape, **options).positions, source=shape)
                self.assertEqual(fair.read_bytes(), expected.read_bytes())


class Curves(Case):
    def test_formats(self):
        flat = wave()[:, :2]
        for extension in ("csv", "xyz", "dat"):
            path = self.folder / f"curve.{extension}"
            vspring.write(path, flat)
            curve = vspring.read(path)
            self.assertEqual((curve.format, curve.closed), (extension, [False]))
            self.assert_same_bits(curve.vertices, flat)
        vspring.write(self.folder / "curve.obj", wave(), chains=[np.arange(30), np.arange(30, 60)], closed=[False, True])
        curve = vspring.read(self.folder / "curve.obj")
        self.assertEqual([chain.tolist() for chain in curve.chains], [list(range(30)), list(range(30, 60))])
        self.assertEqual(curve.closed, [False, True])
        self.assert_same_bits(curve.vertices, wave())

    def test_a_table_keeps_its_other_columns(self):
        given, fair, expected = (self.folder / name for name in ("given.csv", "fair.csv", "expected.csv"))
        rows = [f"{k},{x!r},{y!r},point {k}" for k, (x, y) in enumerate(wave()[:, :2].tolist())]
        given.write_text("number,x,y,name\n" + "\n".join(rows) + "\n")
        subprocess.run([BUILD / "vspring", "curve", given, "-o", expected, "--within", "0.05", "--move", "y", "--quiet"], check=True)
        curve = vspring.read(given)
        vspring.write(fair, vspring.fair_curve(curve, within=0.05, move="y").positions, source=curve)
        self.assertEqual(fair.read_bytes(), expected.read_bytes())
        by_number = vspring.read(given, columns=[2, 1])
        self.assert_same_bits(by_number.vertices[:, 0], np.ascontiguousarray(curve.vertices[:, 0]))
        self.assertEqual(by_number.vertices[:, 1].tolist(), list(range(60)))

    def test_chains_of_a_file_are_closed_where_closed_says_so(self):
        vspring.write(self.folder / "open.csv", wave())
        curve = vspring.read(self.folder / "open.csv")
        self.assertEqual(vspring.measure(curve, closed=True).length, vspring.measure(wave(), closed=True).length)
        expected = vspring.fair_curve(wave(), within=0.1, closed=True).positions
        for call in (vspring.fair_curve, vspring.fit):
            self.assert_same_bits(call(curve, within=0.1, closed=[True]).positions, expected)
        vspring.write(self.folder / "closed.obj", wave(), closed=True)
        ring = vspring.read(self.folder / "closed.obj")
        self.assertEqual(vspring.measure(ring).length, vspring.measure(wave(), closed=True).length)
        self.assertEqual(vspring.measure(ring, closed=False).length, vspring.measure(wave()).length)

    def test_a_ring_whose_last_row_repeats_the_first(self):
        angle = np.arange(60) * 2 * np.pi / 60
        ring = (1 + 0.02 * np.cos(23 * angle))[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
        expected = vspring.fair_curve(ring, within=0.1, closed=True).positions
        repeated = np.concatenate([ring, ring[:1]])
        vspring.write(self.folder / "ring.csv", repeated)
        file = vspring.read(self.folder / "ring.csv")
        for given in (repeated, file):
            for call in (vspring.fair_curve, vspring.fit):
                found = call(given, within=0.1, closed=True).positions
                self.assert_same_bits(found[-1], found[0])
                np.testing.assert_allclose(found[:-1], expected, atol=0.01)
            self.assertEqual(vspring.measure(given, closed=True).length, vspring.measure(ring, closed=True).length)
            # Either of the two holds both.
            place = 1.1 * repeated[60]
            for node in (0, 60):
                rule = [{"nodes": [node], "position": place}, {"nodes": [30], "position": "fixed"}]
                fair = vspring.fair_curve(given, closed=True, constraints=rule).positions
                self.assertEqual(fair[[0, 60]].tolist(), [place.tolist()] * 2)
            self.assertEqual(vspring.fair_curve(given, closed=True, fix=[20, 60]).positions[0].tolist(), ring[0].tolist())
        session = vspring.Session(repeated, closed=True, fix=[20, 40])
        session.hold(60, [1.5, 0])
        positions, _ = session.update()
        self.assertEqual(positions[[0, 60]].tolist(), [[1.5, 0]] * 2)
        self.assertEqual(len(np.unique(vspring.fair_curve(repeated, closed=True, within=0.1, resample=61).positions, axis=0)), 61)
        vspring.write(self.folder / "again.csv", repeated, closed=True)
        self.assertEqual((self.folder / "again.csv").read_text(), (self.folder / "ring.csv").read_text())
        # An aerofoil looks the same.
        self.assertEqual(vspring.fair_curve(repeated, within=0.1).positions[0].tolist(), ring[0].tolist())

    def test_faces_and_chains_of_a_file_are_its_own(self):
        vspring.write(self.folder / "curve.csv", wave())
        curve, surface = vspring.read(self.folder / "curve.csv"), vspring.read(EXAMPLES / "annulus.obj")
        for words, call in [("faces", lambda: vspring.fair(surface, surface.faces)), ("faces", lambda: vspring.measure(surface, [[0, 1, 2]])),
                            ("faces", lambda: vspring.Session(surface, surface.faces)), ("chains", lambda: vspring.fair_curve(curve, chains=[[0, 1, 2]])),
                            ("closed: that is for curves", lambda: vspring.measure(surface, closed=True)),
                            ("chains: that is for curves", lambda: vspring.fit(*patch(), chains=[[0, 1]], weight=1)),
                            ("closed are those of the source", lambda: vspring.write(self.folder / "out.csv", curve, closed=True))]:
            with self.subTest(words), self.assertRaisesRegex(vspring.Error, words):
                call()

    def test_aerofoils_and_pictures(self):
        aerofoil = vspring.read(EXAMPLES / "naca-2412.dat")
        self.assertEqual(aerofoil.vertices.shape[1], 2)
        self.assertEqual(vspring.measure(aerofoil).diagonal, vspring.measure(aerofoil.vertices).diagonal)
        vspring.write(self.folder / "picture.svg", aerofoil)
        self.assertIn("<svg", (self.folder / "picture.svg").read_text()[:200])

    def test_refused(self):
        missing = self.folder / "none.ply"
        annulus = vspring.read(EXAMPLES / "annulus.obj")
        for code, call in [("unusable-file", lambda: vspring.read(missing)), ("unusable-file", lambda: vspring.read(EXAMPLES / "wave.json")),
                           ("invalid-argument", lambda: vspring.read(EXAMPLES / "annulus.obj", format="step")),
                           ("invalid-argument", lambda: vspring.write(self.folder / "out.obj", np.zeros((3, 3)), source=annulus)),
                           ("invalid-argument", lambda: vspring.write(self.folder / "out.obj", annulus.vertices[:, :2], source=annulus)),
                           ("unusable-file", lambda: vspring.write(self.folder / "no" / "out.obj", *patch()))]:
            with self.assertRaises(vspring.Error) as caught:
                call()
            self.assertEqual(caught.exception.code, code)


if __name__ == "__main__":
    unittest.main()
