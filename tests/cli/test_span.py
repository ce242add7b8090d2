"""vspring span: surfaces from the curves of files, what is said of loops that stay open, and what is refused."""
import json
import math
import pathlib
import tempfile
import unittest

from support import run

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def circle(z, count=33):
    return [(math.cos(2 * math.pi * k / (count - 1)), math.sin(2 * math.pi * k / (count - 1)), z) for k in range(count)]


def obj(curves):
    """curves: by names."""
    text, first = "", 1
    for name, nodes in curves.items():
        text += f"g {name}\n" + "".join("v %.17g %.17g %.17g\n" % node for node in nodes)
        text += "l " + " ".join(str(first + k) for k in range(len(nodes))) + "\n"
        first += len(nodes)
    return text


TUBE = {"bottom": circle(0), "middle": circle(1), "top": circle(2), **{
    f"side_{k}": [(math.cos(math.pi * k / 2), math.sin(math.pi * k / 2), 2 * t / 8) for t in range(9)] for k in range(4)}}


class Span(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def span(self, name, text, *options, status=0, out="out.obj"):
        (self.folder / name).write_text(text)
        result = run("span", self.folder / name, "-o", self.folder / out, "--report", self.folder / "report.json", *options)
        self.assertEqual(result.returncode, status, result.stderr)
        return (self.folder / out).read_bytes(), json.loads((self.folder / "report.json").read_text()), (result.stdout + result.stderr).decode()

    def test_a_tube_of_curves(self):
        data, report, said = self.span("tube.obj", obj(TUBE))
        self.assertIn("spanned          8 of 10 loops of 20 curves: 8 by quads, 0 by triangles", said)
        lids = [number for number, loop in enumerate(report["loops"]) if loop["state"] == "lid"]
        self.assertEqual(len(lids), 2)
        self.assertIn(f"left open        lid: loops {lids[0]} (4 curves), {lids[1]} (4 curves); --also spans it", said)
        self.assertEqual((report["outcome"], report["spanned_loops"], report["warnings"]), ("converged", 8, []))
        lines = data.decode().splitlines()
        groups = [line for line in lines if line.startswith("g ")]
        self.assertEqual(groups, [f"g loop_{k}" for k in range(10) if k not in lids])
        nodes = [tuple(map(float, line.split()[1:])) for line in lines if line.startswith("v ")]
        self.assertEqual(len(nodes), report["nodes"])
        self.assertLess(max(abs(math.hypot(x, y) - 1) for x, y, _ in nodes), 1e-5)
        for loop in report["loops"]:
            self.assertEqual(len(loop["curves"]), len(loop["junctions"]))
            if loop["state"] == "spanned":
                self.assertTrue(loop["grid"])
        ring = next(curve for curve in report["curves"] if curve["loops"] == 1)
        self.assertTrue(ring["nodes"] and not ring["sharp"])

        said = self.span("tube.obj", obj(TUBE), "--also", f"{lids[0]},{lids[1]}")[2]
        self.assertIn("spanned          10 of 10 loops", said)
        said = self.span("tube.obj", obj(TUBE), "--without", "0")[2]
        self.assertIn("left open        as asked: loop 0 (4 curves)", said)

    def test_a_thin_body_that_bulges_is_said_to(self):
        def thin(sections):
            at = lambda y: [(x, 0.12 * z, y) for x, z, _ in circle(y)]
            sides = {f"side_{k}": [(math.cos(math.pi * k / 2), 0.12 * math.sin(math.pi * k / 2), 4 * t / 16) for t in range(17)] for k in range(4)}
            return {**{f"section_{k}": at(4 * k / (sections - 1)) for k in range(sections)}, **sides}
        said = self.span("thin.obj", obj(thin(5)))[2]
        self.assertRegex(said, r"the surface bulges between its curves: it is 0\.\d+ thick, the patches between them are 0\.24; add curves there, or take the patches as they are \(--flat\)")
        self.assertNotIn("bulges", self.span("flat.obj", obj(thin(5)), "--flat")[2])
        self.assertNotIn("bulges", self.span("many.obj", obj(thin(17)))[2])

    def test_sharp_curves_are_marked_and_taken_again(self):
        data, report, _ = self.span("tube.obj", obj(TUBE), "--sharp", "bottom,top")
        self.assertEqual(report["spanned_loops"], 10)
        self.assertEqual(sum(line.startswith("l ") for line in data.decode().splitlines()), 8)
        (self.folder / "again.json").write_text(json.dumps({"rules": [{"nodes": [0], "position": "fixed"}]}))
        result = run("fair", self.folder / "out.obj", "-o", self.folder / "again.obj", "--sharp", "marked",
                     "--constraints", self.folder / "again.json", "--report", self.folder / "again-report.json")
        self.assertEqual(json.loads((self.folder / "again-report.json").read_text())["sharp"]["edges"], report["sharp_edges"], result.stderr)
        _, report, said = self.span("tube.obj", obj(TUBE), "--sharp", "0,2")
        self.assertEqual(report["spanned_loops"], 10)
        said = self.span("tube.obj", obj(TUBE), "--without", "0", "--sharp", "middle", "--symmetry", "x=7")[2]
        self.assertNotIn("--sharp has no effect", said)
        self.assertIn("--symmetry has no effect here: the surface has no end in that plane, other than sharp ones", said)

    def test_tables_and_other_formats(self):
        rows = "x,y,z\n" + "\n\n".join("\n".join("%.17g,%.17g,%.17g" % node for node in nodes) for nodes in TUBE.values())
        data = self.span("tube.csv", rows)[0]
        self.assertEqual(data, self.span("tube.obj", obj(TUBE))[0])
        for out, start in (("out.ply", b"ply"), ("out.off", b"OFF"), ("out.stl", b"")):
            written, report, said = self.span("tube.obj", obj(TUBE), "--length", "0.1", out=out)
            self.assertTrue(written.startswith(start))
            self.assertNotIn("group", said)
        piped = run("span", "-", "-o", "-", "--quiet", stdin=obj(TUBE).encode())
        self.assertEqual(piped.stdout, data)

    def test_loose_curves_are_named(self):
        curves = {**TUBE, "antenna": [(1, 0, 2), (2, 0, 3)]}
        _, report, said = self.span("tube.obj", obj(curves))
        self.assertEqual(report["spanned_loops"], 8)
        self.assertEqual(report["warning_codes"], ["loose-curve"])
        self.assertIn("curves end freely at node 136 and bound nothing", said)

    def test_what_cannot_be_spanned_is_named_and_the_rest_is_written(self):
        # Two squares that touch: their common outer rim comes to one node twice.
        squares = {"a": [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 0)], "b": [(1, 1, 0), (2, 1, 0), (2, 2, 0), (1, 2, 0), (1, 1, 0)]}
        _, report, _ = self.span("two.obj", obj(squares))
        self.assertEqual((report["spanned_loops"], len(report["loops"])), (2, 3))
        outer = [loop["state"] for loop in report["loops"]].index("outer")
        _, report, said = self.span("two.obj", obj(squares), "--also", str(outer), status=3)
        self.assertEqual((report["spanned_loops"], report["loops"][outer]["state"]), (2, "unspannable"))
        self.assertEqual(report["warning_codes"], ["unspanned-loop"])
        self.assertIn("stays open: it comes to one node twice; add a curve that divides it", said)
        self.assertIn(f"left open        for the reasons above: loop {outer}", said)

    def test_refusals(self):
        (self.folder / "tube.obj").write_text(obj(TUBE))
        (self.folder / "open.obj").write_text(obj({"a": [(0, 0, 0), (1, 0, 0), (1, 1, 0)]}))
        for name, options, status, words in (
                ("tube.obj", ("--sharp", "lid"), 1, "--sharp lid: the file has no such group, and its curves go from 0 to 6; its groups are bottom, middle"),
                ("tube.obj", ("--sharp", "7"), 1, "--sharp 7: the file has no such group"),
                ("tube.obj", ("--also", "10"), 1, "10 in also is no loop; loops go from 0 to 9"),
                ("tube.obj", ("--length", "1e-6"), 1, "edges of length 1e-06 ask for"),
                ("tube.obj", ("--symmetry", "w"), 2, 'plane "w"'),
                ("tube.obj", ("--flat", "--tolerance", "1e-6"), 1, "excludes"),
                ("open.obj", (), 2, "no curves make a loop that a surface could span, as they end freely at nodes 0, 2; join curves that are further apart than"),
                ("none.obj", (), 2, "none.obj")):
            with self.subTest(name=name, options=options):
                result = run("span", self.folder / name, "-o", self.folder / "no.obj", *options)
                self.assertEqual(result.returncode, status, result.stderr)
                self.assertIn(words, result.stderr.decode())
                self.assertFalse((self.folder / "no.obj").exists())

    def test_shipped_examples(self):
        for name, options, loops in (("hull", ("--symmetry", "y"), 9), ("bottle", ("--sharp", "bottom"), 21), ("bonnet", ("--symmetry", "y", "--sharp", "feature"), 2)):
            with self.subTest(name=name):
                _, report, _ = self.span("lines.obj", (ROOT / f"examples/{name}-lines.obj").read_text(), *options)
                self.assertEqual((report["spanned_loops"], report["warnings"]), (loops, []))
                before, after = (report["fairness"][when]["vspring_energy"] for when in ("before", "after"))
                self.assertLess(after, before)

    def test_the_same_bits_on_any_number_of_threads(self):
        self.assertEqual(self.span("tube.obj", obj(TUBE), "--threads", 1)[0], self.span("tube.obj", obj(TUBE), "--threads", 4)[0])


if __name__ == "__main__":
    unittest.main()
