"""What --scalars writes."""
import base64
import json
import math
import re
import struct
import xml.etree.ElementTree as xml

import support
from support import Case, grid, hat, run, sphere
from test_measure import circle


class Scalars(Case):
    def make(self, *arguments, name="out.vtp", status=0):
        result = run(*arguments, "--scalars", self.folder / name, "--quiet")
        self.assertEqual(result.returncode, status, result.stderr.decode())
        return self.folder / name

    def arrays(self, path):
        """The piece, and its arrays by name."""
        root = xml.parse(path).getroot()
        self.assertEqual((root.tag, root.get("type")), ("VTKFile", "PolyData"))
        piece = root.find("PolyData/Piece")
        read = {"Float64": float, "Int64": int}
        return piece, {a.get("Name"): [read[a.get("type")](word) for word in a.text.split()] for a in piece.iter("DataArray")}

    def test_a_sphere(self):
        text = sphere(12, radius=2.5)
        piece, arrays = self.arrays(self.make("measure", self.write("in.obj", text)))
        nodes, faces = text.count("v "), text.count("f ")
        self.assertEqual((int(piece.get("NumberOfPoints")), int(piece.get("NumberOfPolys"))), (nodes, faces))
        self.assertEqual(set(arrays), {"mean_curvature", "gaussian_curvature", "principal_curvature_1", "principal_curvature_2",
                                       "Points", "connectivity", "offsets"})
        for name, wanted in (("mean_curvature", 1 / 2.5), ("gaussian_curvature", 1 / 6.25), ("principal_curvature_1", 1 / 2.5),
                             ("principal_curvature_2", 1 / 2.5)):
            self.assertEqual(len(arrays[name]), nodes)
            self.assertLess(max(abs(value / wanted - 1) for value in arrays[name]), 0.01, name)
        coordinates = [float(word) for line in text.splitlines() if line[0] == "v" for word in line.split()[1:]]
        self.assertEqual(arrays["Points"], coordinates)
        corners = [int(word) - 1 for line in text.splitlines() if line[0] == "f" for word in line.split()[1:]]
        self.assertEqual(arrays["connectivity"], corners)
        self.assertEqual(arrays["offsets"], list(range(3, 3 * faces + 1, 3)))

    def test_deviation_from_the_input(self):
        path, out = self.write("in.obj", hat()), self.folder / "out.obj"
        piece, arrays = self.arrays(self.make("fair", path, "-o", out, "--report", self.folder / "r.json"))
        report = self.read_json("r.json")
        self.assertTrue(math.isclose(max(arrays["deviation"]), report["greatest_move"], rel_tol=1e-12))
        self.assertTrue(all(abs(a) <= d * (1 + 1e-9) for a, d in zip(arrays["deviation_along_normal"], arrays["deviation"])))
        # The tip of the hat, the first node, goes down.
        self.assertLess(arrays["deviation_along_normal"][0], -0.5 * arrays["deviation"][0])
        self.assertEqual(arrays["offsets"], [3 * k for k in range(1, 13)] + [36 + 4 * k for k in range(1, 37)])

    def test_deviation_from_another_mesh(self):
        high = lambda x, y: 0.25
        low = lambda x, y: 0
        path = self.write("in.obj", grid(6, high))
        same = self.make("measure", path, "--compare", self.write("same.obj", grid(6, low)))
        _, arrays = self.arrays(same)
        self.assertTrue(all(math.isclose(v, 0.25) for v in arrays["deviation"] + arrays["deviation_along_normal"]))
        _, arrays = self.arrays(self.make("measure", path, "--compare", self.write("other.obj", grid(5, low))))
        self.assertTrue(all(math.isclose(v, 0.25) for v in arrays["deviation"]))
        self.assertNotIn("deviation_along_normal", arrays)

    def test_ply(self):
        text = sphere(8)
        data = self.make("measure", self.write("in.obj", text), name="out.ply").read_bytes()
        header, body = data.split(b"end_header\n", 1)
        names = [line.split()[-1] for line in header.decode().splitlines() if line.startswith("property double")]
        self.assertEqual(names, ["x", "y", "z", "mean_curvature", "gaussian_curvature", "principal_curvature_1", "principal_curvature_2"])
        for k in range(text.count("v ")):
            values = struct.unpack_from("<7d", body, 56 * k)
            self.assertAlmostEqual(math.hypot(*values[:3]), 2)
            self.assertLess(abs(values[3] * 2 - 1), 0.03)
        # It is read again like any other.
        self.assertEqual(run("measure", self.folder / "out.ply").returncode, 0)

    def test_a_curve(self):
        piece, arrays = self.arrays(self.make("measure", self.write("in.csv", circle(40, 2.0)), "--closed"))
        self.assertEqual((piece.get("NumberOfLines"), piece.get("NumberOfPolys")), ("1", "0"))
        self.assertEqual(arrays["connectivity"], [*range(40), 0])
        self.assertTrue(all(math.isclose(value, 0.5, rel_tol=1e-9) for value in arrays["curvature"]))
        edge = 4 * math.sin(math.pi / 40)
        self.assertTrue(all(math.isclose(a, k * edge, rel_tol=1e-9, abs_tol=1e-12) for k, a in enumerate(arrays["arc_length"])))
        out = self.folder / "out.csv"
        _, arrays = self.arrays(self.make("curve", self.folder / "in.csv", "-o", out, "--report", self.folder / "r.json"))
        self.assertTrue(math.isclose(max(arrays["deviation"]), self.read_json("r.json")["greatest_move"], rel_tol=1e-9))

    def test_report_page_and_scalars_agree(self):
        """Bit for bit, whatever else is written; figures of a region are those of its nodes."""
        options = ("fair", self.write("in.obj", grid(14)), "-o", self.folder / "out.obj", "--region", "sphere:0.6,0.4,0,0.3", "--report")
        self.assertEqual(run(*options, self.folder / "alone.json").returncode, 0)
        path = self.make(*options, self.folder / "r.json", "--html", self.folder / "p.html")
        fairness = self.read_json("r.json")["fairness"]
        self.assertEqual(fairness, self.read_json("alone.json")["fairness"])
        _, arrays = self.arrays(path)
        corners = arrays["connectivity"]
        faces = [corners[k:k + 3] for k in range(0, len(corners), 3)]
        moved = {k for k, d in enumerate(arrays["deviation"]) if d > 0}
        counted = {node for face in faces if moved & set(face) for node in face}
        figures, mean, gaussian = fairness["after"], arrays["mean_curvature"], arrays["gaussian_curvature"]
        for key, end in (("greatest", max), ("least", min)):
            self.assertEqual(figures[f"{key}_mean_curvature"], figures["diagonal"] * end(mean[k] for k in counted))
        scene = json.loads(re.search('id="scene">(.*?)</script>', (self.folder / "p.html").read_text()).group(1))
        points = [arrays["Points"][k::3] for k in range(3)]
        diagonal = math.hypot(*(max(part) - min(part) for part in points))
        # Half floats are rounded from floats, as Eigen does.
        rounded = lambda value: struct.unpack("<f", struct.pack("<f", value))[0]
        for name, values, factor in (("mean", mean, diagonal), ("gaussian", gaussian, diagonal ** 2)):
            self.assertEqual(base64.b64decode(scene["shapes"][1][name]), b"".join(struct.pack("<e", rounded(factor * value)) for value in values))

    def test_refusals(self):
        surface, curve = self.write("in.obj", hat()), self.write("in.csv", circle())
        for arguments, status, word in ((("measure", surface, "--scalars", "out.vtu"), 1, ".vtp"), (("measure", curve, "--scalars", "out.ply"), 1, ".vtp"),
                                        (("measure", surface, "--scalars", surface), 1, "already"),
                                        (("measure", surface, "--scalars", self.folder / "no" / "out.vtp"), 2, "no"),
                                        (("fair", surface, "-o", self.folder / "a.ply", "--scalars", self.folder / "a.ply"), 1, "--scalars")):
            result = run(*arguments)
            self.assertEqual(result.returncode, status, arguments)
            self.assertIn(word, self.assert_one_line(result))
        self.assertEqual(self.files(), ["in.csv", "in.obj"])


if __name__ == "__main__":
    support.unittest.main()
