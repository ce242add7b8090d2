"""What `vspring measure` says."""
import json
import math
import random

import support
from support import Case, grid, hat, run


def circle(count=40, radius=2.0):
    return "".join(f"{radius * math.cos(2 * math.pi * k / count):.17g},{radius * math.sin(2 * math.pi * k / count):.17g}\n"
                   for k in range(count))


class Measure(Case):
    def measure(self, *arguments, status=0, **options):
        result = run("measure", *arguments, **options)
        self.assertEqual(result.returncode, status, result.stderr.decode())
        return result

    def report(self, *arguments, **options):
        self.measure(*arguments, "--quiet", "--report", self.folder / "report.json", **options)
        return self.read_json("report.json")

    def test_a_surface_for_people(self):
        lines = self.measure(self.write("in.obj", hat())).stdout.decode().splitlines()
        for name in ("V-Spring energy", "bending energy", "greatest turn", "flipped faces", "self-intersections", "smallest angle"):
            self.assertEqual(sum(line.startswith(name) for line in lines), 1, name)
        # Definitions stand below each other.
        self.assertEqual(len({len(line) - len(line.split("  ")[-1].lstrip()) for line in lines}), 1, lines)
        self.assertNotIn("\x1b", "".join(lines))

    def test_says_where_there_is_no_noise_that_auto_takes(self):
        for text, is_there in (("".join(f"{k},{2 * k}\n" for k in range(20)), False), (circle(), True)):
            lines = self.measure(self.write("in.csv", text)).stdout.decode()
            self.assertEqual("the value of --noise auto" in lines, is_there)
            self.assertEqual("the numbers show no noise" in lines, not is_there)

    def test_a_coordinate_that_is_no_number(self):
        bad_mesh = self.write("bad.obj", grid(4, lambda x, y: "nan" if (x, y) == (0.5, 0.25) else 0))
        bad_curve = self.write("bad.csv", "0,0\n1,1\n2,nan\n3,1\n4,0\n")
        good = self.write("good.obj", grid(4, lambda x, y: 0))
        for node, arguments in ((7, [bad_mesh]), (2, [bad_curve]), (7, [good, "--compare", bad_mesh])):
            text = self.assert_one_line(self.measure(*arguments, status=2))
            self.assertIn(f"node {node}: a coordinate is not finite", text)

    def test_a_surface_for_scripts(self):
        report = self.report(self.write("in.obj", hat()))
        self.assertEqual((report["kind"], report["nodes"], report["faces"]), ("surface", 49, 48))
        self.assertEqual(set(report["figures"]), set(report["definitions"]))
        self.assertEqual(report["figures"]["flipped_faces"], 0)
        self.assertIsInstance(report["figures"]["self_intersections"], int)
        self.assertNotIn("normal_error", report["figures"])
        self.assertEqual(report["definitions"]["greatest_turn"]["unit"], "°")
        for key, value in report["figures"].items():
            self.assertTrue(math.isfinite(value), key)

    def test_the_same_bits_for_every_number_of_threads(self):
        path = self.write("in.obj", grid(40))
        self.assertEqual(self.report(path, "--threads", "1")["figures"], self.report(path, "--threads", "3")["figures"])

    def test_noise_is_estimated(self):
        exact = self.report(self.write("exact.obj", support.sphere(16)))["figures"]
        noisy = self.report(self.write("noisy.obj", support.sphere(16, noise=0.02)))
        self.assertLess(exact["noise_in_edges"], 0.02)
        self.assertGreater(noisy["figures"]["noise"], 5 * exact["noise"])
        self.assertEqual(noisy["definitions"]["noise"]["unit"], "units")

    def test_noise_in_the_coordinates_that_are_to_move_is_what_a_curve_takes(self):
        draw = random.Random(3)
        rows = [(k, 40 * math.sin(k / 9) + draw.gauss(0, 0.5)) for k in range(150)]
        path = self.write("in.csv", "dist,ele\n" + "".join(f"{x!r},{y!r}\n" for x, y in rows))
        columns = ("--columns", "dist,ele")
        reports = {}
        for move in ((), ("--move", "ele")):
            found = self.report(path, *columns, *move)
            reports[move] = found["figures"]
            self.assertEqual(found.get("moving"), ["ele"] if move else None)
            run("curve", path, "-o", self.folder / "out.csv", *columns, *move, "--within", "auto", "--report", self.folder / "r.json")
            points = self.read_json("r.json")["points"]
            self.assertEqual((points["estimated_noise"], points["within"]), (found["figures"]["noise"], found["figures"]["within_auto"]))
        self.assertAlmostEqual(reports["--move", "ele"]["noise"], 0.5, delta=0.1)
        self.assertLess(reports[()]["noise"], 0.35, "across a steep way")
        self.assertEqual(self.report(path, *columns, "--move", "y")["figures"], reports["--move", "ele"])
        self.assertEqual(self.report(path, *columns, "--move", "ele", "--compare", path)["compared_with"]["figures"], reports["--move", "ele"])
        self.assertIn("'high' is no coordinate of this curve", self.assert_one_line(self.measure(path, *columns, "--move", "high", status=1)))
        for shape, why in ((path, "these are all coordinates of the curve"), (self.write("in.obj", hat()), "it is for curves")):
            told = self.measure(shape, *(columns if shape == path else ()), "--move", "xy").stderr.decode()
            self.assertIn(f"--move has no effect here: {why}", told)

    def test_a_curve_by_its_extension(self):
        path = self.write("circle.csv", circle())
        report = self.report(path, "--closed")
        self.assertEqual((report["kind"], report["nodes"], report["chains"]), ("curve", 40, 1))
        self.assertAlmostEqual(report["figures"]["bending_energy"], 4 * math.pi ** 2, delta=0.2)
        self.assertLess(report["figures"]["curvature_variation"], 1e-12)
        self.assertEqual((report["figures"]["curvature_extrema"], report["figures"]["inflections"]), (0, 0))
        self.assertLess(self.report(path)["figures"]["length"], report["figures"]["length"])

    def test_columns_and_ends_that_meet(self):
        plain = self.report(self.write("circle.csv", circle()))["figures"]
        numbered = self.write("numbered.csv", "n,p,q\n" + "".join(f"{k},{line}\n" for k, line in enumerate(circle().splitlines())))
        self.assertIn("choose columns, such as 2,3 (--columns)", self.assert_one_line(self.measure(numbered, status=2)))
        self.assertEqual(self.report(numbered, "--columns", "p,q")["figures"], plain)
        self.assertEqual(self.report(numbered, "--columns", "2,3", "--compare", numbered)["distance"]["nodes"]["greatest"], 0)
        self.assert_one_line(self.measure(self.write("in.obj", hat()), "--columns", "1,2", status=1))
        ring = self.write("ring.csv", circle() + circle().splitlines()[0] + "\n")
        self.assertIn("note: node 40 is where node 0 is", self.measure(ring).stdout.decode())
        self.assertNotIn("note", self.measure(ring, "--closed").stdout.decode())

    def test_obj_is_a_curve_where_it_has_lines_and_no_faces(self):
        text = "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 3 1 0\nl 1 2 3 4\n"
        path = self.write("line.obj", text)
        self.assertEqual(self.report(path)["kind"], "curve")
        self.assertEqual(self.report("-", "--curve", stdin=text.encode())["kind"], "curve")
        both = self.write("both.obj", text + "f 1 2 3\n")
        self.assertEqual(self.report(both)["kind"], "surface")
        self.assertEqual(self.report(both, "--curve")["kind"], "curve")
        self.assertIn("--curve", self.measure("-", stdin=text.encode(), status=2).stderr.decode())

    def test_standard_input_and_output(self):
        result = self.measure("-", "--report", "-", stdin=hat().encode())
        self.assertEqual(json.loads(result.stdout)["nodes"], 49)
        self.assertIn("bending energy", result.stderr.decode())
        result = self.measure("-", "--format", "csv", stdin=circle().encode())
        self.assertIn("inflections", result.stdout.decode())

    def test_compares_two_shapes(self):
        before = self.write("before.obj", grid(20))
        moved = "\n".join(line if not line.startswith("v ") else
                          "v {} {} {}".format(*line.split()[1:3], float(line.split()[3]) + 0.25) for line in grid(20).splitlines())
        after = self.write("after.obj", moved + "\n")
        report = self.report(after, "--compare", before)
        self.assertAlmostEqual(report["distance"]["nodes"]["greatest"], 0.25)
        self.assertAlmostEqual(report["distance"]["nodes"]["rms"], 0.25)
        self.assertLess(report["distance"]["to_other"]["rms"], 0.25)
        self.assertEqual(report["compared_with"]["nodes"], 441)
        self.assertIn("bending_energy", report["compared_with"]["figures"])
        other = self.write("other.obj", grid(13))
        report = self.report(after, "--compare", other)
        self.assertIsNone(report["distance"]["nodes"])
        self.assertGreater(report["distance"]["from_other"]["rms"], 0.1)
        text = self.measure(after, "--compare", before).stdout.decode()
        self.assertIn("after.obj", text.splitlines()[0])
        self.assertIn("before.obj", text.splitlines()[0])
        self.assertIn("node by node", text)

    def test_kinds_that_do_not_go_together(self):
        curve = self.write("circle.csv", circle())
        surface = self.write("hat.obj", hat())
        for first, second in ((surface, curve), (curve, surface)):
            self.assert_one_line(self.measure(first, "--compare", second, status=2))

    def test_how_well_given_normals_are_met(self):
        before = self.write("before.obj", hat())
        report = self.report(before, "--fix-normals", "boundary")
        self.assertLess(report["figures"]["normal_error"], 1e-6)
        after = self.folder / "after.obj"
        self.assertIn(run("fair", before, "-o", after, "--fix-normals", "boundary").returncode, (0, 3))
        report = self.report(after, "--compare", before, "--fix-normals", "boundary")
        self.assertGreater(report["figures"]["normal_error"], 1e-6)
        self.write("rules.json", json.dumps({"rules": [{"nodes": [0], "normal": [1, 0, 0]}]}))
        report = self.report(before, "--constraints", self.folder / "rules.json")
        self.assertAlmostEqual(report["figures"]["normal_error"], 90, delta=1)

    def test_bad_input(self):
        self.assert_one_line(self.measure(self.folder / "none.obj", status=2))
        self.assert_one_line(self.measure(self.write("bad.obj", "v 0 0\n"), status=2))
        self.assert_one_line(self.measure(status=1))
        path = self.write("in.obj", hat())
        self.assert_one_line(self.measure(path, "--format", "svg", status=1))
        self.measure(path, "--report", self.folder / "no" / "report.json", status=2)

    def test_colours_only_where_they_are_wanted(self):
        path = self.write("in.obj", hat())
        self.assertIn(b"\x1b[1m", self.measure(path, "--color", "always").stdout)
        self.assertNotIn(b"\x1b", self.measure(path, environment={"NO_COLOR": "1"}).stdout)

    def test_help(self):
        text = run("measure", "--help").stdout.decode()
        for option in ("--compare", "--constraints", "--report", "--curve", "--closed", "--format", "Example", "Exit status"):
            self.assertIn(option, text)
        self.assertIn("measure", run("--help").stdout.decode())


if __name__ == "__main__":
    support.unittest.main()
