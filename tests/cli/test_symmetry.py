"""What --symmetry makes of half a shape and of a whole one: figures, files that keep what they carried, and refusals."""
import json
import math
import random
import struct

from support import Case, parsed, run, sphere, vertex_lines

ROWS, COLUMNS = 12, 6
ON_PLANE = [k * (COLUMNS + 1) for k in range(ROWS + 1)]


def cap(whole=False, noise=0.03, seed=1):
    """A part of the unit sphere over a rectangle as OBJ, in quads: the half with x from 0 on, or both; noise inside, in the half in the
    plane where nodes are on it. With a comment, a group and a texture coordinate."""
    draw = random.Random(seed)
    first = -COLUMNS if whole else 0
    lines = ["# a cap", "vt 0.5 0.5"]
    for j in range(ROWS + 1):
        for i in range(first, COLUMNS + 1):
            x, y = 0.1 * i, 0.1 * (j - ROWS / 2)
            square = x * x + y * y
            place = [2 * x / (1 + square), 2 * y / (1 + square), (1 - square) / (1 + square)]
            if 0 < j < ROWS and first < i < COLUMNS or not whole and i == 0 and 0 < j < ROWS:
                place = [p + (draw.uniform(-noise, noise) if whole or i > 0 or k > 0 else 0) for k, p in enumerate(place)]
            lines.append("v {!r} {!r} {!r} # a node".format(*place))
    wide = COLUMNS + 1 - first
    lines.append("g shell")
    for j in range(ROWS):
        for i in range(wide - 1):
            a = j * wide + i + 1
            lines.append(f"f {a}/1 {a + 1}/1 {a + wide + 1}/1 {a + wide}/1")
    return "\n".join(lines) + "\n"


