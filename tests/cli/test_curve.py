"""What `vspring curve` does."""
import cmath
import json
import math
import random

from polylines import distances, places_on
from support import Case, run


def arc(count, angle=2.0, noise=0.0, seed=1):
    """Points of a unit circle, the inner ones disturbed, as (x, y)."""
    generator = random.Random(seed)
    points = [(math.cos(angle * k / (count - 1)), math.sin(angle * k / (count - 1))) for k in range(count)]
    return [(x + noise * generator.uniform(-1, 1) * (0 < k < count - 1), y + noise * generator.uniform(-1, 1) * (0 < k < count - 1))
            for k, (x, y) in enumerate(points)]


def csv(points):
    return "".join(",".join(repr(v) for v in point) + "\n" for point in points)


def read(path):
    """Rows of numbers; a header is passed over."""
    lines = [line for line in path.read_text().splitlines() if line.strip()]
    return [tuple(float(v) for v in line.split(",")) for line in lines[1 if lines[0][0].isalpha() else 0:]]


class Curve(Case):
    def curve(self, text, *options, name="in.csv", output="out.csv", status=0):
        result = run("curve", self.write(name, text), "-o", self.folder / output, *options)
        self.assertEqual(result.returncode, status, result.stderr.decode())
        return result

    def test_a_coordinate_that_is_no_number(self):
        rows = csv([(k / 10, math.sin(k / 3)) if k != 7 else (0.7, math.nan) for k in range(30)])
        for options in ([], ["--within", "0.1"], ["--noise", "0.1"], ["--sharp", "40"], ["--resample", "20"], ["--order"]):
            with self.subTest(options):
                self.assertIn("node 7: ", self.assert_one_line(self.curve(rows, *options, status=2)))

    def test_noise_is_found_and_taken_off(self):
        generator = random.Random(9)
        rows = [(k / 20 + generator.gauss(0, 0.03), math.sin(k / 20) + generator.gauss(0, 0.03)) for k in range(200)]
        text = csv(rows)
        run("measure", self.write("in.csv", text), "--report", self.folder / "m.json")
        figures = self.read_json("m.json")["figures"]
        reports = {}
        for option in ("--noise", "--rms", "--within"):
            self.curve(text, option, "auto", "--report", self.folder / "r.json", output=f"out{option}.csv")
            reports[option] = self.read_json("r.json")["points"]
            self.assertEqual(reports[option]["estimated_noise"], figures["noise"])
        self.assertAlmostEqual(figures["noise"], 0.03, delta=0.006)
        self.assertEqual(reports["--noise"]["noise"], figures["noise"])
        self.assertEqual(reports["--within"]["within"], figures["within_auto"])
        # A root mean square by the noise is what the noise leaves.
        self.assertEqual((self.folder / "out--rms.csv").read_bytes(), (self.folder / "out--noise.csv").read_bytes())
        self.assertAlmostEqual(reports["--noise"]["distance"]["after"]["rms"], reports["--noise"]["noise_leaves"], delta=0.001)
        off = [y - math.sin(x) for x, y in read(self.folder / "out--noise.csv")]
        self.assertLess(math.sqrt(sum(y * y for y in off) / len(off)), 0.013)
        self.assertIn("noise leaves", self.curve(text, "--noise", "0.03").stdout.decode())
        self.assertIn(b"only one of", self.curve(text, "--rms", "1", "--noise", "1", status=1).stderr)

    def test_chains_at_one_place_stay_and_do_not_count(self):
        rows = csv([(k, 0.1 * (k % 2)) for k in range(8)])
        for lone in ("90,90\n", "90,90\n90,90\n"):
            for options in ((), ("--fix", "none"), ("--fix", "none", "--resample", "30"), ("--fix", "none", "--sharp", "40"),
                            ("--fix", "none", "--outliers", "0.3")):
                said = self.curve(f"{rows}\n{lone}", "--within", "1", "--report", self.folder / "r.json", *options)
                self.assertIn(b"all nodes of the chain at node 8 lie at one place", said.stderr)
                self.assertTrue((self.folder / "out.csv").read_text().endswith("\n\n" + lone))
                report = self.read_json("r.json")
                self.assertIn("chain-at-one-place", report["warning_codes"])
                self.assertEqual(report["points"]["count"], 8)
                self.assertLess(report["points"]["distance"]["after"]["greatest"], 0.2)
        self.curve("1,2\n" * 6, "--within", "0.2", "--fix", "none", "--outliers", "0.3")
        self.assertEqual((self.folder / "out.csv").read_text(), "1,2\n" * 6)
        self.curve(f"{rows}\n90,90\n", "--within", "1", "--fix", "none", "--resample", "30")
        self.assertEqual(len(read(self.folder / "out.csv")), 30)

    def test_free_ends_of_heights_go_on_as_the_curve_does(self):
        generator = random.Random(2)
        rows = [(k, 0.5 * k + generator.gauss(0, 2)) for k in range(100)]
        self.curve(csv(rows), "--noise", "auto", "--move", "y", "--fix", "none")
        heights = [y for _, y in read(self.folder / "out.csv")]
        for k in (0, 1, 2, 3, 95, 96, 97, 98):
            self.assertAlmostEqual(heights[k + 1] - heights[k], 0.5, delta=0.15)

    def test_a_tangent_against_the_curve_is_told(self):
        rows = csv([(k, 3 * math.sin(k / 8)) for k in range(40)])
        for node in (0, 20, 39):
            for sense, status in ((1, 0), (-1, 3)):
                tangent = [sense * 1.0, sense * 0.375 * math.cos(node / 8)]
                rules = self.write("rules.json", json.dumps({"rules": [{"nodes": [node], "tangent": tangent}]}))
                said = self.curve(rows, "--within", "0.1", "--constraints", rules, "--report", self.folder / "r.json", status=status)
                self.assertEqual("against-tangent" in self.read_json("r.json")["warning_codes"], sense < 0)
                self.assertEqual(f"given at node {node};" in said.stderr.decode(), sense < 0)

    def test_within_auto_allows_for_what_lies_behind_a_held_end(self):
        generator = random.Random(4)
        rows = [(k / 10 + generator.gauss(0, 0.02), 0.3 * math.sin(k / 10) + generator.gauss(0, 0.02)) for k in range(80)]
        rows[0] = (rows[1][0] + 0.07, rows[1][1])
        for options in ([], ["--spacing", "0.1"]):
            done = self.curve(csv(rows), "--within", "auto", "--report", self.folder / "r.json", *options)
            report = self.read_json("r.json")
            self.assertAlmostEqual(report["points"]["within"], 0.07, delta=0.001)
            self.assertLessEqual(report["points"]["distance"]["after"]["greatest"], report["points"]["within"])
            self.assertRegex(done.stderr.decode(), r"no curve is within 0\.0\d+, as the noise says: row 1 is 0\.07 away from the node that is held there; auto allows for that; --fix none")
            self.assertEqual(read(self.folder / "out.csv")[0], rows[0])
        run("measure", self.folder / "in.csv", "--report", self.folder / "m.json")
        told = self.read_json("m.json")["figures"]["within_auto"]
        self.assertLess(told, 0.1)
        self.curve(csv(rows), "--within", repr(told), status=3)
        self.curve(csv(rows), "--within", "auto", "--fix", "none", "--report", self.folder / "r.json")
        self.assertEqual(self.read_json("r.json")["points"]["within"], told)
        # Not for what long edges cut off, nor for rows that are far from where a rule puts an end.
        rows = [(x, y + 0.7 * math.sin(k / 10)) for k, (x, y) in enumerate(rows)]
        rows[0] = (0, 0)
        rule = self.write("rule.json", json.dumps({"rules": [{"nodes": [0], "position": [0.12, 0.16, 0]}]}))
        for options in (["--spacing", "1"], ["--constraints", rule]):
            done = self.curve(csv(rows), "--within", "auto", "--report", self.folder / "r.json", *options, status=3)
            self.assertLess(self.read_json("r.json")["points"]["within"], 0.1)
            self.assertNotIn("--within auto", done.stderr.decode())

    def test_chords_of_new_nodes_stay_near_the_polyline_of_the_rows(self):
        for seed in (8, 16, 49):
            generator = random.Random(seed)
            noise = lambda: generator.uniform(-1, 1)
            rows = [(2.2 * k + noise(), noise()) for k in range(40)]
            rows += [(85.8 + 2.2 * k * math.cos(math.radians(150)) + noise(), 2.2 * k * math.sin(math.radians(150)) + noise()) for k in range(1, 40)]
            self.curve(csv(rows), "--within", "1.5", "--resample", "45")
            nodes = read(self.folder / "out.csv")
            self.assertLessEqual(max(distances(places_on(nodes, 16), rows)), 1.5 * 1.0001)

    def test_only_the_columns_that_are_named_move(self):
        generator = random.Random(3)
        rows = [(f"{1.5 * k:.2f}", f"{10 * math.sin(k / 20) + generator.uniform(-0.2, 0.2):.3f}", f"p{k}") for k in range(100)]
        text = "dist_m,ele_m,note\n" + "".join(",".join(row) + "\n" for row in rows)
        columns = ("--columns", "dist_m,ele_m")
        said = self.curve(text, *columns, "--move", "ele_m", "--within", "0.25", "--report", self.folder / "r.json").stdout.decode()
        self.assertIn("moved            ele_m alone", said)
        after = [tuple(line.split(",")) for line in (self.folder / "out.csv").read_text().splitlines()[1:]]
        self.assertEqual([(a[0], a[2]) for a in after], [(a[0], a[2]) for a in rows])
        moves = [abs(float(a[1]) - float(b[1])) for a, b in zip(after, rows)]
        self.assertLessEqual(max(moves), 0.25)
        self.assertGreater(max(moves), 0.2)
        report = self.read_json("r.json")
        self.assertEqual(report["points"]["moving"], ["ele_m"])
        self.assertAlmostEqual(report["points"]["distance"]["after"]["greatest"], max(moves), 12)
        figures = report["fairness"]
        self.assertLess(figures["after"]["rms_turn"], figures["before"]["rms_turn"] / 5)
        self.curve(text, *columns, "--move", "y", "--within", "0.25", output="letter.csv")
        self.assertEqual((self.folder / "letter.csv").read_bytes(), (self.folder / "out.csv").read_bytes())

    def test_columns_that_cannot_move_are_named(self):
        text = "dist,ele\n" + csv((k, math.sin(k)) for k in range(20))
        columns = ("--columns", "dist,ele")
        for options, words in (
                (("--move", "height", "--within", "1"), "'height' is no coordinate of this curve; it has x or 'dist', y or 'ele'"),
                (("--move", "ele"), "--move: how near to the rows is the curve to stay? give --within, --rms, --noise or --smoothing-length"),
                (("--move", "ele", "--within", "1", "--method", "sweep"), "by the method equilibrium only"),
                (("--move", "ele", "--weight", "1", "--method", "multigrid"), "by the method equilibrium only")):
            with self.subTest(options):
                self.assertIn(words, self.curve(text, *columns, *options, status=1).stderr.decode())
        said = self.curve(text, *columns, "--move", "dist,ele", "--within", "0.1").stderr.decode()
        self.assertIn("--move has no effect here: these are all coordinates of the curve", said)
        said = self.curve(text, *columns, "--move", "ele", "--within", "0.1", "--distribution", "even").stderr.decode()
        self.assertIn("--distribution has no effect here", said)
        shuffled = "x,y\n" + csv((k * 7 % 20, math.sin(k)) for k in range(20))
        self.assertIn("put the nodes in order (--order)",
                      self.curve(shuffled, "--move", "y", "--within", "0.1", status=2).stderr.decode())

    def end_tangents(self, count, angle):
        rules = {"rules": [{"nodes": [0, count - 1], "tangent": [[0, 1], [-math.sin(angle), math.cos(angle)]]}]}
        return self.write("held.json", json.dumps(rules))

    def test_a_noisy_arc_comes_out_round(self):
        for count in (10, 100, 1000):
            for distribution in ("even", "keep"):
                with self.subTest(count=count, distribution=distribution):
                    self.curve(csv(arc(count, noise=0.05)), "--constraints", self.end_tangents(count, 2.0), "--tolerance", "1e-13",
                               "--distribution", distribution)
                    points = read(self.folder / "out.csv")
                    self.assertEqual(len(points), count)
                    self.assertLess(max(abs(math.hypot(x, y) - 1) for x, y in points), 1e-12)

    def test_a_noisy_line_comes_out_straight(self):
        generator = random.Random(5)
        points = [(k / 50, 0.1 * generator.uniform(-1, 1) * (0 < k < 50)) for k in range(51)]
        self.curve(csv(points), "--tolerance", "1e-13")
        self.assertLess(max(abs(y) for x, y in read(self.folder / "out.csv")), 1e-12)

    def test_tangents_as_in_the_input(self):
        self.curve(csv(arc(40)), "--fix-normals", "boundary", "--tolerance", "1e-13", "--report", self.folder / "r.json")
        self.assertLess(max(abs(math.hypot(x, y) - 1) for x, y in read(self.folder / "out.csv")), 1e-12)
        self.assertEqual(self.read_json("r.json")["fixed_tangents"], 2)

    def test_report(self):
        self.curve(csv(arc(500, noise=0.05)), "--report", self.folder / "r.json", "--constraints", self.end_tangents(500, 2.0))
        report = self.read_json("r.json")
        self.assertEqual((report["outcome"], report["method"], report["nodes"]), ("converged", "equilibrium", 500))
        self.assertLess(report["expected_error"], 1e-5)
        self.assertGreater(len(report["levels"]), 1)
        self.assertEqual(sum(level["iterations"] for level in report["levels"]), report["iterations"])
        self.assertEqual(report["levels"][-1]["moving_nodes"], 498)

    def test_keeps_what_the_file_carried(self):
        text = "# outline\nname,x,y\n" + "".join(f"p{k},{x},{y}\n" for k, (x, y) in enumerate(arc(20, noise=0.02)))
        self.curve(text)
        before, after = text.splitlines(), (self.folder / "out.csv").read_text().splitlines()
        self.assertEqual(len(before), len(after))
        self.assertEqual(before[:3] + before[-1:], after[:3] + after[-1:])
        self.assertTrue(all(a.split(",")[0] == b.split(",")[0] for a, b in zip(before, after)))

    def test_several_curves_with_segments_in_any_order(self):
        points = arc(12, noise=0.05)
        lines = [f"v {x} {y} 0" for x, y in points] + [f"v {x} {y} 3" for x, y in points]
        segments = [(k, k + 1) for k in range(1, 12)] + [(k + 1, k) for k in range(13, 24)]
        random.Random(3).shuffle(segments)
        text = "\n".join(lines + [f"l {a} {b}" for a, b in segments]) + "\n"
        self.curve(text, name="in.obj", output="out.obj", status=0)
        after = (self.folder / "out.obj").read_text().splitlines()
        self.assertEqual(after[24:], text.splitlines()[24:])
        heights = [float(line.split()[3]) for line in after[:24]]
        self.assertLess(max(map(abs, heights[:12])), 1e-6)
        self.assertLess(max(abs(z - 3) for z in heights[12:]), 1e-6)

    def test_closed(self):
        points = arc(24, angle=2 * math.pi * 23 / 24, noise=0.0)
        points = [(x * 1.2, y) for x, y in points]
        fixed = self.write("fixed.json", json.dumps({"rules": [{"nodes": list(range(0, 24, 3)), "position": "fixed"}]}))
        self.curve(csv(points), "--closed", "--constraints", fixed, "--fix", "none")
        once = read(self.folder / "out.csv")
        # The first node again at the end is one with the first.
        self.curve(csv(points + points[:1]), "--closed", "--constraints", fixed, "--fix", "none")
        again = read(self.folder / "out.csv")
        self.assertEqual(again[:-1], once)
        self.assertEqual(again[-1], again[0])
        refused = run("curve", self.folder / "in.csv", "-o", self.folder / "no.csv", "--closed")
        self.assertEqual(refused.returncode, 2)

    def test_a_curve_that_ends_where_it_begins_says_how_it_is_closed(self):
        points = [(1.2 * math.cos(k * math.pi / 12), math.sin(k * math.pi / 12)) for k in range(24)]
        rules = {"rules": [{"nodes": [6, 12, 18], "position": "fixed"}]}
        fixed = self.write("fixed.json", json.dumps(rules))
        said = self.curve(csv(points + points[:1]), "--constraints", fixed).stdout.decode()
        self.assertIn("note: node 24 is where node 0 is, and the curve stays open there", said)
        self.assertIn("--closed", said)
        after = read(self.folder / "out.csv")
        self.assertEqual((after[0], after[-1]), (points[0], points[0]))
        for text, options in ((csv(points), []), (csv(points + points[:1]), ["--closed"]), (csv(points + points[:1]), ["--quiet"])):
            self.assertNotIn("note", self.curve(text, "--constraints", fixed, *options).stdout.decode())
        # A rule for the last row holds both.
        rules["rules"].append({"nodes": [24], "position": [1.3, 0]})
        fixed = self.write("fixed.json", json.dumps(rules))
        for name in ("xyz", "dat", "csv"):
            text = csv(points + points[:1]).replace(",", " " if name != "csv" else ",")
            self.curve(text, "--closed", "--constraints", fixed, name=f"in.{name}", output=f"out.{name}")
            rows = [tuple(map(float, line.replace(",", " ").split())) for line in (self.folder / f"out.{name}").read_text().splitlines()]
            self.assertEqual((len(rows), rows[0], rows[-1]), (25, (1.3, 0), (1.3, 0)))
        rules["rules"].append({"nodes": [0], "position": "fixed"})
        result = self.curve(csv(points + points[:1]), "--closed", "--constraints", self.write("fixed.json", json.dumps(rules)), status=2)
        self.assertIn("nodes 0 and 24 are one", self.assert_one_line(result))

    def test_what_a_curve_that_ends_where_it_begins_is_taken_for(self):
        draw = random.Random(4)
        ring = [(5e5 + 300 * math.cos(k * math.pi / 100) + draw.gauss(0, 2), 4e6 + 200 * math.sin(k * math.pi / 100) + draw.gauss(0, 2))
                for k in range(200)]
        said = self.curve(csv(ring + ring[:1]), "--within", "6").stdout.decode()
        self.assertIn("note: node 200 is where node 0 is, and the curve stays open there; --closed makes the two one node", said)
        leaf = [(abs(1 - k / 30), (0.3 if k < 30 else -0.3) * math.sin(math.pi * abs(1 - k / 30))) for k in range(60)]
        said = self.curve(csv(leaf + leaf[:1]), "--within", "0.01").stdout.decode()
        self.assertIn("note: node 60 is where node 0 is, and the curve stays open there, with its corner; --closed would round", said)

    def test_a_blunt_trailing_edge_keeps_its_corners(self):
        side = [(k / 20, 0.01 * k / 20 + 0.3 * math.sqrt(k / 20) * (1 - k / 20)) for k in range(21)]
        outline = [(x, y) for x, y in side[::-1]] + [(x, -y) for x, y in side[1:]]
        table = lambda rows: "blunt\n" + "".join(f"{x!r} {y!r}\n" for x, y in rows)
        names = {"name": "in.dat", "output": "out.dat"}
        self.assertNotIn(b"note", self.curve(table(outline), "--within", "0.001", **names).stdout)
        said = self.curve(table(outline + outline[:1]), "--within", "0.001", **names).stdout.decode()
        self.assertIn("note: node 41 is where node 0 is, and node 40 beside them is a corner, as of a blunt trailing edge, which is", said)
        self.assertNotIn("--closed", said)
        # The base is a chain of its own.
        parted = table(outline) + "\n" + table([outline[-1], outline[0]]).split("\n", 1)[1]
        self.assertNotIn(b"note", self.curve(parted, "--within", "0.001", **names).stdout)
        rows, before = (self.folder / "out.dat").read_text().splitlines(), parted.splitlines()
        self.assertEqual((len(rows), rows[1], rows[41:]), (45, before[1], before[41:]))
        twice = self.curve(table(outline[:1] + outline), "--within", "0.001", **names)
        self.assertIn("in.dat:3: this row is at the same place as the one above; leave it out", twice.stderr.decode())

    def test_columns_by_name_and_by_choice(self):
        points = arc(20, noise=0.02)
        text = "index,X [mm],Y [mm]\n" + "".join(f"{k},{x!r},{y!r}\n" for k, (x, y) in enumerate(points))
        self.assertNotIn(b"column", self.curve(text).stderr)
        named = (self.folder / "out.csv").read_text()
        rows = [line.split(",") for line in named.splitlines()]
        self.assertEqual(rows[0], ["index", "X [mm]", "Y [mm]"])
        self.assertEqual([row[0] for row in rows[1:]], [str(k) for k in range(20)])
        self.assertEqual(tuple(map(float, rows[-1][1:])), points[-1])
        self.assertNotEqual(named, text)
        other = text.replace("X [mm],Y [mm]", "a,b")
        self.assertIn("choose columns, such as 2,3 (--columns)", self.assert_one_line(self.curve(other, status=2)))
        for columns in ("2,3", "a,B", "a, 3"):
            self.curve(other, "--columns", columns)
            self.assertEqual((self.folder / "out.csv").read_text(), named.replace("X [mm],Y [mm]", "a,b"))
        self.assertIn("column 1 counts rows and is taken for x", self.curve(text.split("\n", 1)[1]).stderr.decode())
        for columns, status in (("2", 1), ("2,", 1), ("1,2,3,1", 1), ("2,2", 1), ("0,1", 1), ("2,7", 2), ("a,c", 2)):
            self.assert_one_line(self.curve(other, "--columns", columns, status=status))
        self.assert_one_line(self.curve("v 0 0 0\nv 1 0 0\nl 1 2\n", "--columns", "1,2", name="in.obj", status=1))

    def test_decimal_commas_stay(self):
        points = arc(20, noise=0.02)
        text = "no;x;y\r\n" + "".join(f"{k};{x!r};{y!r}\r\n".replace(".", ",") for k, (x, y) in enumerate(points))
        self.curve(text)
        commas = (self.folder / "out.csv").read_bytes().decode()
        self.curve(text.replace(",", "."))
        self.assertEqual(commas.replace(",", "."), (self.folder / "out.csv").read_bytes().decode())
        self.assertEqual(commas.split("\r\n")[:2] + commas.split("\r\n")[-2:], text.split("\r\n")[:2] + text.split("\r\n")[-2:])

    def test_rows_in_no_order(self):
        points = arc(120, noise=0.004)
        rows = [f"{k},{x!r},{y!r}" for k, (x, y) in enumerate(points)]
        self.curve("id,x,y\n" + "\n".join(rows) + "\n", "--within", "0.01")
        in_order = (self.folder / "out.csv").read_text()
        random.Random(2).shuffle(rows)
        shuffled = "id,x,y\n" + "\n".join(rows) + "\n"
        said = self.curve(shuffled, "--within", "0.01", "--order", "--report", self.folder / "r.json").stdout.decode()
        changed = self.read_json("r.json")["reordered_nodes"]
        self.assertGreater(changed, 100)
        self.assertIn(f"note: {changed} of 120 rows changed place, and all come in order along the curve", said)
        after = (self.folder / "out.csv").read_text().splitlines()
        numbers = [int(line.split(",")[0]) for line in after[1:]]
        self.assertIn(numbers, (list(range(120)), list(range(119, -1, -1))))
        # The ends are those of the curve, not of the table, and stay.
        self.assertEqual({after[1], after[-1]}, {f"{k},{points[k][0]!r},{points[k][1]!r}" for k in (0, 119)})
        distances = [math.dist(a[1:], b[1:]) for a, b in zip(*(sorted(tuple(map(float, line.split(","))) for line in text[1:])
                                                               for text in (in_order.splitlines(), after)))]
        self.assertLess(max(distances), 1e-3)
        # Rules count the rows of the input.
        held = rows.index(next(row for row in rows if row.startswith("60,")))
        rules = self.write("held.json", json.dumps({"rules": [{"nodes": [held], "position": "fixed"}]}))
        self.curve(shuffled, "--order", "--constraints", rules)
        self.assertIn(rows[held], (self.folder / "out.csv").read_text().splitlines())
        self.curve(shuffled, "--order", "--within", "0.01", "--resample", "40")
        self.assertEqual(len(read(self.folder / "out.csv")), 40)
        line = self.assert_one_line(self.curve("v 0 0 0\nv 1 0 0\nl 1 2\n", "--order", name="in.obj", output="out.obj", status=1))
        self.assertIn("leave the order along the curve out (--order)", line)

    def test_rows_of_a_closed_curve_in_no_order(self):
        points = [(1.2 * math.cos(k * math.pi / 30), math.sin(k * math.pi / 30)) for k in range(60)]
        rows = [f"{k},{x!r},{y!r}" for k, (x, y) in enumerate(points)]
        random.Random(4).shuffle(rows)
        self.curve("id,x,y\n" + "\n".join(rows) + "\n", "--order", "--closed", "--within", "0.01")
        numbers = [int(line.split(",")[0]) for line in (self.folder / "out.csv").read_text().splitlines()[1:]]
        steps = {(b - a) % 60 for a, b in zip(numbers, numbers[1:] + numbers[:1])}
        self.assertIn(steps, ({1}, {59}))
        self.assertEqual(numbers[0], int(rows[0].split(",")[0]))

    def test_resample_and_spacing(self):
        points = [(math.cos(2 * (k / 30) ** 2), math.sin(2 * (k / 30) ** 2)) for k in range(31)]
        rules = self.write("held.json", json.dumps({"rules": [{"nodes": [0, 30], "tangent": "fixed"}]}))
        self.curve(csv(points), "--resample", "101", "--constraints", rules, "--tolerance", "1e-12", "--distribution", "even")
        after = read(self.folder / "out.csv")
        self.assertEqual(len(after), 101)
        self.assertEqual((after[0], after[-1]), (points[0], points[-1]))
        edges = [math.dist(a, b) for a, b in zip(after, after[1:])]
        self.assertLess(max(edges) / min(edges), 1.0001)
        self.assertLess(max(abs(math.hypot(x, y) - 1) for x, y in after), 1e-10)
        self.curve(csv(points), "--spacing", "0.05", "--constraints", rules)
        self.assertEqual(len(read(self.folder / "out.csv")), 41)

    def test_says_what_new_nodes_leave_behind(self):
        log = "".join(f"{k},{k},{math.sin(k / 5)!r},{100 + k}\n" for k in range(30))
        done = self.curve("time,x,y,ele\n" + log, "--spacing", "2")
        self.assertEqual(done.stderr.decode().count("written without"), 1)
        self.assertIn("written without other columns", done.stderr.decode())
        self.assertIn("written without names of columns", self.curve("time,X [m],Y [m],ele\n" + log, "--spacing", "2").stderr.decode())
        rows = csv([(k, math.sin(k / 5)) for k in range(30)])
        self.assertEqual(self.curve("x,y\n" + rows, "--resample", "20").stderr, b"")
        self.assertEqual(self.curve("wing\n" + rows.replace(",", " "), "--resample", "20", name="in.dat", output="out.dat").stderr, b"")
        self.assertTrue((self.folder / "out.dat").read_text().startswith("wing\n"))
        points = "".join(f'<trkpt lat="50.{k:03}" lon="7.{k * k:03}"><ele>9</ele><time>t</time></trkpt>' for k in range(20))
        track = f"<gpx><trk><name>way</name><trkseg>{points}</trkseg></trk></gpx>"
        said = self.curve(track, "--resample", "15", name="in.gpx", output="out.gpx").stderr.decode()
        for lost in ("elevations", "times", "names"):
            self.assertIn(f"written without {lost}\n", said)

    def test_curvature_beside_a_region(self):
        waves = [(0.05 * k, math.sin(0.05 * k) + (0.1 if 50 < k < 90 else 0)) for k in range(140)]
        args = ("--region", "box:2.2,-2,-1,4.8,2,1", "--report", self.folder / "report.json")
        self.curve(csv(waves), *args)
        tangent = read(self.folder / "out.csv")
        self.assertEqual(self.read_json("report.json")["continuity"], "tangent")
        self.curve(csv(waves), *args, "--continuity", "tangent", output="said.csv")
        self.assertEqual(read(self.folder / "said.csv"), tangent)
        done = self.curve(csv(waves), *args, "--continuity", "curvature")
        self.assertEqual(done.stderr, b"")
        report = self.read_json("report.json")
        self.assertEqual((report["continuity"], report["levels"][-1]["strategy"]), ("curvature", "curvature at the ends"))
        self.assertLess(report["curvature_jump"]["after"], 0.1 * report["curvature_jump"]["tangent"])
        off = lambda rows: max(abs(y - math.sin(x)) for x, y in rows)
        self.assertLess(off(read(self.folder / "out.csv")), 0.7 * off(tangent))

    def test_curvature_without_a_region(self):
        # Nothing but the ends is held, with tangents that are not those of the input.
        rules = {"rules": [{"nodes": [0], "tangent": [1, 1]}, {"nodes": [20], "tangent": [1, -1]}]}
        self.write("rules.json", json.dumps(rules))
        args = ("--constraints", self.folder / "rules.json", "--report", self.folder / "report.json")
        flat = csv([(k / 20, 0) for k in range(21)])
        done = self.curve(flat, *args, "--continuity", "curvature")
        self.assertIn(b"nothing is held beside it that has a curvature to meet", done.stderr)
        self.assertEqual(self.read_json("report.json")["warning_codes"], ["tangent-only"])
        self.curve(flat, *args, output="tangent.csv")
        self.assertEqual(read(self.folder / "tangent.csv"), read(self.folder / "out.csv"))
        # With those of the input it has its curvature.
        self.curve(csv(arc(41, noise=0.001)), "--fix-normals", "boundary", "--continuity", "curvature", "--report", self.folder / "report.json")
        self.assertEqual(self.read_json("report.json")["continuity"], "curvature")
        refused = self.curve(flat, "--continuity", "curvature", "--within", "0.1", output="none.csv", status=1)
        self.assertIn(b"where no points pull", refused.stderr)

    def test_paper_and_normal_plane(self):
        helix = [(math.cos(t / 8), math.sin(t / 8), t / 40) for t in range(61)]
        helix = [(x, y, z + 0.002 * (k % 2)) for k, (x, y, z) in enumerate(helix)]
        for options in (["--paper"], ["--normal-plane", "principal"], ["--normal-plane", "full"], ["--method", "sweep"]):
            with self.subTest(options=options):
                self.curve(csv(helix), "--fix-normals", "boundary", *options)
                self.assertEqual(len(read(self.folder / "out.csv")), 61)

    def test_paper_bends_a_straight_line_whose_ends_are_tilted(self):
        line = csv([(k / 4, 0) for k in range(13)])
        rules = self.write("tilted.json", json.dumps({"rules": [{"nodes": [0], "position": "fixed", "tangent": [1, 0.4]},
                                                                {"nodes": [12], "position": "fixed", "tangent": [1, -0.4]}]}))
        self.curve(line, "--paper", "--constraints", rules)
        heights = [y for _, y in read(self.folder / "out.csv")]
        self.assertGreater(heights[6], 0.1)
        self.assertEqual(heights[6], max(heights))

    def test_corners_stay_sharp(self):
        noise = random.Random(3)
        sides = [(k, 0) for k in range(40)] + [(40, k) for k in range(30)] + [(40 - k, 30) for k in range(40)] + [(0, 30 - k) for k in range(30)]
        rows = csv([(x + noise.uniform(-0.4, 0.4), y + noise.uniform(-0.4, 0.4)) for x, y in sides])
        report = ("--report", self.folder / "r.json")
        for options in (("--within", "1"), ("--within", "1", "--spacing", "2")):
            done = self.curve(rows, "--closed", "--sharp", "40", *options, *report)
            self.assertIn("corners          4 kept sharp\n", done.stdout.decode())
            self.assertEqual(self.read_json("r.json")["corners"], 4)
            self.assertGreater(self.read_json("r.json")["fairness"]["after"]["greatest_turn"], 80)
        self.assertNotIn("corners", self.curve(rows, "--closed", "--within", "1", *report).stdout.decode())
        self.assertEqual(self.read_json("r.json")["corners"], 0)
        # Without points nodes at corners keep their places, new ones lie between them.
        road = csv([(k, 0.1 * noise.uniform(-1, 1) * (0 < k < 40)) for k in range(41)] + [(40, k) for k in range(1, 31)])
        for options in ((), ("--resample", "36")):
            done = self.curve(road, "--sharp", "60", *options, *report)
            self.assertEqual(self.read_json("r.json")["corners"], 1)
            points = read(self.folder / "out.csv")
            self.assertIn((40, 0), points)
            self.assertLess(max(min(abs(y), abs(x - 40)) for x, y in points), 1e-3)

    def test_corners_are_given_by_rules(self):
        def held(*rules):
            return "--constraints", self.write("held.json", json.dumps({"rules": list(rules)}))

        def directions(corner):
            """Before and after where it turns most about there, in degrees, of the circles through that and the next two places."""
            points = [complex(x, y) for x, y in read(self.folder / "out.csv")]
            if points[0] == points[-1]:
                points.pop()
            count = len(points)
            about = (k for k in range(count) if abs(points[k] - corner) < 2)
            at = max(about, key=lambda k: abs(cmath.phase((points[(k + 1) % count] - points[k]) / (points[k] - points[k - 1]))))
            found = []
            for step in (-1, 1):
                first, second = (points[(at + n * step) % count] - points[at] for n in (1, 2))
                way = step * (first / abs(first) ** 2 - second / abs(second) ** 2)
                found.append(math.degrees(cmath.phase(way)))
            return found

        report = ("--report", self.folder / "r.json")
        both = {"nodes": [40], "tangent_in": [1, -0.2], "tangent_out": [0.2, 1]}
        road = csv([(k, 0) for k in range(41)] + [(40, k) for k in range(1, 31)])
        for options in ((), ("--resample", "150"), ("--spacing", "0.5")):
            with self.subTest(options=options):
                done = self.curve(road, *held(both), *options, *report)
                self.assertIn("corners          1 kept sharp\n", done.stdout.decode())
                self.assertEqual(self.read_json("r.json")["fixed_tangents"], 2)
                self.assertIn((40, 0), read(self.folder / "out.csv"))
                before, after = directions(40)
                self.assertAlmostEqual(before, math.degrees(math.atan2(-0.2, 1)), delta=0.3)
                self.assertAlmostEqual(after, math.degrees(math.atan2(1, 0.2)), delta=0.3)
        # The other side is free to turn, and has nothing to turn for.
        self.curve(road, *held({"nodes": [40], "tangent_out": [0.2, 1]}))
        self.assertAlmostEqual(directions(40)[0], 0, delta=1e-3)
        self.curve(road, *held({"nodes": [40], "corner": True}), *report)
        self.assertEqual(self.read_json("r.json")["corners"], 1)
        self.assertEqual(self.read_json("r.json")["greatest_move"], 0)
        # Drawn to its rows, it moves with them. The last row is the first again, and says how the curve comes back.
        noise = random.Random(3)
        sides = [(k, 0) for k in range(40)] + [(40, k) for k in range(30)] + [(40 - k, 30) for k in range(40)] + [(0, 30 - k) for k in range(30)]
        rows = [(x + noise.uniform(-0.4, 0.4), y + noise.uniform(-0.4, 0.4)) for x, y in sides]
        others = {"nodes": [70, 110], "corner": True}
        ends = ({"nodes": [140], "tangent_in": [0.1, -1]}, {"nodes": [0], "tangent_out": [1, -0.1]})
        for options in ((), ("--spacing", "0.5")):
            with self.subTest(options=options):
                self.curve(csv(rows + rows[:1]), "--closed", "--within", "0.7", *held(both, others, *ends), *options, *report)
                self.assertEqual(self.read_json("r.json")["corners"], 4)
                for corner, angles in ((40, (-11.3, 78.7)), (0, (-84.3, -5.7))):
                    for angle, expected in zip(directions(corner), angles):
                        self.assertAlmostEqual(angle, expected, delta=1.5)
        # What cannot be is named.
        self.write("in.csv", road)
        for rule, said in (({"nodes": [0], "corner": True}, "node 0 cannot be a corner: a chain ends there"),
                           ({"nodes": [40], "corner": True, "normal": [0, 1]}, "node 40 cannot be a corner: its normal"),
                           ({"nodes": [40], "tangent_in": [0, 0]}, "node 40: a tangent of zero has no direction"),
                           ({"nodes": [40], "tangent": [1, 0], "tangent_in": [1, 0]}, "rule 1: node 40: ")):
            with self.subTest(rule=rule):
                result = run("curve", self.folder / "in.csv", "-o", self.folder / "out.csv", *held(rule))
                self.assertEqual(result.returncode, 2)
                self.assertIn(said, result.stderr.decode())

    def test_picture(self):
        self.curve(csv(arc(30, noise=0.05)), "--picture", self.folder / "a.svg")
        self.assertTrue((self.folder / "a.svg").read_text().startswith("<"))
        self.assertEqual((self.folder / "a.svg").read_text().rstrip()[-6:], "</svg>")

    def test_standard_input_and_output(self):
        text = csv(arc(20, noise=0.02))
        self.curve(text, "--fix-normals", "boundary")
        result = run("curve", "-", "-o", "-", "--quiet", "--fix-normals", "boundary", stdin=text.encode())
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertEqual(result.stdout, (self.folder / "out.csv").read_bytes())

    def test_refusals(self):
        points = arc(20)
        path = self.write("in.csv", csv(points))
        out = self.folder / "out.csv"
        for options, status, word in ((["--fix", "none"], 2, "end"), (["--resample", "1"], 1, "too few"),
                                      (["--resample", "10", "--spacing", "1"], 1, "--resample"), (["--paper", "--normal-plane", "full"], 1, "--"),
                                      (["--picture", "a.gif"], 1, ".svg"), (["--method", "multi"], 1, "equilibrium"),
                                      (["--tolerance", "0"], 1, "--tolerance")):
            with self.subTest(options=options):
                result = run("curve", path, "-o", out, *options)
                self.assertEqual(result.returncode, status, result.stderr)
                self.assertIn(word, self.assert_one_line(result))
                self.assertFalse(out.exists())
