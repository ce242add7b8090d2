"""--refine: what is divided, what is said of it, and what becomes of the file."""
import json
import math
import struct

from support import OCTAHEDRON, Case, grid, run


def rows(text, keyword):
    return [line.split("#")[0].split()[1:] for line in text.splitlines() if line.split()[:1] == [keyword]]


def edges(positions, faces):
    """The lengths of all edges, and how many faces each has."""
    count = {}
    for face in faces:
        for a, b in zip(face, face[1:] + face[:1]):
            count[min(a, b), max(a, b)] = count.get((min(a, b), max(a, b)), 0) + 1
    return {edge: (math.dist(positions[edge[0]], positions[edge[1]]), faces) for edge, faces in count.items()}


# Two flat quads side by side, the one in a group, the other in another; a seam of texture coordinates between them. Only their
# common edge has a free node: the middle one of three in a row.
SHEET = """# sheet
mtllib sheet.mtl
o sheet
v 0 0 0 1 0 0
v 2 0 0 1 0 0
v 4 0 0 0 0 1
v 0 2 0 1 0 0
v 2 2 1 0 1 0
v 4 2 0 0 0 1
v 0 4 0 1 0 0
v 2 4 0 1 0 0
v 4 4 0 0 0 1
vt 0 0
vt 0.5 0
vt 1 0
vt 0 0.5
vt 0.5 0.5
vt 1 0.5
vt 0 1
vt 0.5 1
vt 1 1
vt 10 10
vt 10 12
vt 14 12
vt 14 10
g west
usemtl red
s 1
f 1/1 2/2 5/5 4/4 # first
f 4/4 5/5 8/8 7/7
g east
usemtl blue
s off
f 2/2 3/3 6/6 5/5
f 5/10 6/13 9/12 8/11 # last
"""


