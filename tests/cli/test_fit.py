"""What `vspring fit` does."""
import math
import random
import struct

from support import EXAMPLES, OCTAHEDRON, Case, grid, run, run_interrupted, sphere, vertex_lines


def xyz(points):
    return "".join(" ".join(repr(v) for v in point) + "\n" for point in points)


def heights(path):
    return [float(line.split()[3]) for line in vertex_lines(path.read_text())]


class Fit(Case):
    def fit(self, shape, points, *options, output="out.obj", status=0):
        result = run("fit", shape, "--points", points, "-o", self.folder / output, *options)
        self.assertEqual(result.returncode, status, result.stderr.decode())
        return result

    def cloud(self, count=3000, height=lambda x, y: 0.2 * math.sin(math.pi * x) * math.sin(math.pi * y)):
        generator = random.Random(4)
        places = [(generator.random(), generator.random()) for _ in range(count)]
        return [(x, y, height(x, y)) for x, y in places]

    def test_a_flat_surface_goes_to_its_points(self):
        shape = self.write("flat.obj", grid(12, lambda x, y: 0))
        points = self.write("points.xyz", xyz(self.cloud()))
        result = self.fit(shape, points, "--weight", "0.1", "--report", self.folder / "r.json")
        after = heights(self.folder / "out.obj")
        self.assertAlmostEqual(max(after), 0.2, delta=0.01)
        report = self.read_json("r.json")
        self.assertEqual((report["outcome"], report["method"], report["points"]["count"]), ("converged", "equilibrium", 3000))
        distance = report["points"]["distance"]
        self.assertAlmostEqual(distance["before"]["greatest"], 0.2, delta=0.01)
        self.assertLess(distance["after"]["rms"], 0.01)
        self.assertLessEqual(distance["after"]["median"], distance["after"]["percentile90"])
        self.assertLessEqual(distance["after"]["percentile99"], distance["after"]["greatest"])
        self.assertIn("rms distance", result.stdout.decode())
        self.assertIn("rms_turn", report["fairness"]["after"])

    def test_a_boundary_that_is_not_fixed_goes_to_where_the_points_end(self):
        generator = random.Random(2)

        def off():
            return generator.uniform(-0.03, 0.03)

        def outside(path):
            """Of boundary nodes from the unit square, the furthest."""
            rows = [[float(word) for word in line.split()[1:]] for line in vertex_lines(path.read_text())]
            rim = [row for k, row in enumerate(rows) if k // 13 in (0, 12) or k % 13 in (0, 12)]
            return max(max(abs(max(abs(x - 0.5), abs(y - 0.5)) - 0.5), abs(z)) for x, y, z in rim)

        flat = grid(12, lambda x, y: 0).splitlines()
        shape = self.write("noisy.obj", "".join(
            f"v {float(words[1]) + off()} {float(words[2]) + off()} {off()}\n" if words[0] == "v" else line + "\n"
            for line in flat for words in [line.split()]))
        self.assertGreater(outside(shape), 0.02)
        points = self.write("points.xyz", xyz((i / 60, j / 60, 0) for i in range(61) for j in range(61)))
        result = self.fit(shape, points, "--within", "0.01", "--fix", "none", "--report", self.folder / "r.json")
        self.assertEqual(result.stderr, b"")
        self.assertIn("boundary         48 nodes go to 240 points", result.stdout.decode())
        report = self.read_json("r.json")
        self.assertEqual(report["points"]["boundary"], {"points": 240, "nodes_at_ends": 48, "nodes_inside": 0, "nodes_kept": 0})
        self.assertEqual((report["outcome"], report["moving_nodes"], report["boundary"]["outcome"]), ("converged", 169, "converged"))
        self.assertLess(outside(self.folder / "out.obj"), 0.005)

        # Where there are none it stays, and says so.
        half = self.write("half.xyz", xyz((i / 60, j / 60, 0) for i in range(31) for j in range(61)))
        result = self.fit(shape, half, "--smoothing-length", "0.05", "--fix", "none", "--report", self.folder / "r.json")
        self.assertIn("stay where they were", result.stderr.decode())
        self.assertIn("(--fix boundary)", result.stderr.decode())
        report = self.read_json("r.json")
        self.assertEqual(report["warning_codes"], ["untold-boundary"])
        self.assertGreater(report["points"]["boundary"]["nodes_kept"], 12)
        # Unless it is to be held.
        self.fit(shape, half, "--smoothing-length", "0.05", "--report", self.folder / "r.json")
        self.assertIsNone(self.read_json("r.json")["points"]["boundary"])

    def test_a_time_limit_leaves_deviations_of_many_points_to_who_asks_for_them(self):
        shape, cloud = self.write("flat.obj", grid(150, lambda x, y: 0)), self.cloud(20000)
        points = self.write("points.xyz", xyz(cloud))
        result = self.fit(shape, points, "--weight", "0.1", "--time-limit", "1e-9", "--report", self.folder / "r.json",
                          "--deviation", self.folder / "deviation.ply", "--threads", "1", status=3)
        figures = self.read_json("r.json")["points"]
        self.assertEqual((figures["count"], figures["distance"]), (20000, {"before": {}, "after": {}}))
        self.assertNotIn("distance", result.stdout.decode())
        self.assertIn("20000 points", result.stdout.decode())
        self.assertNotIn("nan", result.stdout.decode())
        data = (self.folder / "deviation.ply").read_bytes().partition(b"end_header\n")[2]
        deviations = [row[3] for row in struct.iter_unpack("<4d", data)]
        for (_, _, height), deviation in zip(cloud, deviations, strict=True):
            self.assertAlmostEqual(deviation, abs(height), delta=1e-6)

    def test_ctrl_c_measures_no_deviations_of_many_points(self):
        shape, points = self.write("flat.obj", grid(150, lambda x, y: 0)), self.write("points.xyz", xyz(self.cloud(20000)))
        result = run_interrupted("fit", shape, "--points", points, "-o", self.folder / "out.obj", "--weight", "0.1", "--method", "sweep",
                                 "--step-tolerance", "1e-30", "--max-iterations", "1000000000", "--report", self.folder / "r.json",
                                 "--deviation", self.folder / "deviation.ply", "--scalars", self.folder / "scalars.ply")
        self.assertEqual(result.returncode, 130, result.stderr)
        self.assertIn(b"deviation.ply: not written, as the run was interrupted", result.stderr)
        self.assertEqual(self.read_json("r.json")["points"]["distance"], {"before": {}, "after": {}})
        self.assertNotIn("distance", result.stdout.decode())
        self.assertTrue(any(heights(self.folder / "out.obj")), "the shape so far")
        self.assertEqual(self.files(), ["flat.obj", "out.obj", "points.xyz", "r.json"])

    def test_points_of_every_format(self):
        shape = self.write("flat.obj", grid(6, lambda x, y: 0))
        cloud = self.cloud(300)
        files = {"points.xyz": xyz(cloud), "points.csv": "x,y,z\n" + "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in cloud),
                 "points.obj": "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in cloud),
                 "points.off": f"OFF\n{len(cloud)} 0 0\n" + xyz(cloud),
                 "points.ply": f"ply\nformat ascii 1.0\nelement vertex {len(cloud)}\nproperty double x\nproperty double y\nproperty double z\n"
                               "end_header\n" + xyz(cloud)}
        outputs = set()
        for name, text in files.items():
            with self.subTest(name=name):
                self.fit(shape, self.write(name, text), "--weight", "0.1", "--quiet")
                outputs.add((self.folder / "out.obj").read_bytes())
        self.assertEqual(len(outputs), 1)

    def test_columns_of_shape_and_points(self):
        shape = self.write("flat.obj", grid(6, lambda x, y: 0))
        cloud = self.cloud(200)
        self.fit(shape, self.write("plain.xyz", xyz(cloud)), "--weight", "0.1")
        expected = (self.folder / "out.obj").read_bytes()
        rows = [(k, *point) for k, point in enumerate(cloud)]
        numbered = self.write("numbered.csv", "".join(",".join(repr(v) for v in row) + "\n" for row in rows))
        named = self.write("named.csv", "no;X [m];Y [m];Z [m]\n" + "".join(";".join(repr(v) for v in row) + "\n" for row in rows))
        refused = run("fit", shape, "--points", numbered, "-o", self.folder / "no.obj", "--weight", "0.1")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("choose columns, such as 2,3,4 (--columns)", self.assert_one_line(refused))
        for points, options in ((named, []), (numbered, ["--columns", "2,3,4"]), (numbered, ["--point-columns", "2,3,4"]),
                                (named, ["--columns", "x,y,z"])):
            self.fit(shape, points, "--weight", "0.1", *options)
            self.assertEqual((self.folder / "out.obj").read_bytes(), expected)
        guessed = self.write("guessed.csv", "a,b,c\n" + "".join(",".join(repr(v) for v in point) + "\n" for point in cloud))
        self.assertIn(b"no columns are named x and y; taken are columns 1 and 2 and 3", self.fit(shape, guessed, "--weight", "0.1").stderr)
        # A curve and its points may have their coordinates in different columns.
        wave = self.write("wave.csv", "".join(f"{k / 20!r},{0.1 * math.sin(k / 4)!r}\n" for k in range(21)))
        points = self.write("points.csv", "".join(f"{k},{k / 40!r},{0.1 * math.sin(k / 8) + 0.01!r}\n" for k in range(41)))
        self.fit(wave, points, "--weight", "0.1", "--point-columns", "2,3", output="out.csv")
        once = (self.folder / "out.csv").read_text()
        self.assertEqual(once.count(","), 21)
        wave = self.write("wave.csv", "".join(f"{k},{k / 20!r},{0.1 * math.sin(k / 4)!r}\n" for k in range(21)))
        self.fit(wave, points, "--weight", "0.1", "--columns", "2,3", output="out.csv")
        self.assertEqual([line.split(",", 1)[1] for line in (self.folder / "out.csv").read_text().splitlines()], once.splitlines())

    def test_normals_of_points(self):
        shape = self.write("flat.obj", grid(6, lambda x, y: 0))
        # Those that face down, of the other side of a wall, would draw the surface down.
        cloud = self.cloud(300) + self.cloud(300, lambda x, y: -0.2)
        normals = [(0, 0, 1)] * 300 + [(0, 0, -1)] * 300
        rows = [(*point, *normal) for point, normal in zip(cloud, normals)]
        files = {"points.xyz": xyz(rows), "points.csv": "x,y,z,nx,ny,nz\n" + "".join(",".join(repr(v) for v in row) + "\n" for row in rows),
                 "points.obj": "".join("v {!r} {!r} {!r}\nvn {!r} {!r} {!r}\n".format(*row) for row in rows)}
        for name, text in files.items():
            with self.subTest(name=name):
                points = self.write(name, text)
                self.fit(shape, points, "--weight", "0.05", "--ignore-point-normals", "--report", self.folder / "r.json")
                self.assertLess(max(heights(self.folder / "out.obj")), 0.05)
                self.assertEqual(self.read_json("r.json")["points"]["normals"], 0)
                result = self.fit(shape, points, "--weight", "0.05", "--report", self.folder / "r.json")
                self.assertGreater(max(heights(self.folder / "out.obj")), 0.12)
                self.assertEqual(self.read_json("r.json")["points"]["normals"], 600)
                self.assertIn("with normals", result.stdout.decode())
        long = self.write("long.csv", files["points.csv"].replace(",0,0,1\n", ",0,0,3\n"))
        result = run("fit", shape, "--points", long, "-o", self.folder / "out.obj", "--weight", "1")
        self.assertEqual(result.returncode, 1)
        self.assertIn("the normal of point 0 has the length 3", result.stderr.decode())

    def test_says_how_many_points_are_outside_a_tolerance(self):
        shape = self.write("flat.obj", grid(6, lambda x, y: 0))
        points = self.write("points.xyz", xyz(self.cloud(300)))
        result = self.fit(shape, points, "--rms", "0.01", "--report", self.folder / "r.json")
        report = self.read_json("r.json")["points"]
        outside = report["outside"]
        self.assertGreater(outside["count"], 0)
        # Some lie above corners, of which no node moves.
        self.assertEqual(outside["share"], outside["count"] / (300 - report["at_held"]["count"]))
        self.assertIn("further away", result.stdout.decode())
        self.fit(shape, points, "--within", "0.05", "--report", self.folder / "r.json")
        self.assertEqual(self.read_json("r.json")["points"]["outside"], {"count": 0, "share": 0})
        self.fit(shape, points, "--weight", "0.05", "--report", self.folder / "r.json")
        self.assertIsNone(self.read_json("r.json")["points"]["outside"])

    def test_weights_of_points(self):
        shape = self.write("flat.obj", grid(6, lambda x, y: 0))
        # Those of weight 0 would draw the surface down.
        cloud = self.cloud(300) + [(x, y, -1.0) for x, y, _ in self.cloud(300)]
        weights = [2.0] * 300 + [0.0] * 300
        head = (f"ply\nformat ascii 1.0\nelement vertex {len(cloud)}\n"
                + "".join(f"property double {name}\n" for name in ("x", "y", "z", "confidence")) + "end_header\n")
        rows = [(*point, weight) for point, weight in zip(cloud, weights)]
        files = {"points.xyz": xyz(rows), "points.ply": head + xyz(rows),
                 "points.csv": "weight,x,y,z\n" + "".join(f"{w!r},{x!r},{y!r},{z!r}\n" for x, y, z, w in rows)}
        outputs = set()
        for name, text in files.items():
            with self.subTest(name=name):
                result = self.fit(shape, self.write(name, text), "--weight", "0.05", "--report", self.folder / "r.json")
                outputs.add((self.folder / "out.obj").read_bytes())
                points = self.read_json("r.json")["points"]
                self.assertEqual((points["count"], points["weights"]), (600, {"least": 0, "greatest": 2}))
                self.assertLessEqual(points["pulling"], 300)
                self.assertIn("weights 0 to 2", result.stdout.decode())
        self.fit(shape, self.write("upper.xyz", xyz(cloud[:300])), "--weight", "0.1", "--report", self.folder / "r.json")
        outputs.add((self.folder / "out.obj").read_bytes())
        self.assertEqual(len(outputs), 1)
        self.assertIsNone(self.read_json("r.json")["points"]["weights"])

    def test_deviation_of_points_and_nodes(self):
        shape = self.write("flat.obj", grid(6, lambda x, y: 0))
        cloud = self.cloud(300)
        self.fit(shape, self.write("points.xyz", xyz(cloud)), "--weight", "0.1", "--deviation", self.folder / "d.ply", "--scalars",
                 self.folder / "s.ply", "--report", self.folder / "r.json")
        read = lambda name: (self.folder / name).read_bytes().split(b"end_header\n", 1)
        header, data = read("d.ply")
        self.assertIn(b"element vertex 300\nproperty double x\nproperty double y\nproperty double z\nproperty double deviation\n", header)
        rows = list(struct.iter_unpack("<4d", data))
        self.assertEqual([row[:3] for row in rows], cloud)
        report = self.read_json("r.json")["points"]
        after, at_held = report["distance"]["after"], report["at_held"]
        self.assertEqual(rows[after["point"]][3], after["greatest"])
        self.assertEqual(max(row[3] for row in rows), max(after["greatest"], at_held["greatest"]))
        squares = (300 - at_held["count"]) * after["rms"] ** 2 + at_held["count"] * at_held["rms"] ** 2
        self.assertTrue(math.isclose(sum(row[3] ** 2 for row in rows), squares, rel_tol=1e-12))
        header, data = read("s.ply")
        names = [line.split()[-1] for line in header.decode().splitlines() if line.startswith("property double")]
        at = names.index("point_deviation")
        values = [row[at] for row in struct.iter_unpack(f"<{len(names)}d", data[:49 * 8 * len(names)])]
        self.assertLessEqual(max(values), max(row[3] for row in rows))
        self.assertTrue(set(values) <= {0, *(row[3] for row in rows)})

    def test_a_curve_smoothed_by_its_own_nodes(self):
        generator = random.Random(2)
        noisy = [(k / 60, 0.1 * math.sin(math.pi * k / 60) + 0.004 * generator.uniform(-1, 1) * (0 < k < 60)) for k in range(61)]
        shape = self.write("noisy.csv", "".join(f"{x!r},{y!r}\n" for x, y in noisy))
        self.fit(shape, shape, "--weight", "0.001", "--picture", self.folder / "a.svg", "--report", self.folder / "r.json", output="out.csv")
        after = [tuple(map(float, line.split(","))) for line in (self.folder / "out.csv").read_text().splitlines()]
        self.assertEqual((after[0], after[-1]), (noisy[0], noisy[-1]))
        off = lambda points: math.sqrt(sum((y - 0.1 * math.sin(math.pi * x)) ** 2 for x, y in points) / len(points))
        self.assertLess(off(after), 0.7 * off(noisy))
        fairness = self.read_json("r.json")["fairness"]
        self.assertLess(fairness["after"]["rms_turn"], fairness["before"]["rms_turn"] / 2)
        picture = (self.folder / "a.svg").read_text()
        self.assertTrue(picture.rstrip().endswith("</svg>"))
        self.assertIn('id="points"', picture)

    def test_fair_and_curve_take_their_own_nodes_for_points(self):
        generator = random.Random(3)
        surface = self.write("noisy.obj", grid(12, lambda x, y: 0.01 * generator.uniform(-1, 1)))
        curve = self.write("noisy.csv", "".join(f"{k / 40!r},{0.1 * math.sin(k / 12) + 0.002 * generator.uniform(-1, 1)!r}\n" for k in range(41)))
        for command, shape, output in (("fair", surface, "out.obj"), ("curve", curve, "out.csv")):
            for option in ("--weight", "--smoothing-length", "--within", "--rms"):
                with self.subTest(command=command, option=option):
                    value = {"--weight": "0.01", "--smoothing-length": "0.1"}.get(option, "0.004")
                    result = run(command, shape, "-o", self.folder / output, option, value, "--report", self.folder / "r.json")
                    self.assertEqual(result.returncode, 0, result.stderr.decode())
                    own = (self.folder / output).read_bytes()
                    points = self.read_json("r.json")["points"]
                    self.fit(shape, shape, option, value, "--distribution", "keep", output=output)
                    self.assertEqual((self.folder / output).read_bytes(), own)
                    self.assertEqual(points["file"], str(shape))
                    if option in ("--within", "--rms"):
                        self.assertLessEqual(points["distance"]["after"]["greatest" if option == "--within" else "rms"], 0.004)
                    self.assertIn("rms distance", result.stdout.decode())
        result = run("fair", surface, "-o", self.folder / "out.obj", "--within", "1", "--weight", "1")
        self.assertEqual(result.returncode, 1)
        self.assertIn("only one of --weight", result.stderr.decode())
        self.assertEqual(run("curve", curve, "-o", self.folder / "out.csv", "--outliers", "0.1").returncode, 1)

    def test_an_aerofoil_within_a_tolerance_of_its_own_nodes(self):
        result = run("curve", EXAMPLES / "naca-2412.dat", "-o", self.folder / "out.dat", "--within", "0.0005", "--report", self.folder / "r.json")
        self.assertEqual(result.returncode, 0, result.stderr.decode())
        report = self.read_json("r.json")
        self.assertLessEqual(report["points"]["distance"]["after"]["greatest"], 0.0005)
        before, after = (report["fairness"][when]["vspring_energy"] for when in ("before", "after"))
        self.assertLess(after, 0.9 * before)

    def test_resampled_curves_stay_within_a_tolerance_of_what_they_were(self):
        curve = self.write("wave.csv", "".join(f"{k / 30!r},{0.1 * math.sin(k / 5) + 0.001 * (-1) ** k!r}\n" for k in range(31)))
        result = run("curve", curve, "-o", self.folder / "out.csv", "--within", "0.003", "--resample", "121", "--report", self.folder / "r.json")
        self.assertEqual(result.returncode, 0, result.stderr.decode())
        points = self.read_json("r.json")["points"]
        self.assertEqual((points["count"], self.read_json("r.json")["nodes"]), (31, 121))
        self.assertLessEqual(points["distance"]["after"]["greatest"], 0.003)

    def test_new_nodes_of_a_noisy_aerofoil_have_no_more_extremes_than_the_exact_one(self):
        draw = random.Random(2)
        upper = lambda x: 0.6 * (0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x ** 2 + 0.2843 * x ** 3 - 0.1036 * x ** 4)
        angles = [math.pi * k / 60 for k in range(-60, 61)]
        exact = [((1 - math.cos(a)) / 2, math.copysign(upper((1 - math.cos(a)) / 2), -a)) for a in angles]
        noisy = [exact[0], *(tuple(x + draw.uniform(-0.0003, 0.0003) for x in node) for node in exact[1:-1]), exact[-1]]
        figures = lambda nodes: self.figures(self.write("nodes.csv", "".join(f"{x!r},{y!r}\n" for x, y in nodes)))
        table, wanted = self.write("noisy.csv", "".join(f"{x!r},{y!r}\n" for x, y in noisy)), figures(exact)
        for options in (["--resample-by", "cosine"], ["--resample-by", "curvature"]):
            with self.subTest(options=options):
                result = run("curve", table, "-o", self.folder / "out.csv", "--within", "0.0006", "--resample", "120", "--report", self.folder / "r.json", *options)
                self.assertEqual((result.returncode, result.stderr), (0, b""))
                self.assertLessEqual(self.read_json("r.json")["points"]["distance"]["after"]["greatest"], 0.0006)
                made = self.figures(self.folder / "out.csv")
                self.assertLessEqual(made["curvature_extrema"], wanted["curvature_extrema"])
                self.assertLessEqual(made["inflections"], wanted["inflections"])

    def figures(self, path):
        self.assertEqual(run("measure", path, "--report", self.folder / "figures.json").returncode, 0)
        return self.read_json("figures.json")["figures"]

    def test_a_least_radius_is_kept_or_it_is_said_where_it_is_not(self):
        rows = "".join(f"{2 * k},{0.3 * (-1) ** k}\n" for k in range(20)) + "".join(f"40,{2 * k}\n" for k in range(20))
        track = self.write("track.csv", rows)
        for radius, status in ((10, 0), (30, 3)):
            done = run("curve", track, "-o", self.folder / "out.csv", "--within", "2", "--min-radius", str(radius), "--report",
                       self.folder / "r.json")
            self.assertEqual(done.returncode, status, done.stderr.decode())
            report = self.read_json("r.json")
            self.assertEqual(report["points"]["min_radius"], radius)
            least = report["points"]["least_radius"]
            self.assertIn(f"least radius     {least['radius']:.4g} units, at node {least['node']}", done.stdout.decode())
            self.assertEqual("radius-not-kept" in report["warning_codes"], status == 3)
            self.assertEqual(least["radius"] >= 0.99 * radius, status == 0)
            self.assertLessEqual(report["points"]["distance"]["after"]["greatest"], 2)
        self.assertIn(f"at node {least['node']};", done.stderr.decode())
        self.assertEqual(run("curve", track, "-o", self.folder / "out.csv", "--min-radius", "3").returncode, 1)

    def test_a_closed_surface_that_only_points_hold(self):
        shape = self.write("ball.obj", sphere(4, radius=0.9))
        points = self.write("points.obj", sphere(12, radius=1.0))
        # Points along normals alone do not keep nodes from sliding, so steps of the plain iteration never get small.
        self.fit(shape, points, "--weight", "0.1", "--method", "sweep", "--step-tolerance", "0.005")
        self.fit(shape, points, "--weight", "0.1")
        for line in vertex_lines((self.folder / "out.obj").read_text()):
            self.assertAlmostEqual(math.hypot(*map(float, line.split()[1:])), 1, delta=0.02)

    def test_a_closed_curve(self):
        ring = lambda count, radius: "".join(f"{radius * math.cos(2 * math.pi * k / count)!r},{radius * math.sin(2 * math.pi * k / count)!r}\n"
                                             for k in range(count))
        self.fit(self.write("ring.csv", ring(30, 0.9)), self.write("points.csv", ring(100, 1)), "--weight", "0.1", "--closed", "--fix", "none",
                 output="out.csv")
        for line in (self.folder / "out.csv").read_text().splitlines():
            self.assertAlmostEqual(math.hypot(*map(float, line.split(","))), 1, delta=0.01)

    def test_the_same_bits_on_any_number_of_threads(self):
        shape = self.write("flat.obj", grid(30))
        points = self.write("points.xyz", xyz(self.cloud()))
        outputs = set()
        for threads in (1, 2, 5):
            self.fit(shape, points, "--weight", "0.01", "--threads", threads)
            outputs.add((self.folder / "out.obj").read_bytes())
        self.assertEqual(len(outputs), 1)

    def test_standard_input_and_output(self):
        shape = self.write("flat.obj", grid(6))
        points = self.write("points.xyz", xyz(self.cloud(100)))
        self.fit(shape, points, "--weight", "0.1", "--quiet")
        result = run("fit", "-", "--points", points, "-o", "-", "--weight", "0.1", "--quiet", stdin=shape.read_bytes())
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        self.assertEqual(result.stdout, (self.folder / "out.obj").read_bytes())

    def test_a_smoothing_length(self):
        shape = self.write("flat.obj", grid(12, lambda x, y: 0))
        points = self.write("points.xyz", xyz(self.cloud()))
        result = self.fit(shape, points, "--smoothing-length", "0.05", "--report", self.folder / "r.json")
        self.assertAlmostEqual(max(heights(self.folder / "out.obj")), 0.2, delta=0.01)
        report = self.read_json("r.json")["points"]
        self.assertEqual((report["smoothing_length"], report["weight"], report["within"]), (0.05, None, None))
        self.assertIn("smoothing length 0.05 units", result.stdout.decode())

    def test_points_outside_are_told_where_the_input_stays(self):
        generator = random.Random(1)
        line = "".join(f"{10 * k / 14!r},{math.sin(10 * k / 14)!r}\n" for k in range(15))
        points = [(10 * k / 399 + generator.gauss(0, 0.06), math.sin(10 * k / 399) + generator.gauss(0, 0.06)) for k in range(400)]
        for k in range(0, 400, 40):
            points[k] = (points[k][0] + generator.gauss(0, 3), points[k][1] + generator.gauss(0, 3))
        cloud = "".join(f"{x!r},{y!r}\n" for x, y in points)
        self.fit(self.write("line.csv", line), self.write("points.csv", cloud), "--within", "0.2", "--report", self.folder / "r.json",
                 output="out.csv", status=3)
        report = self.read_json("r.json")
        self.assertEqual(report["outcome"], "worse-than-input")
        self.assertGreater(report["points"]["distance"]["after"]["greatest"], 0.2)
        self.assertGreaterEqual(report["points"]["outside"]["count"], 4)

    def test_a_tolerance(self):
        shape = self.write("flat.obj", grid(12, lambda x, y: 0))
        cloud = self.cloud()
        points = self.write("points.xyz", xyz(cloud))
        for option, figure in (("--within", "greatest"), ("--rms", "rms")):
            with self.subTest(option=option):
                self.fit(shape, points, option, "0.02", "--report", self.folder / "r.json")
                report = self.read_json("r.json")
                self.assertEqual(report["outcome"], "converged")
                self.assertLessEqual(report["points"]["distance"]["after"][figure], 0.02)
                self.assertGreater(report["points"]["distance"]["after"][figure], 0.018)
        outlier = self.write("more.xyz", xyz(cloud + [(0.5, 0.5, 3.0)]))
        self.fit(shape, outlier, "--within", "0.02", "--outliers", "0.0005", "--report", self.folder / "r.json")
        self.assertEqual(self.read_json("r.json")["points"]["outliers"], 1)
        # Beside the rim, which is held.
        beyond = self.write("beyond.xyz", xyz(cloud + [(-0.1, 0.5, 0.0)]))
        result = self.fit(shape, beyond, "--within", "0.02", "--report", self.folder / "r.json")
        self.assertIn("nothing that moves comes nearer", result.stderr.decode())
        report = self.read_json("r.json")
        self.assertAlmostEqual(report["points"]["at_held"]["greatest"], 0.1)
        self.assertEqual(report["warning_codes"][-1], "points-at-held")
        self.assertIn("do not count", result.stdout.decode())
        apart = self.write("apart.xyz", xyz(cloud + [(0.5, 0.5, 3.0)]))
        result = self.fit(shape, apart, "--within", "0.02", status=3)
        self.assertIn("no shape of this mesh", result.stderr.decode())

    def test_an_end_at_the_limit_of_iterations(self):
        self.fit(self.write("flat.obj", grid(6)), self.write("points.xyz", xyz(self.cloud(100))), "--weight", "0.1", "--max-iterations", "2", status=3)

    def test_refusals(self):
        shape = self.write("flat.obj", grid(6))
        points = self.write("points.xyz", xyz(self.cloud(100)))
        out = self.folder / "out.obj"
        far = self.write("far.xyz", xyz([(0, 0, 0), (0, 0, 1e90)]))
        ball = self.write("ball.obj", OCTAHEDRON)
        light = self.write("light.xyz", "0 0 0 1\n0 0 1 -2\n")
        good = [shape, "--points", points, "--weight", "1"]
        for arguments, status, word in (([shape, "--points", points], 1, "--weight"), ([shape, "--weight", "1"], 1, "--points"),
                                        ([shape, "--points", points, "--weight", "-1"], 1, "--weight"),
                                        ([shape, "--points", points, "--weight", "1", "--within", "1"], 1, "--within"),
                                        ([shape, "--points", points, "--within", "0"], 1, "--within"),
                                        ([shape, "--points", points, "--within", "1", "--method", "sweep"], 1, "sweep"),
                                        ([shape, "--points", points, "--rms", "1", "--outliers", "1"], 1, "--outliers"),
                                        ([shape, "--points", self.folder / "none.xyz", "--weight", "1"], 2, "none.xyz"),
                                        ([shape, "--points", far, "--weight", "1"], 1, "point 1 "),
                                        ([shape, "--points", light, "--weight", "1"], 2, "light.xyz:2: the weight is -2"),
                                        ([*good, "--deviation", self.folder / "d.vtp"], 1, ".ply"),
                                        ([*good, "--deviation", self.folder / "no" / "d.ply"], 2, "no"),
                                        ([*good, "--deviation", points], 1, "--points"),
                                        (["-", "--points", "-", "--weight", "1"], 1, "standard input"),
                                        ([*good, "--columns", "1"], 1, "two or three columns"),
                                        ([*good, "--columns", "2,9"], 2, "points.xyz:1: column 9 is chosen"),
                                        ([shape, "--points", shape, "--weight", "1", "--columns", "1,2"], 1, "--columns"),
                                        ([shape, "--points", shape, "--weight", "1", "--point-columns", "1,2"], 1, "columns"),
                                        ([ball, "--points", points, "--weight", "0"], 2, "nothing holds"),
                                        ([shape, "--points", points, "--weight", "0", "--fix", "none"], 2, "boundary"),
                                        ([shape, "--points", points, "--weight", "1", "--fix", "none", "--paper"], 2, "boundary")):
            with self.subTest(arguments=arguments):
                result = run("fit", *arguments, "-o", out)
                self.assertEqual(result.returncode, status, result.stderr)
                self.assertIn(word, self.assert_one_line(result))
                self.assertFalse(out.exists())
