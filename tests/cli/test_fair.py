"""What `vspring fair` does with good input."""
import json
import math
import os
import random
import signal
import struct
import subprocess
import time

import support
from support import OCTAHEDRON, PROGRAM, Case, grid, hat, run, vertex_lines


class Fair(Case):
    def fair(self, *options, text=None, status=0):
        before = self.write("in.obj", text or hat())
        result = run("fair", before, "-o", self.folder / "out.obj", *options)
        self.assertEqual(result.returncode, status, result.stderr.decode())
        return result

    def test_moves_the_inside_and_keeps_all_else(self):
        self.fair()
        before = hat().splitlines()
        after = (self.folder / "out.obj").read_text().splitlines()
        self.assertEqual(len(before), len(after))
        changed = [k for k, (a, b) in enumerate(zip(before, after)) if a != b]
        inner = range(1, 2 + 3 * 12)
        self.assertTrue(changed)
        self.assertTrue(set(changed) <= set(inner), "only nodes inside may change, the boundary bit for bit")

    def test_report(self):
        self.fair("--report", self.folder / "report.json", "--threads", "2")
        report = self.read_json("report.json")
        self.assertEqual(report["outcome"], "converged")
        self.assertEqual((report["springs"], report["fair_by"]), ("sphere", "curvature"))
        for key, kind in {"iterations": int, "residual": float, "nodes": int, "faces": int, "fixed_positions": int,
                          "fixed_normals": int, "seconds": float, "peak_memory_bytes": int, "threads": int, "version": str,
                          "greatest_move": float, "rms_move": float, "moving_nodes": int, "warnings": list}.items():
            self.assertIsInstance(report[key], kind, key)
        self.assertIn("expected_error", report)
        self.assertEqual((report["nodes"], report["faces"], report["fixed_positions"]), (49, 48, 12))
        self.assertEqual(report["threads"], 2)
        self.assertLess(report["residual"], 1e-3)
        before, after = report["fairness"]["before"], report["fairness"]["after"]
        self.assertLess(after["bending_energy"], before["bending_energy"])
        self.assertLess(after["vspring_energy"], before["vspring_energy"])
        self.assertLess(after["greatest_turn"], before["greatest_turn"])

    def test_shares_of_the_size_are_of_what_moves(self):
        share = lambda text: self.fair(text=text).stdout.decode().split("by up to ")[1].split("(")[1].split(" % of the size")[0]
        self.assertEqual(share(hat() + "v 1e5 1e5 1e5\n"), share(hat()))
        self.assertEqual(share(hat() + "v 1e5 0 0\nv 1e5 1 0\nv 1e5 0 1\nf -3 -2 -1\n"), share(hat()))

    def test_figures_are_of_what_a_file_in_single_precision_holds(self):
        nodes = [[float(x) for x in line.split()[1:4]] for line in hat().splitlines() if line.startswith("v ")]
        faces = [[int(corner.split("/")[0]) - 1 for corner in line.split()[1:]] for line in hat().splitlines() if line.startswith("f ")]
        rows = [f"{x + 3e4!r} {y + 4e5!r} {z!r}" for x, y, z in nodes] + [" ".join(map(str, [len(face), *face])) for face in faces]
        header = lambda kind: (f"ply\nformat ascii 1.0\nelement vertex {len(nodes)}\n"
                               + "".join(f"property {kind} {axis}\n" for axis in "xyz")
                               + f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
        for kind, is_rounded in (("float", True), ("double", False)):
            path = self.write(f"{kind}.ply", header(kind) + "\n".join(rows) + "\n")
            done = run("fair", path, "-o", self.folder / "out.ply", "--report", self.folder / "report.json")
            self.assertEqual(b"the file has single precision, which moves nodes by up to" in done.stderr, is_rounded)
            run("measure", self.folder / "out.ply", "--report", self.folder / "measured.json")
            for figure in ("greatest_turn", "rms_turn"):
                self.assertAlmostEqual(self.read_json("report.json")["fairness"]["after"][figure],
                                       self.read_json("measured.json")["figures"][figure], 4)

    def test_rounding_of_what_came_is_told_and_taken_off(self):
        draw = random.Random(3)
        single = lambda x: struct.unpack("f", struct.pack("f", x))[0]
        count = 20
        nodes = [(5e6 + 0.3 * i, 4e6 + 0.3 * j, math.sin(i / 5) + draw.gauss(0, 0.02)) for j in range(count) for i in range(count)]
        faces = [(i, i + 1, i + 1 + count, i + count) for i in range(count * (count - 1)) if (i + 1) % count]
        header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(nodes)}\nproperty float x\nproperty float y\nproperty float z\n"
                  f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n").encode()
        path = self.folder / "far.ply"
        path.write_bytes(header + b"".join(struct.pack("<3f", *node) for node in nodes) + b"".join(struct.pack("<B4i", 4, *face) for face in faces))
        done = run("fair", path, "-o", self.folder / "out.obj", "--format", "obj", "--noise", "auto", "--report", self.folder / "report.json")
        self.assertIn(b"single precision has rounded nodes by 0.093", done.stderr)
        self.assertAlmostEqual(self.read_json("report.json")["points"]["estimated_noise"], math.sqrt((0.5 ** 2 + 0.25 ** 2) / 36), 3)
        near = self.folder / "near.ply"
        near.write_bytes(header + b"".join(struct.pack("<3f", single(x - 5e6), single(y - 4e6), z) for x, y, z in nodes)
                         + b"".join(struct.pack("<B4i", 4, *face) for face in faces))
        self.assertNotIn(b"rounded", run("fair", near, "-o", self.folder / "out.ply", "--noise", "auto").stderr)
        lost = self.folder / "lost.ply"
        lost.write_bytes(header + b"".join(struct.pack("<3f", x + 3e7, y + 3e7, z) for x, y, z in nodes)
                         + b"".join(struct.pack("<B4i", 4, *face) for face in faces))
        for option in ("--noise", "--within", "--rms"):
            done = run("fair", lost, "-o", self.folder / "lost-out.ply", option, "auto")
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"{option} auto: single precision has rounded nodes to multiples of about", self.assert_one_line(done))
            self.assertFalse((self.folder / "lost-out.ply").exists())

    def test_standard_input_and_output(self):
        result = run("fair", "-", "-o", "-", "--quiet", stdin=hat().encode())
        self.assertEqual(result.returncode, 0)
        self.fair("--quiet")
        self.assertEqual(result.stdout, (self.folder / "out.obj").read_bytes())
        self.assertEqual(result.stderr, b"")
        off = run("fair", "-", "-o", "-", "--format", "obj", "--quiet", stdin=hat().encode())
        self.assertEqual(off.stdout, result.stdout)

    def test_summary_goes_beside_the_shape(self):
        result = run("fair", "-", "-o", "-", stdin=hat().encode())
        self.assertTrue(result.stdout.startswith(b"# a hat\n"))
        self.assertIn("converged", result.stderr.decode())
        result = self.fair()
        self.assertIn("nodes moved", result.stdout.decode())

    def test_strength_nought_gives_the_input_back(self):
        self.fair("--strength", "0")
        self.assertEqual((self.folder / "out.obj").read_bytes(), (self.folder / "in.obj").read_bytes())

    def test_every_option_has_an_effect(self):
        self.fair()
        plain = (self.folder / "out.obj").read_bytes()
        rules = self.write("rules.json", json.dumps({"rules": [{"nodes": [0], "position": [0, 0, 2]}]}))
        for options in (["--fix-normals", "boundary"], ["--constraints", rules], ["--region", "sphere:0,0,1,0.6"],
                        ["--tolerance", "1e-2"], ["--method", "sweep"], ["--springs", "edge"], ["--fair-by", "bending"], ["--pseudo-normals", "area"], ["--pseudo-normals", "angle"], ["--paper"],
                        ["--distribution", "keep"], ["--strength", "0.5"]):
            self.fair(*options)
            self.assertNotEqual((self.folder / "out.obj").read_bytes(), plain, options)
        self.fair("--method", "sweep")
        coarse = (self.folder / "out.obj").read_bytes()
        self.fair("--method", "sweep", "--step-tolerance", "1e-6")
        self.assertNotEqual((self.folder / "out.obj").read_bytes(), coarse)
        self.fair("--method", "sweep", "--pseudo-normals", "average")
        average = (self.folder / "out.obj").read_bytes()
        self.fair("--paper")
        paper = (self.folder / "out.obj").read_bytes()
        # Node after node as the file has them.
        self.assertNotEqual(paper, average)
        self.fair("--paper", "--threads", "3")
        self.assertEqual((self.folder / "out.obj").read_bytes(), paper)

    def test_region_by_group_box_and_list(self):
        def moved():
            before = vertex_lines((self.folder / "in.obj").read_text())
            after = vertex_lines((self.folder / "out.obj").read_text())
            return {k for k, (a, b) in enumerate(zip(before, after)) if a != b}

        self.fair("--region", "group:tip")
        self.assertEqual(moved(), set(range(13)))
        self.fair("--region", "box:-0.3,-0.3,0,0.3,0.3,2")
        self.assertEqual(moved(), set(range(13)))
        nodes = self.write("nodes.json", "[0, 1, 2]")
        self.fair("--region", nodes)
        self.assertEqual(moved(), {0, 1, 2})

    def test_rules_hold_nodes_where_they_say(self):
        rules = {"rules": [{"nodes": "boundary", "position": "fixed", "normal": [0, 0, 1]},
                           {"nodes": {"group": "tip"}, "normal": "fixed"},
                           {"nodes": {"group": "tip"}, "normal": "free"},
                           {"nodes": [0, 1], "position": [[0, 0, 1.25], [0.25, 0, 1]]}]}
        self.write("rules.json", json.dumps(rules))
        self.fair("--constraints", self.folder / "rules.json", "--report", self.folder / "report.json")
        lines = vertex_lines((self.folder / "out.obj").read_text())
        self.assertEqual(lines[0], "v 0 0 1.25")
        self.assertEqual(lines[1], "v 0.25 0 1")
        report = self.read_json("report.json")
        self.assertEqual((report["fixed_positions"], report["fixed_normals"]), (14, 12))

    def test_curvature_at_the_rim(self):
        path = self.write("hill.obj", grid(32, lambda x, y: math.exp(-2 * ((x - 0.5) ** 2 + 2 * (y - 0.5) ** 2))))
        args = ("fair", path, "-o", self.folder / "out.obj", "--region", "sphere:0.5,0.5,1,0.28", "--report", self.folder / "report.json")
        run(*args)
        self.assertEqual(self.read_json("report.json")["continuity"], "tangent")
        done = run(*args, "--continuity", "curvature")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        report = self.read_json("report.json")
        self.assertEqual(report["continuity"], "curvature")
        self.assertLess(report["curvature_jump"]["after"], 0.6 * report["curvature_jump"]["tangent"])
        # The whole of it moves, but for its boundary: nothing is around.
        done = run("fair", path, "-o", self.folder / "out.obj", "--continuity", "curvature", "--report", self.folder / "report.json")
        self.assertEqual(done.returncode, 0)
        self.assertIn(b"nothing is held around it", done.stderr)
        self.assertEqual(self.read_json("report.json")["warning_codes"], ["tangent-only"])
        done = run("fair", path, "-o", self.folder / "none.obj", "--continuity", "curvature", "--noise", "0.01")
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"where no points pull", done.stderr)
        self.assertFalse((self.folder / "none.obj").exists())

    def test_nodes_slide(self):
        run("generate", "cap", "--nodes", 300, "--half-angle", 70, "--noise", 0.01, "-o", self.folder / "cap.obj")
        before = [[float(x) for x in line.split()[1:]] for line in vertex_lines((self.folder / "cap.obj").read_text())]
        height = math.cos(math.radians(70))
        side = {i for i, (x, _, z) in enumerate(before) if abs(z - height) < 0.01 and x > 0}
        slide = f"box:0,-1,{height - 0.01},1,1,{height + 0.01}=plane:0,0,{height},0,0,1"

        def faired(*options):
            done = run("fair", self.folder / "cap.obj", "-o", self.folder / "out.obj", "--tolerance", 1e-9, "--report",
                       self.folder / "report.json", *options)
            return done, [[float(x) for x in line.split()[1:]] for line in vertex_lines((self.folder / "out.obj").read_text())]

        done, after = faired("--fix-normals", "boundary", "--slide", slide)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.read_json("report.json")["sliding_nodes"], len(side))
        self.assertIn(f"sliding          {len(side)} of them on supports", done.stdout.decode())
        self.assertTrue(all(abs(after[i][2] - height) < 1e-15 for i in side))
        self.assertLess(max(abs(math.hypot(*place) - 1) for place in after), 0.05)
        # The same by rules, and whichever is later wins.
        self.write("slide.json", json.dumps({"rules": [
            {"nodes": sorted(side), "slide": {"plane": {"point": [0, 0, height], "normal": [0, 0, 1]}}}]}))
        self.assertEqual(faired("--fix-normals", "boundary", "--constraints", self.folder / "slide.json")[1], after)
        self.write("held.json", json.dumps({"rules": [{"nodes": "boundary", "position": "fixed"}]}))
        faired("--fix-normals", "boundary", "--slide", slide, "--constraints", self.folder / "held.json")
        self.assertEqual(self.read_json("report.json")["sliding_nodes"], 0)
        for wrong, words in (("boundary=hill:0", b"write plane:px"), ("boundary", b"write NODES=SUPPORT"),
                             ("boundary=plane:0,0,0,0,0,0", b"normal of zero")):
            done, _ = faired("--slide", wrong)
            self.assertIn(done.returncode, (1, 2))
            self.assertIn(words, done.stderr)

    def test_noise_is_taken_off_by_what_the_nodes_say(self):
        noisy = support.sphere(12, noise=0.02)
        off = lambda text: max(abs(math.hypot(*map(float, line.split()[1:])) - 2) for line in vertex_lines(text))
        run("measure", self.write("noisy.obj", noisy), "--report", self.folder / "measured.json")
        figures = self.read_json("measured.json")["figures"]
        # More nodes have a greater greatest.
        self.assertGreater(figures["within_auto"], 3 * figures["noise"])
        for options, share in (("--noise", 0.6), ("--rms", 0.6), ("--within", 1.5)):
            with self.subTest(options):
                result = self.fair(options, "auto", "--report", self.folder / "report.json", text=noisy)
                points = self.read_json("report.json")["points"]
                self.assertAlmostEqual(points["estimated_noise"], 0.02 / math.sqrt(3), delta=0.002)
                self.assertEqual(points["estimated_noise"], figures["noise"])
                self.assertEqual(points[options[2:]], figures["within_auto" if options == "--within" else "noise"])
                self.assertIn(b"noise estimated", result.stdout)
                self.assertLess(off((self.folder / "out.obj").read_text()), share * off(noisy))
        for wrong in ("0", "-1", "much", "nan"):
            self.assertIn(b"--noise: a number greater than 0, or auto, is needed, not " + wrong.encode(),
                          self.fair("--noise", wrong, text=noisy, status=1).stderr)
        self.assertIn(b"only one of", self.fair("--noise", "auto", "--rms", "1", text=noisy, status=1).stderr)

    def test_a_tolerance_smaller_than_the_noise_is_told_so(self):
        result = self.fair("--within", "0.05", text=support.sphere(6, noise=0.5))
        self.assertIn(b"may not be the fairest", result.stderr)
        self.assertIn(b"the noise of the nodes seems to be larger than the tolerance", result.stderr)
        self.assertNotIn(b"noise of the nodes", self.fair("--within", "0.05", text=support.sphere(6, noise=0.02)).stderr)

    def test_a_noisy_rim_is_fitted_first(self):
        noisy = grid(14, lambda x, y: 0.02 * math.sin(37 * x + 53 * y))
        held = self.fair("--noise", "0.01", text=noisy)
        first = vertex_lines((self.folder / "out.obj").read_text())[0]
        self.assertEqual(first, vertex_lines(noisy)[0], held.stdout)
        self.fair("--noise", "0.01", "--fair-boundary", "--report", self.folder / "report.json", text=noisy)
        report = self.read_json("report.json")
        self.assertEqual(report["boundary"]["outcome"], "converged")
        self.assertNotEqual(first, vertex_lines((self.folder / "out.obj").read_text())[0])

    def test_same_bytes_for_every_number_of_threads(self):
        outputs = []
        for threads in (1, 2, 3):
            self.fair("--threads", threads, text=grid(60))
            outputs.append((self.folder / "out.obj").read_bytes())
        self.assertEqual(outputs[0], outputs[1])
        self.assertEqual(outputs[0], outputs[2])

    def test_not_converged_is_written_and_told(self):
        result = self.fair("--max-iterations", "4", "--report", self.folder / "report.json", status=3)
        self.assertIn("limit of iterations", result.stdout.decode())
        self.assertEqual(self.read_json("report.json")["outcome"], "iteration-limit")
        self.assertEqual(len(vertex_lines((self.folder / "out.obj").read_text())), 49)

    def test_an_input_that_comes_back_is_not_said_to_be_another_shape_too(self):
        run("generate", "genus", "--holes", "0", "--cells", "1", "--noise", "0.2", "-o", self.folder / "genus.obj")
        self.fair("--weight", "1e-9", text=(self.folder / "genus.obj").read_text(), status=3)
        again = run("fair", self.folder / "in.obj", "-o", self.folder / "out.obj", "--weight", "1e-9").stderr.decode()
        self.assertEqual(again.count("this is "), 1, again)
        self.assertIn("this is the input", again)
        self.assertEqual((self.folder / "out.obj").read_text(), (self.folder / "in.obj").read_text())

    def test_a_fit_that_leads_to_nothing_is_smoothed_by_less(self):
        run("generate", "genus", "--noise", "0.1", "--cells", "2", "-o", self.folder / "genus.obj")
        result = self.fair("--weight", "1e-6", "--report", self.folder / "report.json", text=(self.folder / "genus.obj").read_text())
        self.assertIn("the weight 1e-06 is too small here", result.stderr.decode())
        self.assertIn("smoothed-less", self.read_json("report.json")["warning_codes"])

    def test_a_time_limit_ends_with_a_shape_and_says_so(self):
        support.run("generate", "annulus", "--nodes", "60000", "--noise", "0.01", "-o", self.folder / "large.obj")
        text = (self.folder / "large.obj").read_text()
        ended = self.fair("--time-limit", "0.05", "--report", self.folder / "report.json", text=text, status=3)
        self.assertEqual(self.read_json("report.json")["outcome"], "work-limit")
        self.assertIn("--time-limit", ended.stderr.decode())
        self.assertEqual(len(vertex_lines((self.folder / "out.obj").read_text())), len(vertex_lines(text)))
        self.fair("--time-limit", "1000")
        within = (self.folder / "out.obj").read_bytes()
        self.fair()
        self.assertEqual(within, (self.folder / "out.obj").read_bytes())

    def test_other_formats(self):
        for name in ("out.ply", "out.off", "out.stl"):
            before = self.write("in.obj", hat())
            result = run("fair", before, "-o", self.folder / name)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("without", result.stderr.decode(), "what the format drops is told")
            again = run("fair", self.folder / name, "-o", self.folder / "again.obj")
            self.assertEqual(again.returncode, 0, again.stderr)

    def test_overwrites_its_own_input(self):
        path = self.write("in.obj", hat())
        self.assertEqual(run("fair", path, "-o", path).returncode, 0)
        self.assertNotEqual(path.read_text(), hat())
        self.assertEqual(self.files(), ["in.obj"])

    def test_what_would_vanish_is_refused_with_the_ways_out(self):
        path = self.write("in.obj", OCTAHEDRON)
        result = run("fair", path, "-o", self.folder / "out.obj")
        self.assertEqual(result.returncode, 2)
        line = self.assert_one_line(result)
        for word in ("node 0", "closed", "--constraints", "--region", "--noise auto"):
            self.assertIn(word, line)
        self.assertNotIn("--fix boundary", line)
        path = self.write("in.obj", hat())
        result = run("fair", path, "-o", self.folder / "out.obj", "--fix", "none")
        self.assertEqual(result.returncode, 2)
        self.assertIn("--fix boundary", self.assert_one_line(result))
        self.assertEqual(self.files(), ["in.obj"])

    def test_who_loses_all_between_the_boundaries_is_told_what_keeps_it(self):
        note = "only the boundary is held"
        said = self.fair().stdout.decode()
        self.assertIn(note, said)
        self.assertIn("--noise auto", said)
        for options in (["--region", "sphere:0,0,1,0.6"], ["--within", "0.01"], ["--fix-normals", "boundary"]):
            self.assertNotIn(note, self.fair(*options).stdout.decode(), options)
        flat = grid(6, lambda x, y: 0.01 * math.sin(9 * x))
        self.assertNotIn(note, self.fair(text=flat).stdout.decode())

    def test_who_holds_normals_of_noisy_nodes_is_told(self):
        for noise, turned in (("0", False), ("0.03", True)):
            run("generate", "tube", "--columns", "24", "--rows", "12", "--noise", noise, "-o", self.folder / "tube.obj")
            done = run("fair", self.folder / "tube.obj", "-o", self.folder / "out.obj", "--fix-normals", "boundary")
            self.assertEqual(b"noise, which turns the normals that are held at the boundary by about 6" in done.stdout, turned)

    def test_a_family_of_shapes_ends_in_one_near_the_input_with_a_warning(self):
        self.write("rules.json", json.dumps({"rules": [{"nodes": [0], "position": "fixed"}]}))
        result = self.fair("--constraints", self.folder / "rules.json", text=OCTAHEDRON)
        self.assertIn("family", result.stderr.decode())
        self.assertIn("near the input", result.stderr.decode())

    def test_ctrl_c_writes_the_shape_so_far_whole(self):
        path = self.write("in.obj", grid(120))
        for name in (signal.SIGINT, signal.SIGTERM):
            result = support.run_interrupted("fair", path, "-o", self.folder / "out.obj", "--method", "sweep", "--step-tolerance", "1e-30",
                                             "--max-iterations", "1000000000", "--report", self.folder / "report.json", by=name)
            self.assertEqual(result.returncode, 130, result.stderr)
            self.assertIn("interrupted", result.stdout.decode())
            self.assertEqual(self.read_json("report.json")["outcome"], "cancelled")
            self.assertEqual(len(vertex_lines((self.folder / "out.obj").read_text())), 121 * 121)
            self.assertEqual(self.files(), ["in.obj", "out.obj", "report.json"])

    def test_ctrl_c_while_the_input_is_read_ends_at_once_and_writes_nothing(self):
        pipe, out = self.folder / "in.obj", self.folder / "out.obj"
        os.mkfifo(pipe)
        for name in (signal.SIGINT, signal.SIGTERM):
            process = subprocess.Popen([PROGRAM, "fair", pipe, "-o", out, "--format", "obj"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            # Which is open once the program reads it, and has no end.
            with pipe.open("wb") as writer:
                writer.write(b"v 0 0 0\n")
                writer.flush()
                process.send_signal(name)
                output, errors = process.communicate(timeout=60)
            self.assertEqual((process.returncode, output, errors), (130, b"", b""))
            self.assertEqual(self.files(), ["in.obj"])

    def test_ctrl_c_ends_measuring(self):
        path, out, page = self.write("in.obj", grid(250)), self.folder / "out.obj", self.folder / "page.html"
        process = subprocess.Popen([PROGRAM, "fair", path, "-o", out, "--max-iterations", "1", "--threads", "1", "--html", page,
                                    "--report", self.folder / "report.json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        # Once the shape is there, it is measured, which takes long.
        while not out.exists():
            self.assertIsNone(process.poll())
            time.sleep(0.001)
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn("page.html: not written", errors.decode())
        self.assertEqual(set(self.read_json("report.json")["fairness"]["after"]), {"vspring_energy", "greatest_turn", "rms_turn"})
        self.assertIn("nodes", output.decode())
        self.assertEqual(self.files(), ["in.obj", "out.obj", "report.json"])
        self.assertEqual(len(vertex_lines(out.read_text())), 251 * 251)
        self.assertEqual(run("measure", out, "--compare", path, "--html", page).returncode, 0)
        self.assertTrue(page.read_text().endswith("</html>\n"))

    def test_version_and_help(self):
        self.assertRegex(run("--version").stdout.decode(), r"^vspring \d+\.\d+\.\d+\n$")
        text = run("fair", "--help").stdout.decode()
        for option in ("--output", "--constraints", "--fix", "--fix-normals", "--region", "--method", "--step-tolerance",
                       "--max-iterations", "--threads", "--pseudo-normals", "--paper", "--distribution", "--strength", "--report",
                       "--quiet", "--format", "--color", "Example", "Exit status"):
            self.assertIn(option, text)
        self.assertIn("fair", run("--help").stdout.decode())


if __name__ == "__main__":
    support.unittest.main()


class FairBoundary(Case):
    def test_loops_are_faired_between_held_nodes_then_the_surface(self):
        lines = hat().splitlines()
        rim = range(38, 50)  # lines of the outer ring
        held = [37 + k for k in range(0, 12, 3)]
        for k, line in enumerate(lines):
            if k in rim and (k - 1) not in held:
                x, y, z = map(float, line.split()[1:])
                lines[k] = f"v {1.1 * x} {1.1 * y} {z + 0.1}"
        before = self.write("in.obj", "\n".join(lines) + "\n")
        rules = self.write("held.json", json.dumps({"rules": [{"nodes": held, "position": "fixed"}]}))
        result = run("fair", before, "-o", self.folder / "out.obj", "--fair-boundary", "--constraints", rules, "--report",
                     self.folder / "r.json")
        self.assertEqual(result.returncode, 0, result.stderr.decode())
        after = [tuple(map(float, line.split()[1:])) for line in vertex_lines((self.folder / "out.obj").read_text())]
        # Four held nodes of a circle, at even distances: the closed curve through them is that circle.
        for x, y, z in after[37:49]:
            self.assertAlmostEqual(math.hypot(x, y), 1, places=3)
            self.assertAlmostEqual(z, 0, places=3)
        report = self.read_json("r.json")
        self.assertEqual(report["boundary"]["moving_nodes"], 8)
        self.assertEqual(report["fixed_positions"], 4)
        none = run("fair", before, "-o", self.folder / "no.obj", "--fair-boundary", "--constraints", rules, "--max-iterations", "0",
                   "--report", self.folder / "r.json")
        self.assertEqual(none.returncode, 3, none.stderr.decode())
        self.assertIsNone(self.read_json("r.json")["boundary"]["expected_error"])
        # As the paper goes: by as many of its iterations as are allowed.
        paper = run("fair", before, "-o", self.folder / "no.obj", "--fair-boundary", "--constraints", rules, "--paper",
                    "--max-iterations", "3", "--report", self.folder / "r.json")
        self.assertEqual(paper.returncode, 3, paper.stderr.decode())
        self.assertEqual(self.read_json("r.json")["boundary"]["iterations"], 3)
        self.assertIsNone(self.read_json("r.json")["boundary"]["expected_error"])
        for option in ([], ["--constraints", self.write("none.json", '{"rules": []}')]):
            refused = run("fair", before, "-o", self.folder / "no.obj", "--fair-boundary", *option)
            self.assertEqual(refused.returncode, 2)
            self.assertIn("nothing holds", self.assert_one_line(refused))
