"""What `--sharp` does with surfaces."""
import itertools
import json
import math
import random

from support import EXAMPLES, Case, grid, run, vertex_lines


def roof(x, y):
    """Two planes, which meet at y = 0.5."""
    return -abs(y - 0.5)


def positions(text):
    return [tuple(map(float, line.split()[1:4])) for line in vertex_lines(text)]


def disturbed(text, deviation, disturbs=lambda p: True):
    """An OBJ file with Gaussian noise at some of its nodes."""
    noise = random.Random(5)
    lines = []
    for line in text.splitlines():
        if line.startswith("v ") and disturbs(tuple(map(float, line.split()[1:4]))):
            line = "v " + " ".join(repr(float(word) + noise.gauss(0, deviation)) for word in line.split()[1:4])
        lines.append(line)
    return "\n".join(lines) + "\n"


def cube(cells):
    """Triangles."""
    nodes, faces = {}, []
    for axis, far in itertools.product(range(3), (0, 1)):
        for i, j in itertools.product(range(cells), repeat=2):
            def node(u, v):
                place = [0, 0, 0]
                place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = far * cells, i + u, j + v
                return nodes.setdefault(tuple(place), len(nodes) + 1)
            a, b, c, d = (node(0, 0), node(1, 0), node(1, 1), node(0, 1)) if far else (node(0, 1), node(1, 1), node(1, 0), node(0, 0))
            faces += [(a, b, c), (a, c, d)]
    return "".join("v {} {} {}\n".format(*(x / cells for x in place)) for place in nodes) + "".join("f {} {} {}\n".format(*face) for face in faces)


