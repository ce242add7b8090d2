"""vspring fill: which holes are closed, what is said of the others, and what becomes of the file."""
import math
import re
import struct

from support import Case, bumps, grid, run, sphere

RADIUS = 2.0


def parsed(text):
    """Positions, and faces as numbers from 0, of OBJ."""
    rows = [line.split() for line in text.splitlines()]
    nodes = [tuple(map(float, row[1:4])) for row in rows if row[:1] == ["v"]]
    return nodes, [[int(word.split("/")[0]) - 1 for word in row[1:]] for row in rows if row[:1] == ["f"]]


def holed(cells=6, directions=((0, 0, 1),), angle=0.4):
    """Nodes and faces of a ball that lacks the faces around some directions."""
    nodes, faces = parsed(sphere(cells, RADIUS))
    cut = {k for k, node in enumerate(nodes) for way in directions
           if math.acos(max(-1, min(1, sum(a * b for a, b in zip(node, way)) / RADIUS / math.hypot(*way)))) < angle}
    left = [face for face in faces if not cut & set(face)]
    used = sorted({node for face in left for node in face})
    number = {node: k for k, node in enumerate(used)}
    return [nodes[k] for k in used], [[number[node] for node in face] for face in left]


def rims(faces):
    """The nodes of boundary edges."""
    sides = {(face[k - 1], face[k]) for face in faces for k in range(len(face))}
    return sorted({a for a, b in sides if (b, a) not in sides})


def obj(nodes, faces):
    return "".join("v {!r} {!r} {!r}\n".format(*node) for node in nodes) + "".join(
        "f " + " ".join(str(node + 1) for node in face) + "\n" for face in faces)


BOTH = ((0, 0, 1), (0.3, 0.9, -0.2))


