"""What --weld makes of nodes at about the same place: the shape of the mesh that they were meant to be, in the file as it came."""
import random
import struct

from support import Case, bumps, grid, parsed, run, vertex_lines

SIZE = 8


def moved(node, generator, share):
    return tuple(x + share * generator.uniform(-1, 1) for x in node)


def soup(share=0.0):
    """The grid with corners of its own for every face, each up to share off along every axis."""
    nodes, faces = parsed(grid(SIZE))
    generator = random.Random(1)
    lines = ["# a soup"]
    for face in faces:
        lines += ["v {!r} {!r} {!r}".format(*moved(nodes[node], generator, share)) for node in face] + ["f -3 -2 -1 # a face"]
    return "\n".join(lines) + "\n"


def stl(share=0.0, offset=0.0):
    """The grid as binary STL, corners up to share off along every axis."""
    nodes, faces = parsed(grid(SIZE))
    generator = random.Random(1)
    data = b"\0" * 80 + struct.pack("<I", len(faces))
    for face in faces:
        corners = [[x + offset for x in moved(nodes[node], generator, share)] for node in face]
        data += struct.pack("<12fH", 0, 0, 1, *(x for corner in corners for x in corner), 7)
    return data


def corners_of_stl(data):
    count, = struct.unpack_from("<I", data, 80)
    return [struct.unpack_from("<3f", data, 84 + 50 * facet + 12 * k) for facet in range(count) for k in (1, 2, 3)]


def seam():
    """The grid with a row of nodes twice, each with texture coordinates and a normal of its own, and how both are numbered."""
    nodes, faces = parsed(grid(SIZE))
    row = SIZE + 1
    twin = {node: len(nodes) + k for k, node in enumerate(range(4 * row, 5 * row))}
    doubled = nodes + [nodes[node] for node in twin]
    above = [any(node >= 5 * row for node in face) for face in faces]
    faces = [[twin.get(node, node) if upper else node for node in face] for face, upper in zip(faces, above)]
    lines = ["ply", "format ascii 1.0", "comment seam", f"element vertex {len(doubled)}"]
    lines += [f"property double {name}" for name in ("x", "y", "z", "s", "t")]
    lines += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    lines += ["{!r} {!r} {!r} {} 0.5".format(*node, k) for k, node in enumerate(doubled)]
    lines += ["3 {} {} {}".format(*face) for face in faces]
    return "\n".join(lines) + "\n", twin


class Soup(Case):
    def test_noise_that_is_not_seen_in_a_soup(self):
        result = run("fair", self.write("in.obj", soup()), "-o", self.folder / "out.obj", "--noise", "auto")
        self.assertEqual(result.returncode, 2)
        self.assertIn("--noise auto: 128 of 128 faces share no edge with another", self.assert_one_line(result))
        self.assertIn("--weld 0 makes them one", result.stderr.decode())