class Sharp(Case):
    def fair(self, text, *options, status=0, name="in.obj"):
        shape = self.write(name, text)
        result = run("fair", shape, "-o", self.folder / "out.obj", "--report", self.folder / "r.json", *options)
        self.assertEqual(result.returncode, status, result.stderr.decode())
        return result

    def off_roof(self):
        """The furthest node of the result from the two planes."""
        return max(abs(z - roof(x, y)) for x, y, z in positions((self.folder / "out.obj").read_text())) / math.sqrt(2)

    def noisy_roof(self):
        inside = lambda p: 0 < p[0] < 1 and 0 < p[1] < 1 and p[1] != 0.5
        return disturbed(grid(16, roof), 0.005, inside)

    def test_edges_at_which_a_scan_would_fold_are_rounded(self):
        scan = disturbed((EXAMPLES / "figure-12.obj").read_text(), 0.04)
        result = self.fair(scan, "--noise", "0.04", "--sharp", "25")
        self.assertIn("3 of 8 sharp edges are not kept: the surface without its noise would fold there", result.stderr.decode())
        self.assertIn("sharp edges      5 in 1 chain", result.stdout.decode())
        sharp = json.loads((self.folder / "r.json").read_text())["sharp"]
        self.assertEqual((sharp["edges"], len(sharp["rounded"]), len(sharp["chains"])), (5, 3, 1))
        kept = set(sharp["chains"][0]["nodes"])
        self.assertFalse(kept & {node for edge in sharp["rounded"] for node in edge})

    def test_a_roof_keeps_its_ridge(self):
        self.fair(self.noisy_roof(), "--tolerance", "1e-12")
        self.assertGreater(self.off_roof(), 0.02)
        result = self.fair(self.noisy_roof(), "--sharp", "60", "--tolerance", "1e-12")
        self.assertLess(self.off_roof(), 1e-9)
        self.assertIn("sharp edges      16 in 1 chain of 1 units in all, 0 corners", result.stdout.decode())
        sharp = self.read_json("r.json")["sharp"]
        self.assertEqual((sharp["angle"], sharp["edges"], sharp["corners"], len(sharp["chains"])), (60, 16, [], 1))
        chain = sharp["chains"][0]
        self.assertEqual((len(chain["nodes"]), chain["closed"], chain["length"]), (17, False, 1))

    def test_its_tangent_planes_may_be_held_on_either_side(self):
        bent = grid(12, lambda x, y: -abs(y - 0.5) - 2 * (y - 0.5) ** 2)
        result = self.fair(bent, "--sharp", "60", "--fix-normals", "boundary")
        self.assertNotIn("warning", result.stderr.decode())
        off = max(abs(z + abs(y - 0.5) + 2 * (y - 0.5) ** 2) for _, y, z in positions((self.folder / "out.obj").read_text()))
        self.assertLess(off, 0.03)
        self.fair(bent, "--fix-normals", "boundary")
        rounded = max(abs(z + abs(y - 0.5) + 2 * (y - 0.5) ** 2) for _, y, z in positions((self.folder / "out.obj").read_text()))
        self.assertGreater(rounded, 0.06)

    def test_a_cube_with_noise_keeps_edges_and_corners(self):
        cells = 12
        true = positions(cube(cells))
        noisy = disturbed(cube(cells), 0.1 / cells)

        def off_edges(places):
            """Nodes of edges and corners from these, root mean square, in edges of the mesh."""
            squares = [sum((x - t) ** 2 for x, t in zip(place, at) if t in (0, 1)) for place, at in zip(places, true)
                       if sum(t in (0, 1) for t in at) > 1]
            return cells * math.sqrt(sum(squares) / len(squares))

        self.assertGreater(off_edges(positions(noisy)), 0.12)
        self.fair(noisy, "--noise", "auto")
        without = off_edges(positions((self.folder / "out.obj").read_text()))
        result = self.fair(noisy, "--noise", "auto", "--sharp", "40")
        off = off_edges(positions((self.folder / "out.obj").read_text()))
        self.assertLess(off, 0.05)
        self.assertGreater(without, 1.3 * off)
        self.assertIn(f"sharp edges      {12 * cells} in 12 chains", result.stdout.decode())
        self.assertEqual(len(self.read_json("r.json")["sharp"]["corners"]), 8)

    def test_chains_may_stay_or_become_fair(self):
        text = disturbed(grid(16, roof), 0.005, lambda p: 0 < p[0] < 1 and 0 < p[1] < 1)
        ridge = [k for k, (_, y, _) in enumerate(positions(grid(16, roof))) if y == 0.5]
        self.fair(text, "--sharp", "60")
        before, after = positions(text), positions((self.folder / "out.obj").read_text())
        self.assertEqual([before[k] for k in ridge], [after[k] for k in ridge])
        self.fair(text, "--sharp", "60", "--sharp-curves", "fit", "--tolerance", "1e-12")
        self.assertLess(self.off_roof(), 1e-8)

    def test_edges_that_noise_turns_are_said_to_be_no_creases(self):
        shape = self.write("in.obj", disturbed(grid(12, roof), 0.02))
        points = self.write("points.xyz", "".join(f"{x / 20} {y / 20} {roof(x / 20, y / 20)}\n" for x in range(21) for y in range(21)))
        fit = lambda angle: run("fit", shape, "--points", points, "-o", self.folder / "out.obj", "--smoothing-length", "0.1", "--sharp", angle).stderr.decode()
        self.assertRegex(fit("20"), r"the \d+ chains of sharp edges are 1\.\d edges long on average: bends of a coarse mesh, or noise, rather than creases; a greater angle finds fewer, and vspring fair with --noise auto and --sharp takes noise off first")
        self.assertNotIn("rather than creases", fit("70"))

    def test_a_fit_to_points_keeps_them(self):
        shape = self.write("in.obj", grid(12, roof))
        points = self.write("points.xyz", "".join(
            f"{x / 40} {y / 40} {roof(x / 40, y / 40) + 0.1 * math.sin(math.pi * x / 40) * math.sin(2 * math.pi * y / 40) ** 2}\n"
            for x in range(41) for y in range(41)))
        for options, low, high in (((), 0.02, 1), (("--sharp", "60"), 0, 0.01)):
            result = run("fit", shape, "--points", points, "-o", self.folder / "out.obj", "--smoothing-length", "0.05", *options)
            self.assertEqual(result.returncode, 0, result.stderr.decode())
            ridge = [z for _, y, z in positions((self.folder / "out.obj").read_text()) if abs(y - 0.5) < 0.02]
            self.assertTrue(low <= max(map(abs, ridge)) <= high, (options, max(map(abs, ridge))))

    def ridge(self, cells=16):
        """The numbers of the nodes at y = 0.5, in the order of x, from 0."""
        return sorted((x, k) for k, (x, y, _) in enumerate(positions(grid(cells, roof))) if y == 0.5)

    def marks(self, cells=16):
        return "l " + " ".join(str(k + 1) for _, k in self.ridge(cells)) + "\n"

    def test_edges_that_the_file_marks_stay_sharp(self):
        nodes = [k for _, k in self.ridge()]
        text = self.noisy_roof()
        ply = "".join(["ply\nformat ascii 1.0\n", f"element vertex {17 * 17}\n", *(f"property double {c}\n" for c in "xyz"),
                       f"element face {text.count(chr(10) + 'f ')}\nproperty list uchar int vertex_indices\n",
                       "element edge 17\nproperty int vertex1\nproperty int vertex2\nproperty uchar crease\nend_header\n",
                       *(line[2:] + "\n" for line in vertex_lines(text)),
                       *("{} {}\n".format(len(face), " ".join(str(int(n) - 1) for n in face))
                         for face in (line.split()[1:] for line in text.splitlines() if line.startswith("f "))),
                       *(f"{a} {b} 255\n" for a, b in zip(nodes, nodes[1:])), f"{nodes[0]} {nodes[0] + 1} 0\n"])
        for name, marked in (("in.obj", text + self.marks()), ("in.ply", ply)):
            shape = self.write(name, marked)
            output = self.folder / ("out" + name[2:])
            done = run("fair", shape, "-o", output, "--report", self.folder / "r.json", "--sharp", "marked", "--tolerance", "1e-12")
            self.assertEqual(done.returncode, 0, done.stderr.decode())
            self.assertNotIn("warning", done.stderr.decode())
            self.assertIn("sharp edges      16 in 1 chain of 1 units", done.stdout.decode())
            rows = [line.split()[-3:] for line in output.read_text().split("end_header")[-1].split("\n") if line][:17 * 17]
            self.assertEqual(len(rows), 17 * 17)
            self.assertLess(max(abs(float(z) - roof(float(x), float(y))) for x, y, z in rows), 1e-8)
            sharp = self.read_json("r.json")["sharp"]
            self.assertEqual((sharp["angle"], sharp["marked"], sharp["by_rules"], sharp["left_out"], sharp["edges"]), (None, 16, 0, [], 16))
            # The marks stay in the file.
            self.assertEqual(output.read_text().splitlines()[-16:], marked.splitlines()[-16:])

    def test_marks_and_an_angle_go_together(self):
        # A third plane, which meets the others in an edge that turns by less than 40 degrees, and is marked.
        bent = lambda x, y: roof(x, y) - 0.4 * max(0, x - 0.5)
        at = {place[:2]: k + 1 for k, place in enumerate(positions(grid(8, bent)))}
        marks = "l " + " ".join(str(at[0.5, y / 8]) for y in range(9)) + "\n"
        for option, edges in (("40", 8), ("marked", 8), ("marked,40", 16), ("40, marked", 16)):
            self.fair(grid(8, bent) + marks, "--sharp", option)
            self.assertEqual(self.read_json("r.json")["sharp"]["edges"], edges)
        self.assertEqual(self.read_json("r.json")["sharp"]["corners"], [at[0.5, 0.5] - 1])

    def test_marks_that_are_no_edges_are_left_out_and_named(self):
        result = self.fair(grid(16, roof) + self.marks() + "l 1 2\nl 1 40\n", "--sharp", "marked")
        self.assertIn("2 marked edges cannot be sharp and are left out, that from node 0 to node 1 first: it is part of the boundary",
                      " ".join(result.stderr.decode().split()))
        sharp = self.read_json("r.json")["sharp"]
        self.assertEqual((sharp["marked"], sharp["left_out"]), (16, [[0, 1], [0, 39]]))
        result = self.fair(grid(8, roof) + "l 1 2\n", "--sharp", "marked")
        self.assertIn("--sharp has no effect here: the file marks no edge that can be sharp", result.stderr.decode())
        wrong = self.fair(grid(8, roof) + "l 1 100\n", "--sharp", "marked", status=2).stderr.decode()
        self.assertIn("node 100 does not exist", wrong)
        self.fair(grid(8, roof) + "l 1 100\n", "--sharp", "40")

    def test_marks_hold_for_refined_and_welded_nodes_and_mirror_images(self):
        self.fair(grid(4, roof) + self.marks(4), "--sharp", "marked", "--refine", "0.15")
        self.assertEqual(self.read_json("r.json")["sharp"]["edges"], 8)
        self.assertLess(self.off_roof(), 1e-9)
        # Each side of the ridge has its own nodes; the line leads along those of the second.
        nodes, faces, first = [], [], {}
        for side, rows in enumerate((range(5), range(4, 9))):
            for y in rows:
                for x in range(9):
                    first[side, x, y] = len(nodes) + 1
                    nodes.append((x / 8, y / 8, roof(x / 8, y / 8)))
            faces += [[first[side, x + i, y + j] for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))] for y in rows[:-1] for x in range(8)]
        text = "".join("v {} {} {}\n".format(*node) for node in nodes) + "".join("f {} {} {} {}\n".format(*face) for face in faces)
        seam = text + "l " + " ".join(str(first[1, x, 4]) for x in range(9)) + "\n"
        for options, edges in (((), 8), (("--refine", "0.07"), 16)):
            self.fair(seam, "--weld", "0", "--sharp", "marked", *options)
            self.assertEqual(self.read_json("r.json")["sharp"]["edges"], edges)
        # Of a half whose boundary in the plane is marked, that edge is sharp in the whole.
        half = grid(8, lambda x, y: -y)
        keel = "l " + " ".join(str(k + 1) for k, (_, y, _) in enumerate(positions(half)) if y == 0) + "\n"
        self.fair(half + keel, "--sharp", "marked", "--symmetry", "y")
        self.assertEqual(self.read_json("r.json")["sharp"]["edges"], 8)

    def write_rules(self, rules):
        return self.write("rules.json", json.dumps({"rules": rules}))

    def test_rules_name_sharp_edges(self):
        nodes = [k for _, k in self.ridge()]
        by_box = {"nodes": {"region": "box:0,0.49,-9,1,0.51,9"}, "sharp": True}
        by_group = {"nodes": {"group": "left"}, "sharp": True}
        # A group is the one side, so its rim between the sides is sharp.
        faces = [line for line in self.noisy_roof().splitlines() if line.startswith("f ")]
        nodes_first = "\n".join(vertex_lines(self.noisy_roof())) + "\n"
        places = positions(self.noisy_roof())
        left = [face for face in faces if all(places[int(n) - 1][1] < 0.5 + 1e-9 for n in face.split()[1:])]
        text = nodes_first + "g left\n" + "\n".join(left) + "\ng right\n" + "\n".join(f for f in faces if f not in left) + "\n"
        for rule in (by_box, by_group, {"nodes": nodes, "sharp": True}, {"nodes": nodes, "sharp": "path"}):
            rules = self.write_rules([rule])
            result = self.fair(text, "--constraints", rules, "--tolerance", "1e-12")
            self.assertNotIn("warning", result.stderr.decode())
            sharp = self.read_json("r.json")["sharp"]
            self.assertEqual((sharp["angle"], sharp["by_rules"], sharp["edges"], len(sharp["chains"])), (None, 16, 16, 1))
            self.assertLess(self.off_roof(), 1e-9)
        # Half a roof beside the plane x = 0, with the group of that half alone: no edge in the plane is at its rim.
        rules = self.write_rules([by_group, {"nodes": "all", "normal": "free"}])
        self.fair(text, "--constraints", rules, "--symmetry", "x")
        self.assertEqual(self.read_json("r.json")["sharp"]["edges"], 32)

    def test_rules_without_such_edges_are_refused(self):
        nodes = [k for _, k in self.ridge(8)]
        for rule, why in (({"nodes": [nodes[0], nodes[2]], "sharp": "path"}, f"rule 1: sharp edge from node {nodes[0]} to node {nodes[2]}: no face has this edge"),
                          ({"nodes": [0, 1], "sharp": "path"}, "it is part of the boundary"),
                          ({"nodes": [nodes[0], nodes[2]], "sharp": True}, "no edge of two faces leads"),
                          ({"nodes": "all", "sharp": True}, "no edge of two faces leads"),
                          ({"nodes": "interior", "sharp": "path"}, "write a list of two or more"),
                          ({"nodes": nodes, "sharp": 40}, "40 says nothing of sharp edges")):
            rules = self.write_rules([rule])
            self.assertIn(why, " ".join(self.fair(grid(8, roof), "--constraints", rules, status=2).stderr.decode().split()))
        table = self.write("curve.csv", "0,0\n1,0\n2,1\n3,0\n")
        rules = self.write_rules([{"nodes": [1, 2], "sharp": True}])
        done = run("curve", table, "-o", self.folder / "out.csv", "--constraints", rules)
        self.assertIn("a curve takes \"corner\"", done.stderr.decode())
        done = run("fit", table, "--points", table, "-o", self.folder / "out.csv", "--weight", "1", "--sharp", "marked")
        self.assertIn("--sharp marked is for surfaces", done.stderr.decode())

    def test_what_has_no_effect_is_said(self):
        self.assertIn("no edge turns by more", self.fair(grid(8), "--sharp", "170").stderr.decode())
        self.assertIn("--sharp-curves", self.fair(grid(8), "--sharp-curves", "hold").stderr.decode())

    def test_bad_input_is_refused_with_the_reason(self):
        shape = self.write("in.obj", grid(8, roof))
        for angle in ("0", "180", "nan", "steep", "40,", "marked,200"):
            result = run("fair", shape, "-o", self.folder / "out.obj", "--sharp", angle)
            self.assertEqual(result.returncode, 1)
            self.assertIn("less than 180", result.stderr.decode())
        points = self.write("p.xyz", "0 0 0\n1 1 0\n0.5 0.5 0\n")
        result = run("fit", shape, "--points", points, "-o", self.folder / "out.obj", "--weight", "1", "--sharp", "60", "--sharp-curves", "fit")
        self.assertEqual(result.returncode, 1, result.stderr.decode())
        self.assertIn("scattered points do not say", result.stderr.decode())


if __name__ == "__main__":
    import unittest
    unittest.main()