class Refine(Case):
    def refined(self, name, text, *options, out=None, status=0):
        """What is written, the report, and what is said."""
        out = out or "out_" + name
        result = run("fair", self.write(name, text), "-o", self.folder / out, "--report", self.folder / "report.json", *options)
        self.assertEqual(result.returncode, status, result.stderr.decode())
        return (self.folder / out).read_bytes(), self.read_json("report.json"), (result.stdout + result.stderr).decode()

    def test_an_obj_keeps_all_that_it_had_and_interpolates_it(self):
        for line_end in ("\n", "\r\n"):
            text = SHEET.replace("\n", line_end)
            data, report, said = self.refined("sheet.obj", text.encode(), "--refine", "1.2", "--strength", "0")
            now = data.decode()
            self.assertEqual((report["refine"]["new_nodes"], report["refine"]["new_faces"]), (16, 12))
            self.assertEqual((report["refine"]["length"], report["refine"]["turn"]), (1.2, None))
            self.assertIn("16 more nodes and 12 more faces", said)
            self.assertEqual((report["nodes"], report["faces"]), (25, 16))
            # Every line of the input but the faces stands as it was.
            kept = iter(now.split(line_end))
            for line in text.split(line_end):
                if not line.startswith("f "):
                    self.assertIn(line, kept)
            self.assertIn("# first", now)
            nodes, corners, faces = rows(now, "v"), rows(now, "vt"), rows(now, "f")
            self.assertEqual((len(nodes), len(faces)), (25, 16))
            # The middle of the first quad: of its positions, its colours and its texture coordinates.
            places = [[float(x) for x in row] for row in nodes]
            self.assertIn([1, 1, 0.25, 0.75, 0.25, 0], places)
            middle = places.index([1, 1, 0.25, 0.75, 0.25, 0]) + 1
            texture = {word.split("/")[1] for face in faces for word in face if word.split("/")[0] == str(middle)}
            self.assertEqual([[float(x) for x in corners[int(k) - 1]] for k in texture], [[0.25, 0.25]])
            # On the seam both sides have their own.
            seam = places.index([3, 2, 0.5, 0, 0.5, 0.5]) + 1
            texture = {word.split("/")[1] for face in faces for word in face if word.split("/")[0] == str(seam)}
            self.assertEqual(sorted([float(x) for x in corners[int(k) - 1]] for k in texture), [[0.75, 0.5], [12, 10]])
            # Parts of a face are in its group and have its material.
            groups, group, material = {}, None, None
            for line in now.split(line_end):
                group = line[2:] if line.startswith("g ") else group
                material = line[7:] if line.startswith("usemtl ") else material
                if line.startswith("f "):
                    groups.setdefault((group, material), []).append(line)
            self.assertEqual({key: len(of) for key, of in groups.items()}, {("west", "red"): 8, ("east", "blue"): 8})

    def test_numbers_that_count_backwards_stay_right(self):
        lines = SHEET.splitlines()
        first = lines.index("f 1/1 2/2 5/5 4/4 # first")
        lines[first] = "f -9/-13 -8/-12 -5/-9 -6/-10"
        backwards, *_ = self.refined("back.obj", "\n".join(lines), "--refine", "1.2")
        forwards, *_ = self.refined("sheet.obj", SHEET, "--refine", "1.2")
        self.assertEqual(rows(backwards.decode(), "f"), rows(forwards.decode(), "f"))
        for keyword in ("v", "vt"):
            self.assertEqual(rows(backwards.decode(), keyword), rows(forwards.decode(), keyword))

    def ply(self, encoding):
        """The sheet with colours, a label and a quality at nodes, texture coordinates at corners and a part number."""
        nodes = [(float(x), float(y), float(z), *(int(255 * float(c)) for c in colour), k % 3, 0.5 * k)
                 for k, (x, y, z, *colour) in enumerate(rows(SHEET, "v"))]
        faces = [([int(word.split("/")[0]) - 1 for word in row], [0.125 * j for j in range(8)], 7 + k)
                 for k, row in enumerate(row[:4] for row in rows(SHEET, "f"))]
        header = (f"ply\nformat {encoding} 1.0\ncomment a sheet\nelement vertex 9\nproperty double x\nproperty double y\nproperty double z\n"
                  "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int label\nproperty float quality\n"
                  "element face 4\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty short part\n"
                  "element extra 1\nproperty int number\nend_header\n").encode()
        if encoding == "ascii":
            body = "".join(" ".join(map(str, node)) + "\n" for node in nodes)
            body += "".join(f"4 {' '.join(map(str, nodes))} 8 {' '.join(map(str, texture))} {part}\n" for nodes, texture, part in faces)
            return header + body.encode() + b"42\n"
        order = "<" if encoding == "binary_little_endian" else ">"
        return (header + b"".join(struct.pack(order + "dddBBBif", *node) for node in nodes) +
                b"".join(struct.pack(order + "B4iB8fh", 4, *nodes, 8, *texture, part) for nodes, texture, part in faces) + struct.pack(order + "i", 42))

    def test_ply_keeps_properties(self):
        for encoding in ("ascii", "binary_little_endian", "binary_big_endian"):
            data, report, _ = self.refined("sheet.ply", self.ply(encoding), "--refine", "1.2", "--strength", "0")
            header, body = data.split(b"end_header\n")
            self.assertIn(b"comment a sheet\nelement vertex 25\n", header)
            self.assertIn(b"element face 16\n", header)
            if encoding == "ascii":
                lines = [line.split() for line in body.decode().splitlines()]
                nodes = [tuple(map(float, line)) for line in lines[:25]]
                faces = [(list(map(int, line[1:5])), list(map(float, line[6:14])), int(line[14])) for line in lines[25:41]]
                self.assertEqual(lines[41:], [["42"]])
            else:
                order = "<" if encoding == "binary_little_endian" else ">"
                node, face = struct.Struct(order + "dddBBBif"), struct.Struct(order + "B4iB8fh")
                nodes = [node.unpack_from(body, k * node.size) for k in range(25)]
                raw = [face.unpack_from(body, 25 * node.size + k * face.size) for k in range(16)]
                faces = [(list(row[1:5]), list(row[6:14]), row[14]) for row in raw]
                self.assertEqual(body[25 * node.size + 16 * face.size:], struct.pack(order + "i", 42))
            self.assertEqual([face[2] for face in faces], [7] * 4 + [8] * 4 + [9] * 4 + [10] * 4)
            middle = next(k for k, row in enumerate(nodes) if row[:3] == (1, 1, 0.25))
            # Colours are means, rounded; a label is that of a node, and no mean; quality is a mean.
            self.assertEqual(nodes[middle][3:6], (191, 64, 0))
            self.assertIn(nodes[middle][6], (0, 1, 2))
            self.assertEqual(nodes[middle][7], 0.5 * (0 + 1 + 4 + 3) / 4)
            places = [faces[k][1][2 * faces[k][0].index(middle):][:2] for k in range(4)]
            self.assertEqual(places, [[0.375, 0.5]] * 4)
            self.assertEqual(faces[0][1][:2], [0, 0.125])

    def test_plain_and_whole_number_ply(self):
        body = "0 0 0\n2 0 0\n4 0 0\n0 2 0\n2 2 1\n4 2 0\n0 4 0\n2 4 0\n4 4 0\n4 0 1 4 3\n4 3 4 7 6\n4 1 2 5 4\n4 4 5 8 7\n"
        for kind in ("int", "double"):
            head = "ply\nformat ascii 1.0\nelement vertex 9\n" + "".join(f"property {kind} {axis}\n" for axis in "xyz")
            text = head + "element face 4\nproperty list uchar int vertex_indices\nend_header\n" + body
            data, *_ = self.refined("plain.ply", text, "--refine", "1.2", "--strength", "0")
            self.assertIn(b"property double z\n", data)
            self.assertIn(b"1 1 0.25", data)

    def test_off_keeps_colours(self):
        text = "COFF\n9 4 0\n" + "".join(
            f"{x} {y} {z} {int(255 * float(r))} {int(255 * float(g))} {int(255 * float(b))} 255 # node\n" for x, y, z, r, g, b in rows(SHEET, "v"))
        text += "4 0 1 4 3 9 8 7 # first\n4 3 4 7 6 1 1 1\n4 1 2 5 4\n4 4 5 8 7 0.5 0.25 1\n"
        data, *_ = self.refined("sheet.off", text, "--refine", "1.2", "--strength", "0")
        lines = data.decode().splitlines()
        self.assertEqual(lines[1], "25 16 0")
        self.assertEqual(lines[2:11], text.splitlines()[2:11])
        self.assertIn("1 1 0.25 191 64 0 255", lines)
        self.assertEqual([line.split("#")[0].split()[5:] for line in lines[27:]],
                         [["9", "8", "7"]] * 4 + [["1"] * 3] * 4 + [[]] * 4 + [["0.5", "0.25", "1"]] * 4)

    def stl(self):
        """An octahedron as binary STL, with attributes."""
        nodes = [[float(x) for x in row] for row in rows(OCTAHEDRON, "v")]
        faces = [[int(x) - 1 for x in row] for row in rows(OCTAHEDRON, "f")]
        return b"\0" * 80 + struct.pack("<I", 8) + b"".join(
            struct.pack("<12fH", 0, 0, 0, *(x for node in face for x in nodes[node]), k) for k, face in enumerate(faces))

    def test_stl_stays_a_closed_list_of_triangles(self):
        rules = {"rules": [{"nodes": [0, 1, 4, 5], "position": "fixed"}]}
        held = self.write("held.json", json.dumps(rules))
        data, report, _ = self.refined("ball.stl", self.stl(), "--refine", "turn:25", "--constraints", held)
        count, = struct.unpack_from("<I", data, 80)
        self.assertEqual(count, report["faces"])
        self.assertEqual(len(data), 84 + 50 * count)
        facets = [struct.unpack_from("<12fH", data, 84 + 50 * k) for k in range(count)]
        self.assertEqual([facet[12] for facet in facets], sorted(facet[12] for facet in facets))
        self.assertEqual({facet[12] for facet in facets}, set(range(8)))
        corners = [[facet[3 + 3 * k:6 + 3 * k] for k in range(3)] for facet in facets]
        self.assertEqual({count for _, count in edges({c: c for face in corners for c in face}, corners).values()}, {2})
        # The held ones, by their numbers in the input, which are those of their first corners.
        self.assertLess({(1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, -1)}, {c for face in corners for c in face})

    def test_text_stl(self):
        text = "solid ball\n"
        nodes = [[float(x) for x in row] for row in rows(OCTAHEDRON, "v")]
        for row in rows(OCTAHEDRON, "f"):
            text += "  facet normal 0 0 0\n    outer loop\n"
            text += "".join("      vertex {} {} {}\n".format(*nodes[int(x) - 1]) for x in row) + "    endloop\n  endfacet\n"
        data, report, _ = self.refined("ball.stl", text + "endsolid ball\n", "--refine", "0.8", "--fix", "none", "--region", "sphere:0,0,1,1.5")
        self.assertGreater(report["faces"], 8)
        self.assertEqual(data.count(b"endfacet"), report["faces"])
        self.assertTrue(data.startswith(b"solid ball") and data.endswith(b"endsolid ball\n"))

    def test_welded_sides_of_a_seam_get_the_same_nodes(self):
        # Each triangle has nodes of its own.
        lines = []
        nodes, faces = rows(grid(4), "v"), rows(grid(4), "f")
        for face in faces:
            lines += ["v " + " ".join(nodes[int(k) - 1]) for k in face]
        lines += [f"f {3 * k + 1} {3 * k + 2} {3 * k + 3}" for k in range(len(faces))]
        positions = lambda text: sorted({tuple(round(float(x), 9) for x in row) for row in rows(text.decode(), "v")})
        # Also if edges become shorter than nodes may be apart to be joined.
        for weld in ("0", "0.1"):
            data, report, said = self.refined("soup.obj", "\n".join(lines) + "\n", "--weld", weld, "--refine", "0.1")
            whole, of_whole, _ = self.refined("grid.obj", grid(4), "--refine", "0.1")
            self.assertEqual(report["faces"], of_whole["faces"])
            self.assertEqual(report["moving_nodes"], of_whole["moving_nodes"])
            self.assertEqual(report["nodes"] - report["weld"]["joined_nodes"], of_whole["nodes"])
            self.assertEqual(positions(data), positions(whole))
            self.assertEqual(data.decode().splitlines()[:1], lines[:1])

    def test_a_region_is_refined_alone(self):
        data, report, _ = self.refined("grid.obj", grid(16), "--region", "sphere:0.5,0.5,0,0.4", "--refine", "0.04")
        before = grid(16)
        # Faces around it stay, each where it was.
        lines = data.decode().splitlines()
        self.assertEqual([line for line in lines if line.startswith("v ")][:11], before.splitlines()[:11])
        self.assertLess({line for line in before.splitlines() if line.startswith("f ")} - set(lines), set(before.splitlines()))
        positions = [[float(x) for x in row] for row in rows(data.decode(), "v")]
        faces = [[int(x) - 1 for x in row] for row in rows(data.decode(), "f")]
        measured = edges(positions, faces)
        self.assertLess(max(count for _, count in measured.values()), 3)
        self.assertGreater(sum(length <= 0.04 for length, _ in measured.values()), 100)
        self.assertEqual(len(positions), 289 + report["refine"]["new_nodes"])

    def test_fits_to_points(self):
        points = self.write("points.xyz", "".join(f"{x / 20} {y / 20} {0.2 * math.sin(3 * x / 20)}\n" for x in range(21) for y in range(21)))
        coarse = self.write("grid.obj", grid(3, lambda x, y: 0))
        greatest = {}
        # To where the points end it is further than two of the new edges, and less than two of those before.
        for options in ((), ("--refine", "0.1"), ("--refine", "0.04")):
            result = run("fit", coarse, "--points", points, "-o", self.folder / "out.obj", "--weight", "1", "--fix", "none", "--report",
                         self.folder / "report.json", *options)
            self.assertEqual(result.returncode, 0, result.stderr)
            greatest[options] = self.read_json("report.json")["points"]["distance"]["after"]["rms"]
            self.assertEqual(self.read_json("report.json")["points"]["boundary"]["nodes_kept"], 0)
        for length in ("0.1", "0.04"):
            self.assertLess(greatest["--refine", length], greatest[()] / 10)

    def test_a_page_and_scalars_have_the_new_nodes(self):
        self.refined("grid.obj", grid(3), "--refine", "0.2", "--scalars", self.folder / "s.ply")
        self.assertIn(f"element vertex {self.read_json('report.json')['nodes']}".encode(), (self.folder / "s.ply").read_bytes())

    def test_the_same_bits_on_any_number_of_threads(self):
        one, *_ = self.refined("grid.obj", grid(5), "--refine", "0.07", "--threads", "1")
        four, *_ = self.refined("grid.obj", grid(5), "--refine", "0.07", "--threads", "4")
        self.assertEqual(one, four)

    def test_what_cannot_be_refined_is_refused(self):
        surface = self.write("grid.obj", grid(3))
        curve = self.write("curve.csv", "x,y\n0,0\n1,1\n2,0\n")
        for given in ("0", "-1", "nan", "inf", "x", "turn:0", "turn:180", "turn:", "turn:x", "length:1"):
            result = run("fair", surface, "-o", self.folder / "out.obj", "--refine", given)
            self.assertEqual(result.returncode, 1, given)
            self.assertIn(b"turn: with more than 0 and less than 180 degrees", result.stderr)
        for command, said in [(("fair", surface, "--refine", "1e-7"), b"new nodes"),
                              (("fair", surface, "--refine", "1", "--within", "0.1"), b"the nodes of the input pull"),
                              (("fit", curve, "--points", surface, "--weight", "1", "--refine", "1"), b"--refine is for surfaces")]:
            result = run(*command, "-o", self.folder / "out.obj")
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn(said, result.stderr)
        self.assertFalse((self.folder / "out.obj").exists())
        strips = self.write("stream.off", "OFF 4 2 0 0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2 3 0 2 3\n")
        result = run("fair", strips, "-o", self.folder / "out.off", "--refine", "0.1", "--constraints",
                     self.write("free.json", '{"rules": [{"nodes": [0], "position": "free"}]}'))
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn(b"convert it to PLY first", result.stderr)

    def test_nothing_to_divide_is_said(self):
        _, report, said = self.refined("grid.obj", grid(3), "--refine", "5")
        self.assertIn("--refine has no effect", said)
        self.assertEqual(report["refine"]["new_nodes"], 0)