class Fill(Case):
    def fill(self, name, text, *options, status=0, out=None):
        """What is written, the report, and what is said."""
        out = out or "out_" + name
        result = run("fill", self.write(name, text), "-o", self.folder / out, "--report", self.folder / "report.json", *options)
        self.assertEqual(result.returncode, status, result.stderr.decode())
        return (self.folder / out).read_bytes(), self.read_json("report.json"), (result.stdout + result.stderr).decode()

    def assert_closed_ball(self, data, name="again.obj"):
        """By a second run, which finds no hole, and by the distance of all nodes from the middle."""
        _, report, said = self.fill(name, data, out="closed.obj")
        self.assertEqual(report["holes"], [])
        self.assertIn("no hole", said)
        nodes, faces = parsed((self.folder / "closed.obj").read_text())
        for node in {tuple(nodes[k]) for face in faces for k in face}:
            self.assertAlmostEqual(math.hypot(*node), RADIUS, delta=2e-4)
        return nodes, faces

    def test_an_obj_keeps_all_that_it_had_and_the_patch_is_a_group(self):
        nodes, faces = holed()
        lines = ["# a ball", "mtllib ball.mtl", "o ball"]
        lines += ["v {!r} {!r} {!r} 0.{} 0 1 # red".format(*node, k % 7) for k, node in enumerate(nodes)]
        lines += ["vn {!r} {!r} {!r}".format(*(x / RADIUS for x in node)) for node in nodes] + ["vt 0 0", "usemtl red"]
        lines += ["f " + " ".join(f"{node + 1}/1/{node + 1}" for node in face) for face in faces]
        for line_end in ("\n", "\r\n"):
            text = line_end.join(lines)
            data, report, said = self.fill("ball.obj", text.encode())
            self.assertTrue(data.startswith(text.encode()))
            added = data[len(text):].decode().split(line_end)
            hole, = report["holes"]
            self.assertEqual((hole["state"], hole["outcome"]), ("filled", "converged"))
            self.assertEqual(hole["first_node"], len(nodes))
            self.assertEqual([line for line in added if line.startswith("g ")], [f"g hole_{hole['node']}"])
            new = [line.split() for line in added if line.startswith("v ")]
            self.assertEqual(len(new), hole["new_nodes"])
            self.assertGreater(len(new), 3)
            # The colours of nodes around.
            self.assertTrue(all(row[5:] == ["0", "1"] and re.fullmatch(r"0\.[0-6]", row[4]) for row in new), new)
            normals = [[float(x) for x in line.split()[1:]] for line in added if line.startswith("vn ")]
            for row, normal in zip(new, normals, strict=True):
                self.assertGreater(sum(float(a) * b for a, b in zip(row[1:4], normal)), 0.95 * RADIUS)
            self.assertTrue(all(re.fullmatch(r"f \d+//\d+ \d+//\d+ \d+//\d+", line) for line in added if line.startswith("f ")))
            self.assertIn("filled           1 of 1 hole", said)
            self.assert_closed_ball(data)
            # The group can be faired by its name.
            again = run("fair", self.folder / "out_ball.obj", "-o", self.folder / "fair.obj", "--region", f"group:hole_{hole['node']}")
            self.assertEqual(again.returncode, 0, again.stderr.decode())

    def test_a_ply_keeps_all_properties(self):
        nodes, faces = holed()
        header = ["ply", "format ascii 1.0", "comment a ball", f"element vertex {len(nodes)}"]
        header += [f"property float {name}" for name in ("x", "y", "z")] + ["property uchar red", "property float quality"]
        header += [f"property float {name}" for name in ("nx", "ny", "nz")]
        header += [f"element face {len(faces)}", "property int flags", "property list uchar int vertex_indices",
                   "property list uchar float texcoord", "element edge 1", "property int vertex1", "property int vertex2", "end_header"]
        rows = ["{:.6g} {:.6g} {:.6g} {} 0.5 {:.6g} {:.6g} {:.6g}".format(*node, 10 + k % 5, *(x / RADIUS for x in node))
                for k, node in enumerate(nodes)]
        patches = ["7 3 {} {} {} 6 0 0 0 0 0 0".format(*face) for face in faces]
        text = "\n".join(header + rows + patches + ["3 4"]) + "\n"
        data, report, _ = self.fill("ball.ply", text)
        hole, = report["holes"]
        out = data.decode().splitlines()
        start = out.index("end_header") + 1
        count = len(nodes) + hole["new_nodes"]
        self.assertIn(f"element vertex {count}", out)
        self.assertIn(f"element face {len(faces) + hole['new_faces']}", out)
        self.assertEqual(out[start:start + len(nodes)], rows)
        for row in out[start + len(nodes):start + count]:
            words = row.split()
            self.assertIn(int(words[3]), range(10, 15))
            self.assertEqual(words[4], "0.5")
            self.assertGreater(sum(float(a) * float(b) for a, b in zip(words[:3], words[5:])), 0.95 * RADIUS)
        self.assertEqual(out[start + count:start + count + len(faces)], patches)
        self.assertTrue(all(re.fullmatch(r"7 3 \d+ \d+ \d+ 0", row) for row in out[start + count + len(faces):-1]))
        self.assertEqual(out[-1], "3 4")
        self.assert_closed_ball(data, "again.ply")

    def test_a_binary_ply_of_either_kind_grows(self):
        nodes, faces = holed()
        for order, name in (("<", "little"), (">", "big")):
            for coloured in (False, True):
                header = f"ply\nformat binary_{name}_endian 1.0\nelement vertex {len(nodes)}\n"
                header += "property double x\nproperty double y\nproperty double z\n" + ("property uchar red\n" if coloured else "")
                header += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
                places = b"".join(struct.pack(order + "3d", *node) + (b"\x09" if coloured else b"") for node in nodes)
                patches = b"".join(struct.pack(order + "B3i", 3, *face) for face in faces)
                data, report, _ = self.fill("ball.ply", header.encode() + places + patches)
                body = data[data.index(b"end_header\n") + 11:]
                self.assertTrue(body.startswith(places))
                hole, = report["holes"]
                size = 25 if coloured else 24
                self.assertEqual(len(body), size * (len(nodes) + hole["new_nodes"]) + 13 * (len(faces) + hole["new_faces"]))
                self.assertTrue(body[size * (len(nodes) + hole["new_nodes"]):].startswith(patches))
                if coloured:
                    self.assertEqual(set(body[24:size * (len(nodes) + hole["new_nodes"]):25]), {9})
                self.assert_closed_ball(data, "again.ply")

    def test_off_and_stl_grow(self):
        nodes, faces = holed()
        rows = ["{!r} {!r} {!r} 255 0 {} 255 # {}".format(*node, k % 9, k) for k, node in enumerate(nodes)]
        patches = ["3 {} {} {} # a face".format(*face) for face in faces]
        text = "\n".join(["COFF # a ball", f"{len(nodes)} {len(faces)} 0", *rows, *patches])
        data, report, _ = self.fill("ball.off", text)
        out = data.decode().splitlines()
        count = report["holes"][0]["new_nodes"]
        self.assertEqual(out[1], f"{len(nodes) + count} {len(faces) + report['holes'][0]['new_faces']} 0")
        self.assertEqual(out[2:2 + len(nodes)], rows)
        self.assertTrue(all(re.fullmatch(r"\S+ \S+ \S+ 255 0 [0-8] 255", row) for row in out[2 + len(nodes):2 + len(nodes) + count]))
        self.assertEqual(out[2 + len(nodes) + count:][:len(faces)], patches)
        self.assert_closed_ball(data, "again.off")

        facets = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for node in face for x in nodes[node]), 5) for face in faces)
        data, report, _ = self.fill("ball.stl", b"\0" * 80 + struct.pack("<I", len(faces)) + facets)
        self.assertTrue(data[84:].startswith(facets))
        self.assertEqual(struct.unpack_from("<I", data, 80)[0], len(faces) + report["new_faces"])
        self.assert_closed_ball(data, "again.stl")
        solid = "solid ball\n" + "".join(
            "facet normal 0 0 0\nouter loop\n" + "".join("vertex {!r} {!r} {!r}\n".format(*nodes[node]) for node in face)
            + "endloop\nendfacet\n" for face in faces)
        data, _, _ = self.fill("ball.stl", solid + "endsolid ball of facets\n")
        self.assertTrue(data.startswith(solid.encode()[:-1]))
        self.assertTrue(data.endswith(b"endfacet\nendsolid ball of facets\n"))
        self.assert_closed_ball(data, "again.stl")
        # Another format holds it, too.
        self.fill("ball.off", text, out="ball.ply")
        self.assert_closed_ball((self.folder / "ball.ply").read_bytes(), "again.ply")

    def test_which_holes(self):
        nodes, faces = holed(8, BOTH)
        text = obj(nodes, faces)
        self.assert_closed_ball(self.fill("two.obj", text)[0])
        holes = self.fill("two.obj", text, "--flat")[1]["holes"]
        self.assertEqual([hole["outcome"] for hole in holes], [None, None])
        larger = max(holes, key=lambda hole: hole["length"])
        middle = sum(hole["length"] for hole in holes) / 2
        edges = min(hole["edges"] for hole in holes)
        for options, states in ((("--max-size", middle), {"filled", "too-large"}), (("--max-edges", edges), {"filled", "too-large"}),
                                (("--max-edges", 3), {"too-large"}), (("--at", f"{larger['node']}"), {"filled", "elsewhere"}),
                                (("--at", ",".join(str(hole["node"]) for hole in holes)), {"filled"})):
            report = self.fill("two.obj", text, "--flat", *options)[1]
            self.assertEqual({hole["state"] for hole in report["holes"]}, states, options)
        inner = next(node for node in range(len(nodes)) if node not in rims(faces))
        for node, word in ((inner, f"node {inner} is at no hole"), (len(nodes), f"{len(nodes)} is not a node")):
            result = run("fill", self.folder / "two.obj", "-o", self.folder / "no.obj", "--at", node)
            self.assertEqual(result.returncode, 2)
            self.assertIn(word, self.assert_one_line(result))
            self.assertNotIn("no.obj", self.files())

    def test_outer_rims_stay_and_closed_surfaces_too(self):
        for text, word in ((grid(6), "outer rims: at node 0 (24 edges); --outer-rims or --at fills them"), (sphere(4), "no hole")):
            data, report, said = self.fill("as-is.obj", text)
            self.assertEqual(data, text.encode())
            self.assertIn(word, said)
            self.assertIn("filled           nothing: the surface has no hole", said)
            self.assertEqual(report["filled_holes"], 0)
        for height, state, status in ((bumps, "filled", 0), (lambda x, y: 0.0, "unfillable", 3)):
            report = self.fill("sheet.obj", grid(6, height), "--outer-rims", "--flat", status=status)[1]
            self.assertEqual([hole["state"] for hole in report["holes"]], [state])

    def test_what_cannot_be_filled_is_named_and_the_rest_is_written(self):
        nodes, faces = holed(8, BOTH)
        sides = {(face[k - 1], face[k]) for face in faces for k in range(3)}
        rim = rims(faces)
        at, inner = next((a, b) for a, b in sorted(sides) if (b, a) in sides and a in rim and b not in rim)
        fin = nodes + [tuple(1.4 * x for x in nodes[at])]
        data, report, said = self.fill("fin.obj", obj(fin, faces + [[at, inner, len(nodes)]]), status=3)
        self.assertIn("filled", [hole["state"] for hole in report["holes"]])
        self.assertIn("unfillable", [hole["state"] for hole in report["holes"]])
        self.assertRegex(said, r"the hole at node \d+ stays open: at node (%d|%d) of its rim more than two faces share an edge" % (at, inner))
        self.assertIn("unfilled-hole", report["warning_codes"])
        self.assertGreater(len(data), len(obj(fin, faces)))

    def test_seams_are_welded_not_filled(self):
        nodes, faces = holed()
        soup = [nodes[node] for face in faces for node in face]
        text = obj(soup, [[3 * k, 3 * k + 1, 3 * k + 2] for k in range(len(faces))])
        data, report, said = self.fill("soup.obj", text, "--weld", 0)
        self.assertTrue(data.startswith(text.encode()))
        self.assertEqual(report["filled_holes"], 1)
        out, patches = parsed(data.decode())
        # All that is new meets the soup at nodes of the soup.
        self.assertEqual(len(out), len(soup) + report["new_nodes"])
        self.assertEqual(self.fill("again.obj", data, "--weld", 0)[1]["holes"], [])
        twin = next(k for k, node in enumerate(soup) if k > 0 and node == nodes[report["holes"][0]["node"]] or k == report["holes"][0]["node"])
        self.assertEqual(self.fill("soup.obj", text, "--weld", 0, "--at", twin)[1]["filled_holes"], 1)

    def test_threads_options_and_bad_input(self):
        text = obj(*holed(8, BOTH))
        self.assertEqual(self.fill("two.obj", text, "--threads", 1)[0], self.fill("two.obj", text, "--threads", 4)[0])
        file = self.write("two.obj", text)
        for options, word in ((("--flat", "--tolerance", 1e-3), "--flat"), (("--max-edges", 2), "--max-edges"), (("--max-size", 0), "--max-size"),
                              (("--at", "x"), "--at")):
            result = run("fill", file, "-o", self.folder / "no.obj", *options)
            self.assertEqual(result.returncode, 1)
            self.assertIn(word, self.assert_one_line(result))
        result = run("fill", self.write("points.obj", "v 0 0 0\nv 1 0 0\n"), "-o", self.folder / "no.obj")
        self.assertEqual(result.returncode, 2)
        self.assertIn("no face", self.assert_one_line(result))
        self.assertNotIn("no.obj", self.files())
