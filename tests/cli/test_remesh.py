"""--remesh: new triangles for the part that moves, what is said of them, and what becomes of the file."""
import math
import struct

from support import Case, run

CORNERS = [(x, y, z) for z in (-1, 1) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
SIDES = [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]


def rows(text, keyword):
    return [line.split("#")[0].split()[1:] for line in text.splitlines() if line.split()[:1] == [keyword]]


def obj(nodes, faces, more=""):
    return "".join("v " + " ".join(map(str, node)) + "\n" for node in nodes) + more + \
        "".join("f " + " ".join(str(node + 1) for node in face) + "\n" for face in faces)


def mesh_of(text):
    """Positions and faces of an OBJ, all by their first numbers."""
    return ([tuple(map(float, row[:3])) for row in rows(text, "v")],
            [[int(corner.split("/")[0]) - 1 for corner in row] for row in rows(text, "f")])


def least_angle(nodes, faces):
    least = 180
    for face in faces:
        for k in range(3):
            a, b, c = (nodes[face[(k + j) % 3]] for j in range(3))
            u, v = ([q - p for p, q in zip(a, end)] for end in (b, c))
            cosine = sum(p * q for p, q in zip(u, v)) / math.hypot(*u) / math.hypot(*v)
            least = min(least, math.degrees(math.acos(max(-1, min(1, cosine)))))
    return least


def triangles_of_stl(data):
    count, = struct.unpack_from("<I", data, 80)
    return [[struct.unpack_from("<3f", data, 84 + 50 * k + 12 * (j + 1)) for j in range(3)] for k in range(count)]


def stl(triangles):
    return b"\0" * 80 + struct.pack("<I", len(triangles)) + \
        b"".join(struct.pack("<12fH", 0, 0, 0, *(x for corner in triangle for x in corner), 0) for triangle in triangles)


def turned(heights, radii, sides, bend):
    """A tube as CAD programs export it: needles from one circle to the next. bend: how much it leans with the square of the height."""
    rings = [[(r * math.cos(2 * math.pi * j / sides) + bend * z * z, r * math.sin(2 * math.pi * j / sides), z) for j in range(sides)]
             for z, r in zip(heights, radii)]
    triangles = []
    for low, high in zip(rings, rings[1:]):
        for j in range(sides):
            k = (j + 1) % sides
            triangles += [(low[j], high[k], high[j]), (low[j], low[k], high[k])]
    return triangles


# A sheet of 9 × 9 nodes with colours and one set of texture coordinates, two groups with their own materials, and lines.
SIZE = 9
SHEET = "".join(f"v {i} {j} {math.sin(i) * math.sin(j) / 3:.6f} {i / 8} {j / 8} 0\n" for i in range(SIZE) for j in range(SIZE)) + \
    "".join(f"vt {i / 8} {j / 8}\n" for i in range(SIZE) for j in range(SIZE)) + "l 1 2 3\nl 41 42\n" + \
    "".join(f"g {name}\nusemtl {name}\n" + "".join(
        "f " + " ".join(f"{n}/{n}" for n in (SIZE * i + j + 1, SIZE * i + j + 10, SIZE * i + j + 11, SIZE * i + j + 2)) + "\n"
        for i in columns for j in range(SIZE - 1)) for name, columns in (("west", range(4)), ("east", range(4, 8))))


class Remesh(Case):
    def remeshed(self, name, text, *options, out=None, status=0, command=("fair",)):
        """What is written, the report, and what is said."""
        out = out or "out_" + name
        result = run(*command, self.write(name, text), "-o", self.folder / out, "--report", self.folder / "report.json", *options)
        self.assertEqual(result.returncode, status, result.stderr.decode())
        return (self.folder / out).read_bytes(), self.read_json("report.json"), (result.stdout + result.stderr).decode()

    def test_a_tube_of_needles_becomes_fair_where_it_could_not_before(self):
        data = stl(turned((0, 12, 13, 30), (3, 5, 5, 2), 48, 0.02))
        _, before, said = self.remeshed("tube.stl", data)
        self.assertIn("it is bent more", said)
        out, report, said = self.remeshed("tube.stl", data, "--remesh", "1")
        self.assertNotIn("it is bent more", said)
        energies = [{when: run["fairness"][when]["vspring_energy"] for when in ("before", "after")} for run in (before, report)]
        self.assertGreater(energies[0]["after"], energies[0]["before"])
        self.assertLess(energies[1]["after"], 0.2 * energies[1]["before"])
        self.assertEqual(report["remesh"]["length"], 1)
        self.assertIn("remeshed         to edges of about 1 units", said)
        self.assertEqual(len(triangles_of_stl(out)), report["faces"])
        # The rims, of which the nodes are held, have all their edges.
        for height, radius in ((0, 3), (30, 2)):
            rim = {corner for triangle in triangles_of_stl(out) for corner in triangle if corner[2] == height}
            self.assertEqual(len(rim), 48)

    def test_the_bits_do_not_depend_on_threads(self):
        data = stl(turned((0, 12, 13, 30), (3, 5, 5, 2), 48, 0.02))
        options = ("--remesh", "2", "--max-iterations", "3", "--method", "sweep")
        one, _, _ = self.remeshed("tube.stl", data, *options, "--threads", "1", status=3)
        two, _, _ = self.remeshed("tube.stl", data, *options, "--threads", "2", status=3)
        self.assertEqual(one, two)

    def test_an_obj_keeps_groups_and_interpolates_colours_and_texture_coordinates(self):
        data, report, _ = self.remeshed("sheet.obj", SHEET, "--remesh", "0.5", "--region", "sphere:4,4,0,2.5", "--strength", "0")
        text = data.decode()
        self.assertEqual(report["nodes"], len(rows(text, "v")))
        self.assertEqual(report["nodes"], 81 + report["remesh"]["new_nodes"] - report["remesh"]["removed_nodes"])
        self.assertEqual(report["faces"], 64 + report["remesh"]["new_faces"])
        self.assertGreater(report["remesh"]["removed_nodes"], 0)
        self.assertEqual(rows(text, "usemtl"), [["west"], ["east"]])
        positions, faces = mesh_of(text)
        self.assertEqual({node for face in faces for node in face}, set(range(len(positions))))
        coordinates = rows(text, "vt")
        for row in rows(text, "v"):
            x, y, red, green = float(row[0]), float(row[1]), float(row[3]), float(row[4])
            self.assertAlmostEqual(red, x / 8, 6)
            self.assertAlmostEqual(green, y / 8, 6)
        for row in rows(text, "f"):
            for corner in row:
                node, item = (int(word) - 1 for word in corner.split("/"))
                for value, place in zip(coordinates[item], positions[node]):
                    self.assertAlmostEqual(float(value), place / 8, 6)
        west = text[text.index("g west"):text.index("g east")]
        for face in mesh_of(west)[1]:
            self.assertLess(sum(positions[node][0] for node in face) / len(face), 4.3)
        # What does not move is as it was, and lines of nodes that are gone are gone.
        self.assertEqual(rows(text, "l"), [["1", "2", "3"]])
        for line in SHEET.splitlines():
            if line.startswith("v 0 ") or line.startswith("v 8 "):
                self.assertIn(line + "\n", text)
        self.assertIn("f 1/1 10/10 11/11 2/2\n", text)

    def test_texture_coordinates_with_a_seam_are_left_out_with_a_warning(self):
        text = SHEET.replace("g east", "vt 9 9\ng east").replace("41/41", "41/82").replace("41/82", "41/41", 2)
        data, _, said = self.remeshed("sheet.obj", text, "--remesh", "0.5", "--region", "sphere:4,4,0,2.5")
        self.assertIn("new triangles have no vt", said)
        corners = [corner for row in rows(data.decode(), "f") for corner in row]
        self.assertTrue(any("/" in corner for corner in corners))
        self.assertTrue(any("/" not in corner for corner in corners))

    def test_a_ply_has_no_edges_of_nodes_that_are_gone(self):
        header = "ply\nformat ascii 1.0\nelement vertex 81\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n" \
            "element face 64\nproperty list uchar int vertex_indices\nproperty int part\n" \
            "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
        nodes = "".join(f"{i} {j} {i * j / 50} {20 * i}\n" for i in range(SIZE) for j in range(SIZE))
        faces = "".join(f"4 {SIZE * i + j} {SIZE * i + j + 9} {SIZE * i + j + 10} {SIZE * i + j + 1} {i}\n" for i in range(8) for j in range(8))
        data, report, said = self.remeshed("sheet.ply", header + nodes + faces + "0 1\n", "--remesh", "1.2", "--strength", "0")
        self.assertIn("left out where nodes are others: the element edge", said)
        lines = data.decode().split("\n")
        self.assertIn("element edge 0", lines)
        begin = lines.index("end_header") + 1
        rows_of_nodes = [line.split() for line in lines[begin:begin + report["nodes"]]]
        for x, _, _, red in rows_of_nodes:
            self.assertEqual(int(red), round(20 * float(x)))
        rows_of_faces = [list(map(int, line.split())) for line in lines[begin + report["nodes"]:] if line]
        self.assertEqual(len(rows_of_faces), report["faces"])
        for size, *rest in rows_of_faces:
            corners, part = rest[:size], rest[size]
            middle = sum(float(rows_of_nodes[node][0]) for node in corners) / size
            self.assertAlmostEqual(middle, part + 0.5, delta=0.55)

    def test_sharp_edges_stay_and_corners_too(self):
        for name, more, options in (("cube.obj", "", ("--sharp", "40")), ("marked.obj", "l 1 2 6 5 1\n", ("--sharp", "40,marked"))):
            data, report, _ = self.remeshed(name, obj(CORNERS, SIDES, more), "--remesh", "0.4", *options)
            self.assertEqual(len(report["sharp"]["chains"]), 12)
            self.assertAlmostEqual(sum(chain["length"] for chain in report["sharp"]["chains"]), 24, 9)
            nodes, faces = mesh_of(data.decode())
            self.assertEqual(nodes[:8], [tuple(map(float, corner)) for corner in CORNERS])
            self.assertGreater(least_angle(nodes, faces), 25)

    def test_a_welded_seam_is_closed(self):
        # Two halves that share no node.
        nodes = [(x, y, math.sin(x) / 4) for half in (0, 4) for x in range(half, half + 5) for y in range(9)]
        faces = [[45 * half + 9 * i + j for i, j in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]
                 for half in (0, 1) for i in range(4) for j in range(8)]
        data, report, _ = self.remeshed("halves.obj", obj(nodes, faces), "--remesh", "0.8", "--weld", "0")
        positions, triangles = mesh_of(data.decode())
        edges = {}
        for face in triangles:
            for a, b in zip(face, face[1:] + face[:1]):
                edges[min(a, b), max(a, b)] = edges.get((min(a, b), max(a, b)), 0) + 1
        boundary = [edge for edge, count in edges.items() if count == 1]
        for edge in boundary:
            for node in edge:
                x, y, _ = positions[node]
                self.assertTrue(x in (0, 8) or y in (0, 8), positions[node])
        self.assertEqual(report["nodes"], len(positions))

    def test_a_mesh_is_fitted_after_it_was_remeshed(self):
        points = "".join(f"{x / 4} {y / 4} {math.sin(x / 4) * math.sin(y / 4) / 3}\n" for x in range(33) for y in range(33))
        data, report, _ = self.remeshed("sheet.obj", SHEET, "--points", self.write("points.xyz", points), "--within", "0.05",
                                        "--remesh", "0.5", command=("fit",))
        self.assertGreater(report["remesh"]["new_nodes"], 150)
        self.assertEqual(len(rows(data.decode(), "v")), report["nodes"])

    def test_auto_is_the_median_edge(self):
        flat = [(i, j, 0) for i in range(5) for j in range(5)]
        faces = [[5 * i + j, 5 * i + j + 5, 5 * i + j + 6, 5 * i + j + 1] for i in range(4) for j in range(4)]
        _, report, _ = self.remeshed("flat.obj", obj(flat, faces), "--remesh", "auto")
        self.assertEqual(report["remesh"]["length"], 1)

    def test_what_cannot_be_remeshed_is_refused(self):
        self.write("cube.obj", obj(CORNERS, SIDES))
        self.write("sheet.obj", SHEET)
        self.write("line.csv", "0,0\n1,1\n2,1\n3,0\n")
        for words, status, message in (
                ("fair sheet.obj --remesh 0", 1, "a length greater than 0, or auto, is needed, not 0"),
                ("fair sheet.obj --remesh turn:10", 1, "is needed, not turn:10"),
                ("fair sheet.obj --remesh 1 --refine 1", 1, "excludes"),
                ("fair sheet.obj --remesh 1 --symmetry x", 1, "--remesh cannot be given with --symmetry"),
                ("fair sheet.obj --remesh 1 --noise auto", 1, "--remesh: the nodes of the input pull"),
                ("fair sheet.obj --remesh 1e-5", 1, "more than 10000000 are refused"),
                ("fit line.csv --points line.csv --weight 1 --remesh 1", 1, "--remesh is for surfaces")):
            command, name, *options = words.split()
            options = [self.folder / word if word.endswith(".csv") else word for word in options]
            result = run(command, self.folder / name, "-o", self.folder / ("out" + name[-4:]), *options)
            self.assertEqual(result.returncode, status, words + result.stderr.decode())
            self.assertIn(message, result.stderr.decode(), words)