def rim_rules(text, whole=False):
    """Holds the rim with the sphere's normals."""
    nodes, _ = parsed(text)
    wide = COLUMNS + 1 + (COLUMNS if whole else 0)
    rim = [k for k in range(len(nodes)) if k // wide in (0, ROWS) or k % wide == wide - 1 or whole and k % wide == 0]
    return json.dumps({"rules": [{"nodes": rim, "normal": [list(nodes[k]) for k in rim]}]})


def off_sphere(nodes):
    return max(abs(math.hypot(*node) - 1) for node in nodes)


class Symmetry(Case):
    def call(self, command, name, text, *options, status=0):
        result = run(command, self.write(name, text), "-o", self.folder / ("out_" + name), "--tolerance", 1e-12,
                     "--report", self.folder / "report.json", *options)
        self.assertEqual(result.returncode, status, result.stderr.decode())
        self.report = self.read_json("report.json")
        return (self.folder / ("out_" + name)).read_text()

    def refuse(self, text, *options, command="fair", name="in.obj", status=2):
        result = run(command, self.write(name, text), "-o", self.folder / ("out_" + name), *options)
        self.assertEqual(result.returncode, status)
        self.assertFalse((self.folder / ("out_" + name)).exists())
        return self.assert_one_line(result)

    def test_half_a_sphere_is_the_sphere(self):
        text = cap()
        rules = self.write("rim.json", rim_rules(text))
        out = self.call("fair", "in.obj", text, "--symmetry", "x", "--constraints", rules)
        nodes, _ = parsed(out)
        self.assertLess(off_sphere(nodes), 1e-10)
        self.assertTrue(all(nodes[k][0] == 0 for k in ON_PLANE))
        self.assertGreater(max(math.dist(nodes[k], parsed(text)[0][k]) for k in ON_PLANE), 0.01)
        without = lambda lines: [line for line in lines.splitlines() if not line.startswith("v ")]
        self.assertEqual(without(out), without(text))
        self.assertTrue(all(line.endswith("# a node") for line in vertex_lines(out)))

    def test_report_is_of_the_half(self):
        self.call("fair", "in.obj", cap(), "--symmetry", "x")
        self.assertEqual(self.report["symmetry"], {"plane": "x", "shape": "half", "pairs": (ROWS + 1) * COLUMNS, "nodes_on_plane": ROWS + 1})
        self.assertEqual(self.report["nodes"], (ROWS + 1) * (COLUMNS + 1))
        self.assertEqual(self.report["faces"], ROWS * COLUMNS)
        self.assertEqual(self.report["moving_nodes"], (ROWS - 1) * COLUMNS)
        self.assertEqual(self.report["fixed_positions"], 2 * COLUMNS + 2 + ROWS - 1)

    def test_summary_says_how_it_is_symmetric(self):
        result = run("fair", self.write("in.obj", cap()), "-o", self.folder / "out.obj", "--symmetry", "x")
        self.assertIn("half, joined at 13 nodes in the plane x = 0", result.stdout.decode())
        result = run("fair", self.write("in.obj", cap(True)), "-o", self.folder / "out.obj", "--symmetry", "x")
        self.assertIn("whole, 78 pairs of nodes, 13 nodes in the plane x = 0", result.stdout.decode())

    def test_whole_comes_out_symmetric_to_the_bit(self):
        for options in ((), ("--noise", "0.02"), ("--within", "0.08"), ("--region", "sphere:0.3,0.2,0.9,0.4")):
            nodes, _ = parsed(self.call("fair", "in.obj", cap(True), "--symmetry", "x", *options))
            self.assertEqual(self.report["symmetry"]["shape"], "whole")
            wide = 2 * COLUMNS + 1
            for k, (x, y, z) in enumerate(nodes):
                self.assertEqual(nodes[k - k % wide + wide - 1 - k % wide], (-x, y, z), (k, options))

    def test_whole_in_single_precision_is_symmetric_to_the_bit(self):
        nodes, faces = parsed(cap(True))
        header = ("ply\nformat binary_little_endian 1.0\n" f"element vertex {len(nodes)}\nproperty float x\nproperty float y\nproperty float z\n"
                  f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
        data = header.encode() + b"".join(struct.pack("<3f", *node) for node in nodes) + b"".join(struct.pack("<B4i", 4, *face) for face in faces)
        result = run("fair", self.write("in.ply", data), "-o", self.folder / "out.ply", "--symmetry", "x")
        self.assertEqual(result.returncode, 0, result.stderr.decode())
        out = (self.folder / "out.ply").read_bytes()
        places = list(struct.iter_unpack("<3f", out[len(header):len(header) + 12 * len(nodes)]))
        wide = 2 * COLUMNS + 1
        for k, (x, y, z) in enumerate(places):
            self.assertEqual(places[k - k % wide + wide - 1 - k % wide], (-x, y, z))

    def test_plane_may_be_shifted_or_general(self):
        text = cap()
        plain, _ = parsed(self.call("fair", "in.obj", text, "--symmetry", "x"))
        general, _ = parsed(self.call("fair", "in.obj", text, "--symmetry", "plane:0,1,2,-3,0,0"))
        self.assertLess(max(map(math.dist, plain, general)), 1e-10)
        nodes, _ = parsed(text)
        shifted = "".join(f"v {x + 2.5!r} {y!r} {z!r}\n" for x, y, z in nodes) + "".join(line + "\n" for line in text.splitlines() if line[0] in "fg" or line.startswith("vt"))
        there, _ = parsed(self.call("fair", "there.obj", shifted, "--symmetry", "x=2.5"))
        self.assertTrue(all(there[k][0] == 2.5 for k in ON_PLANE))
        self.assertLess(max(math.dist((x - 2.5, y, z), other) for (x, y, z), other in zip(there, plain)), 1e-10)

    def test_region_and_fix_and_normals_go_with_it(self):
        text = cap(noise=0)
        nodes, _ = parsed(text)
        region = [k for k, node in enumerate(nodes) if math.dist(node, (0, 0, 1)) < 0.5]
        rough = text.splitlines()
        first = next(k for k, line in enumerate(rough) if line.startswith("v "))
        for k in region:
            x, y, z = nodes[k]
            rough[first + k] = f"v {x!r} {y!r} {z + 0.05 * math.sin(9 * k)!r} # a node"
        out = self.call("fair", "in.obj", "\n".join(rough) + "\n", "--symmetry", "x", "--region", "sphere:0,0,1,0.5")
        after, _ = parsed(out)
        self.assertLess(off_sphere(after), 1e-8)
        self.assertEqual(self.report["moving_nodes"], len(region))
        self.assertEqual([line for k, line in enumerate(vertex_lines(out)) if k not in region],
                         [line for k, line in enumerate(vertex_lines(text)) if k not in region])
        self.call("fair", "in.obj", cap(), "--symmetry", "x", "--fix-normals", "boundary")
        self.assertEqual(self.report["fixed_normals"], 2 * COLUMNS + 2 + ROWS - 1)

    def test_rules_name_nodes_of_the_half(self):
        text = cap()
        # In the order of the selection: the rim of the whole, of which the half has these.
        rules = {"rules": [{"nodes": "boundary", "position": "fixed"}, {"nodes": {"group": "shell"}, "normal": "free"},
                           {"nodes": [3 * (COLUMNS + 1)], "position": [0, -0.4, 0.95], "normal": [0, -0.4, 0.9]}]}
        nodes, _ = parsed(self.call("fair", "in.obj", text, "--symmetry", "x", "--fix", "none", "--constraints", self.write("rules.json", json.dumps(rules))))
        self.assertEqual(nodes[3 * (COLUMNS + 1)], (0, -0.4, 0.95))
        self.assertEqual(self.report["fixed_positions"], 2 * COLUMNS + 2 + ROWS)
        self.assertEqual(self.report["fixed_normals"], 1)
        rules = {"rules": [{"nodes": "all", "position": [[0, 0, 0]]}]}
        self.assertIn("for 91 nodes", self.refuse(text, "--symmetry", "x", "--constraints", self.write("rules.json", json.dumps(rules)), name="bad.obj"))

    def test_half_is_fitted_to_points(self):
        text = cap()
        draw = random.Random(4)
        points = []
        for _ in range(400):
            x, y = draw.uniform(-0.6, 0.6), draw.uniform(-0.6, 0.6)
            square, radius = x * x + y * y, 1 + draw.uniform(-0.01, 0.01)
            points.append(f"{radius * 2 * x / (1 + square)},{radius * 2 * y / (1 + square)},{radius * (1 - square) / (1 + square)}\n")
        cloud = self.write("cloud.csv", "x,y,z\n" + "".join(points))
        for options in (("--within", "0.025"), ("--within", "0.025", "--fix", "none")):
            nodes, _ = parsed(self.call("fit", "in.obj", text, "--points", cloud, "--symmetry", "x", *options))
            self.assertTrue(all(nodes[k][0] == 0 for k in ON_PLANE))
            self.assertEqual(self.report["points"]["count"], 400)
            self.assertLess(off_sphere(nodes), 0.03)

    def test_half_an_outline_is_a_closed_curve(self):
        text = "x,y,name\n" + "".join(f"{math.cos(a)!r},{math.sin(a) if 0 < k < 40 else 0!r},row {k}\n" for k, a in enumerate(math.pi * j / 40 for j in range(41)))
        out = self.call("curve", "half.csv", text, "--symmetry", "y", "--within", "0.01")
        rows = [line.split(",") for line in out.splitlines()[1:]]
        self.assertEqual([float(rows[k][1]) for k in (0, 40)], [0, 0])
        self.assertEqual(rows[7][2], "row 7")
        self.assertTrue(all(abs(math.hypot(float(x), float(y)) - 1) < 0.01 for x, y, _ in rows))
        self.assertEqual(self.report["symmetry"]["shape"], "half")
        self.assertEqual(self.report["nodes"], 41)
        for option in (("--resample", "50"), ("--move", "y", "--within", "0.1")):
            self.assertIn(option[0], self.refuse(text, "--symmetry", "y", *option, command="curve", name="bad.csv", status=1))

    def test_what_is_not_symmetric_is_refused_by_node(self):
        text = cap()
        for plane, words in (("w", "plane \"w\""), ("x=-1", "misses the shape: node 0"), ("x=0.2", "beyond the plane x = 0.2"),
                             ("plane:0,0,0,0,0,0", "a normal of zero"), ("y=0.1", "node")):
            self.assertIn(words, self.refuse(text, "--symmetry", plane))
        lines = cap(True).splitlines()
        first = next(k for k, line in enumerate(lines) if line.startswith("v "))
        lines[first + 28] = "v -0.7 0.1 1.5"
        self.assertIn("node 28 has no mirror image", self.refuse("\n".join(lines) + "\n", "--symmetry", "x"))
        rules = self.write("rules.json", json.dumps({"rules": [{"nodes": [30], "position": "fixed"}]}))
        self.assertIn("node 30 has its position held, and its mirror image in the plane x = 0, node 34, has not",
                      self.refuse(cap(True), "--symmetry", "x", "--constraints", rules))
        rules = self.write("rules.json", json.dumps({"rules": [{"nodes": [14], "normal": [1, 0, 1]}]}))
        self.assertIn("node 14 lies in the plane x = 0, but its normal does not", self.refuse(text, "--symmetry", "x", "--constraints", rules))

    def test_joined_nodes_of_a_half(self):
        # Each face with corners of its own, as in STL.
        nodes, faces = parsed(cap())
        soup = "".join("v {!r} {!r} {!r}\n".format(*nodes[k]) for face in faces for k in face)
        soup += "".join(f"f {4 * k + 1} {4 * k + 2} {4 * k + 3} {4 * k + 4}\n" for k in range(len(faces)))
        apart, _ = parsed(self.call("fair", "soup.obj", soup, "--weld", "0", "--symmetry", "x"))
        joined, _ = parsed(self.call("fair", "in.obj", cap(), "--symmetry", "x"))
        self.assertLess(max(math.dist(apart[4 * f + k], joined[node]) for f, face in enumerate(faces) for k, node in enumerate(face)), 1e-9)

    def test_closed_sphere_with_noise(self):
        nodes, _ = parsed(self.call("fair", "ball.obj", sphere(8, noise=0.02), "--symmetry", "z", "--noise", "0.01"))
        places = set(nodes)
        self.assertTrue(all((x, y, -z) in places for x, y, z in nodes))