class Weld(Case):
    def fair(self, name, text, *options, status=0):
        result = run("fair", self.write(name, text), "-o", self.folder / ("out_" + name), "--tolerance", 1e-10, *options)
        self.assertEqual(result.returncode, status, result.stderr.decode())
        return (self.folder / ("out_" + name)).read_bytes(), result.stderr.decode()

    def fair_grid(self, *options):
        """Places before and after, of the grid itself."""
        after = parsed(self.fair("grid.obj", grid(SIZE), *options)[0].decode())[0]
        return dict(zip(parsed(grid(SIZE))[0], after))

    def assert_near(self, a, b, tolerance=1e-9):
        self.assertLess(max(abs(x - y) for x, y in zip(a, b)), tolerance, (a, b))

    def test_a_soup_becomes_the_shape_of_its_mesh(self):
        expected = self.fair_grid()
        out, said = self.fair("soup.obj", soup(), "--weld", 0, "--report", self.folder / "report.json")
        self.assertNotIn("--weld", said)
        before, after = soup().splitlines(), out.decode().splitlines()
        self.assertEqual([line for line in before if line[0] != "v"], [line for line in after if line[0] != "v"])
        self.assertEqual([line[0] for line in before], [line[0] for line in after])
        for old, new in zip(parsed(soup())[0], parsed(out.decode())[0]):
            self.assert_near(expected[old], new)
        report = self.read_json("report.json")
        nodes = 6 * SIZE * SIZE
        self.assertEqual((report["nodes"], report["faces"]), (nodes, 2 * SIZE * SIZE))
        self.assertEqual(report["weld"]["joined_nodes"], nodes - (SIZE + 1) ** 2)
        self.assertEqual(report["moving_nodes"], (SIZE - 1) ** 2)
        self.assertEqual(report["fixed_positions"], 4 * SIZE)

    def test_both_sides_of_a_seam_stay_together(self):
        expected = self.fair_grid()
        text, twin = seam()
        out, _ = self.fair("seam.ply", text, "--weld", 0)
        before, after = text.splitlines(), out.decode().splitlines()
        first = before.index("end_header") + 1
        count = (SIZE + 1) * (SIZE + 2)
        self.assertEqual(before[:first], after[:first])
        self.assertEqual(before[first + count:], after[first + count:])
        old = [line.split() for line in before[first:first + count]]
        new = [line.split() for line in after[first:first + count]]
        self.assertEqual([words[3:] for words in old], [words[3:] for words in new], "texture coordinates stay")
        for a, b in twin.items():
            self.assertEqual(new[a][:3], new[b][:3])
        for words, moved_words in zip(old, new):
            self.assert_near(expected[tuple(map(float, words[:3]))], list(map(float, moved_words[:3])))

    def test_what_is_not_welded_is_told_of(self):
        for name, text, what, eps in (
                ("a.obj", soup(), "128 of 128 faces share no edge", "0"), ("b.obj", soup(1e-8), "128 of 128 faces", "1e-06"),
                ("c.ply", seam()[0], "18 boundary nodes, node 36 first, are at the place of another one, but", "0")):
            with self.subTest(what):
                _, said = self.fair(name, text)
                self.assertIn(what, said)
                self.assertIn(f"--weld {eps} makes them one", said)
        far = self.fair("far.obj", soup(1e-3))[1]
        self.assertIn("128 of 128 faces share no edge", far)
        self.assertIn("--weld EPS", far)
        self.assertNotIn("warning", self.fair("grid.obj", grid(SIZE))[1])
        measured = run("measure", self.write("soup.obj", soup()))
        self.assertIn("--weld 0", measured.stderr.decode())
        # What a region holds anyway is nobody's business.
        self.assertNotIn("--weld", self.fair("seam.ply", seam()[0], "--region", "box:0.1,0.6,-1,0.9,0.9,1")[1])

    def test_stl_welds_what_rounding_has_parted(self):
        for offset in (0, 100):
            with self.subTest(offset=offset):
                expected = self.fair_grid()
                data = stl(1e-7 * max(1, offset), offset)
                out, said = self.fair("in.stl", data, "--report", self.folder / "report.json")
                self.assertIn("--weld 0", said)
                self.assertEqual(self.read_json("report.json")["moving_nodes"], (SIZE - 1) ** 2)
                nodes, faces = parsed(grid(SIZE))
                for node, corner in zip((nodes[node] for face in faces for node in face), corners_of_stl(out)):
                    self.assert_near(expected[node], [x - offset for x in corner], 3e-6 * max(1, offset))
                inner = [corner for face, corner in zip((node for face in faces for node in face), corners_of_stl(out))
                         if all(0 < x < 1 for x in nodes[face][:2])]
                self.assertEqual(len(set(inner)), (SIZE - 1) ** 2, "what is one node is at one place")
                self.assertEqual(data[:84], out[:84])
        _, said = self.fair("in.stl", stl(1e-7), "--weld", 0)
        self.assertIn("--weld 1e-06", said)
        self.assertNotIn("--weld", self.fair("in.stl", stl())[1])

    def test_stl_finds_the_shape_of_its_mesh(self):
        text = "solid\n" + "".join(
            "facet normal 0 0 1\nouter loop\n" + "".join("vertex {!r} {!r} {!r}\n".format(*corner) for corner in corners)
            + "endloop\nendfacet\n" for corners in self.corners(1e-7)) + "endsolid\n"
        out, _ = self.fair("in.stl", text)
        nodes, faces = parsed(grid(SIZE))
        places = [tuple(map(float, line.split()[1:])) for line in out.decode().splitlines() if line.startswith("vertex")]
        lines = [line if not line.startswith("v ") else None for line in grid(SIZE).splitlines()]
        first = {}
        for node, corner in zip((node for face in faces for node in face), (c for cs in self.corners(1e-7) for c in cs)):
            first.setdefault(node, corner)
        mesh = "".join("v {!r} {!r} {!r}\n".format(*first[node]) for node in range(len(nodes))) + "\n".join(filter(None, lines))
        expected = parsed(self.fair("mesh.obj", mesh + "\n")[0].decode())[0]
        for node, place in zip((node for face in faces for node in face), places):
            inner = all(0 < x < 1 for x in nodes[node][:2])
            self.assert_near(expected[node], place, 1e-9 if inner else 2.1e-7)

    def corners(self, share):
        nodes, faces = parsed(grid(SIZE))
        generator = random.Random(2)
        return [[moved(nodes[node], generator, share) for node in face] for face in faces]

    def test_corners_that_are_nearly_at_one_place(self):
        expected = self.fair_grid()
        out, _ = self.fair("soup.obj", soup(1e-4), "--weld", 1e-3)
        for old, new in zip(parsed(soup())[0], parsed(out.decode())[0]):
            self.assert_near(expected[old], new, 1e-3)
        held = [x in (0, 1) or y in (0, 1) for x, y, _ in parsed(soup())[0]]
        same = [a == b for a, b in zip(vertex_lines(soup(1e-4)), vertex_lines(out.decode()))]
        self.assertEqual(held, same, "corners at the boundary keep their bits")

    def test_faces_that_vanish_and_chains_are_named(self):
        text = grid(SIZE) + "v 0.5 0.5 0.5\nv 0.5 0.5000001 0.5\nv 0.5 0.8 0.9\nf -3 -2 -1\n"
        _, said = self.fair("in.obj", text, "--weld", 1e-6)
        self.assertIn("1 face has vanished, face 128 first", said)
        self.assertIn("a smaller one keeps them", said)
        result = run("fair", self.write("in.obj", grid(SIZE)), "-o", self.folder / "no.obj", "--weld", 0.2)
        self.assertEqual(result.returncode, 2)
        self.assertIn("cannot all be one", self.assert_one_line(result))
        self.assertNotIn("no.obj", self.files())

    def test_faces_without_area_are_named_once(self):
        path = self.write("in.obj", grid(SIZE) + "f 12 13 12\nf 40 41 41\n")
        for command in (("fair", path, "-o", self.folder / "out.obj"), ("measure", path)):
            warnings = [line for line in run(*command).stderr.decode().splitlines() if "area" in line]
            self.assertEqual(warnings, [f"warning: 2 faces have no area, face {2 * SIZE * SIZE} first: they have no normal, and do not count"])

    def test_rules_and_regions_name_nodes_of_the_file(self):
        text, twin = seam()
        a, b = list(twin.items())[4]
        for node in (a, b):
            with self.subTest(node=node):
                rules = self.write("rules.json", f'{{"rules": [{{"nodes": [{node}], "position": [0.5, 0.5, 1], "normal": "fixed"}}]}}')
                out = self.fair("seam.ply", text, "--weld", 0, "--constraints", rules)[0].decode().splitlines()
                first = out.index("end_header") + 1
                for one in (a, b):
                    self.assertEqual(list(map(float, out[first + one].split()[:3])), [0.5, 0.5, 1])
        rules = self.write("rules.json", f'{{"rules": [{{"nodes": [{a}], "position": [0.5, 0.5, 1]}}, {{"nodes": [{b}], "position": "fixed"}}]}}')
        result = run("fair", self.write("seam.ply", text), "-o", self.folder / "no.ply", "--weld", 0, "--constraints", rules)
        self.assertEqual(result.returncode, 2)
        self.assertIn(f"rule 2: nodes {a} and {b} are welded into one", self.assert_one_line(result))
        outs = []
        for node in (a, b):
            region = self.write("region.json", f"[{node}]")
            outs.append(self.fair("seam.ply", text, "--weld", 0, "--region", region, "--report", self.folder / "report.json")[0])
            self.assertEqual(self.read_json("report.json")["moving_nodes"], 1)
        self.assertEqual(*outs)

    def test_numbers_at_nodes_are_those_of_the_file(self):
        self.fair("soup.obj", soup(), "--weld", 0, "--scalars", self.folder / "out.vtp")
        text = (self.folder / "out.vtp").read_text()
        self.assertIn(f'NumberOfPoints="{6 * SIZE * SIZE}"', text)
        values = text.split('Name="mean_curvature"')[1].split("</DataArray>")[0].split(">")[1].split()
        places = {}
        for corner, value in zip(parsed(soup())[0], values):
            places.setdefault(corner, set()).add(value)
        self.assertTrue(all(len(found) == 1 for found in places.values()))
        self.assertGreater(len(set(values)), 10)

    def test_fit_and_measure(self):
        points = self.write("points.xyz", "".join(f"{x / 30} {y / 30} {bumps(x / 30, y / 30)}\n" for x in range(31) for y in range(31)))
        shapes = []
        for name, text, options in (("grid.obj", grid(SIZE), ()), ("soup.obj", soup(), ("--weld", 0))):
            out = self.folder / ("fit_" + name)
            result = run("fit", self.write(name, text), "--points", points, "-o", out, "--weight", 0.1, "--tolerance", 1e-10, *options)
            self.assertEqual(result.returncode, 0, result.stderr.decode())
            shapes.append(parsed(out.read_text())[0])
        expected = dict(zip(parsed(grid(SIZE))[0], shapes[0]))
        for old, new in zip(parsed(soup())[0], shapes[1]):
            self.assert_near(expected[old], new)
        figures = []
        for name, options in (("grid.obj", ()), ("soup.obj", ("--weld", 0))):
            run("measure", self.folder / name, "--report", self.folder / "report.json", *options)
            figures.append(self.read_json("report.json")["figures"])
        for key, value in figures[0].items():
            self.assertAlmostEqual(value, figures[1][key], delta=1e-9 * max(1, abs(value)), msg=key)

    def test_its_own_nodes_pull_once(self):
        expected = self.fair_grid("--smoothing-length", 0.1, "--distribution", "smooth")
        out, _ = self.fair("soup.obj", soup(), "--weld", 0, "--smoothing-length", 0.1, "--distribution", "smooth")
        for old, new in zip(parsed(soup())[0], parsed(out.decode())[0]):
            self.assert_near(expected[old], new, 1e-8)

    def test_a_curve_is_not_welded(self):
        curve = self.write("in.xyz", "0 0\n1 1\n2 0\n")
        result = run("measure", curve, "--weld", 0)
        self.assertEqual(result.returncode, 1)
        self.assertIn("--weld is for surfaces", self.assert_one_line(result))
