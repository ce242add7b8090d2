"""What is said of options: those without effect, those that the library's advice comes to, and their numbers."""
import json
import math
import pathlib
import re
import unittest

import support
from support import EXAMPLES, OCTAHEDRON, Case, grid, hat, run

ROOT = pathlib.Path(__file__).parents[2]
ARC = "".join(f"{math.cos(k / 10)},{math.sin(k / 10)}\n" for k in range(20))
RING = "".join(f"{math.cos(a)},{math.sin(a)}\n" for a in (math.tau * k / 24 for k in range(24)))
HELIX = "".join(f"{math.cos(k / 5)} {math.sin(k / 5)} {k / 20}\n" for k in range(40))


class Idle(Case):
    """Each option where it has no effect, and where it has one."""

    def setUp(self):
        super().setUp()
        held = json.dumps({"rules": [{"nodes": [0, 8, 16], "position": "fixed"}]})
        ball = json.dumps({"rules": [{"nodes": [0, 20, 40, 60], "position": "fixed"}]})
        rim = json.dumps({"rules": [{"nodes": [0, 8, 72, 80], "position": "fixed"}]})
        for name, text in {"grid.obj": grid(8), "rim.json": rim, "ball.obj": support.sphere(5), "arc.csv": ARC, "ring.csv": RING, "helix.xyz": HELIX,
                           "held.json": held, "ball.json": ball, "points.xyz": HELIX, "above.xyz": "0.3 0.4 0.3\n0.5 0.5 0.2\n",
                           "facing.xyz": "".join(f"0.{k} 0.5 0.1 0 0 1\n" for k in range(1, 9))}.items():
            self.write(name, text)

    def said(self, line):
        words = [str(self.folder / word) if re.search(r"\w\.\w{3,4}$", word) else word for word in line.split()]
        output = [] if words[0] == "measure" else ["-o", str(self.folder / ("out" + (".csv" if "curve" in words else ".obj")))]
        done = run(*words, *output)
        self.assertIn(done.returncode, (0, 3), (line, done.stderr.decode()))
        return done.returncode, re.findall(r"warning: (--[\w-]+) has no effect here: (.+)", done.stderr.decode())

    def test_options_without_effect_are_told(self):
        curve = "curve arc.csv"
        ring = "curve ring.csv --closed --constraints held.json"
        ball = "fair ball.obj --constraints ball.json"
        fit = "fit grid.obj --points above.xyz --weight 0.1"
        rim = "fair grid.obj --fair-boundary --constraints rim.json"
        inside = " --region sphere:0.5,0.5,0,0.3"
        # The option, a command where it is idle, one where it is not, and a word of the reason.
        for option, idle, used, word in (
            ("--step-tolerance 1e-3", "fair grid.obj", "fair grid.obj --method sweep", "sweep and multigrid"),
            ("--step-tolerance 1e-3", "fair grid.obj --weight 0.1", "fair grid.obj --paper", "multigrid"),
            ("--step-tolerance 1e-3", fit, fit + " --method sweep", "--method sweep"),
            ("--step-tolerance 1e-3", curve, curve + " --method multigrid", "multigrid"),
            ("--levels 2", "fair grid.obj", "fair grid.obj --method multigrid", "--method multigrid"),
            ("--levels 2", curve + " --method sweep", curve + " --method multigrid", "--method multigrid"),
            ("--pre-smoothing 2", "fair grid.obj", "fair grid.obj --method multigrid --levels 2", "--method multigrid"),
            ("--pre-smoothing 2", "fair grid.obj --method multigrid --levels 1", "fair grid.obj --method multigrid --levels 2", "one level"),
            ("--tolerance 1e-4", "fair grid.obj --method multigrid", "fair grid.obj", "--method equilibrium"),
            ("--tolerance 1e-4", curve + " --paper", curve + " --paper --method equilibrium", "--method equilibrium"),
            ("--tolerance 1e-4", fit + " --paper", fit, "--method equilibrium"),
            ("--tolerance 1e-4", rim + " --paper", rim + " --method sweep", "--method equilibrium"),
            ("--springs sphere", "fair grid.obj --method sweep", "fair grid.obj", "--method equilibrium"),
            ("--springs edge", "fair grid.obj --weight 0.1", "fair grid.obj", "without points"),
            ("--fair-by bending", "fair grid.obj --method multigrid", "fair grid.obj", "--method equilibrium"),
            ("--fair-by curvature", "fair grid.obj --weight 0.1", "fair grid.obj", "without points"),
            ("--fair-by bending", "fair grid.obj --springs edge", "fair grid.obj --springs sphere", "--springs sphere"),
            ("--fair-by bending", "fair grid.obj --paper --method equilibrium", None, "--springs sphere"),
            ("--fix boundary", ball, "fair grid.obj", "boundary"),
            ("--fix none", "fair grid.obj" + inside, None, "no node moves"),
            ("--fix boundary", ring, curve, "end"),
            ("--fix-normals boundary", ball, "fair grid.obj", "boundary"),
            ("--fix-normals boundary", "fair grid.obj" + inside, "fair grid.obj --region sphere:0,0.5,0,0.3", "boundary"),
            ("--fix-normals boundary", ring, curve, "end"),
            ("--fix-normals boundary", "measure ball.obj", "measure grid.obj", "boundary"),
            ("--refine 5", "fair grid.obj", None, "longer"),
            ("--refine turn:179", "fair grid.obj", None, "turns by more"),
            ("--remesh 5", "fair grid.obj --region sphere:0,0,0,0.05", None, "no face moves"),
            ("--fair-boundary", ball, None, "boundary"),
            ("--fair-boundary", "fair grid.obj" + inside, None, "region"),
            ("--normal-plane principal", curve, "curve helix.xyz", "space"),
            ("--resample-by cosine", curve, curve + " --spacing 0.2", "--resample and --spacing"),
            ("--closed", fit, "fit ring.csv --points points.xyz --weight 0.1 --constraints held.json", "curves"),
            ("--sharp 170", fit, "fit ring.csv --points points.xyz --weight 0.1 --constraints held.json", "no edge turns by more"),
            ("--sharp-curves hold", "fair grid.obj", "fair grid.obj --sharp 10", "no sharp edges"),
            ("--min-radius 2", fit, "fit ring.csv --points points.xyz --weight 0.1 --constraints held.json", "curves"),
            ("--closed", "measure grid.obj", "measure ring.csv", "curves"),
            ("--ignore-point-normals", fit, "fit grid.obj --points facing.xyz --weight 0.1", "no normals"),
            ("--ignore-point-normals", "fit arc.csv --points facing.xyz --weight 0.1", None, "surfaces"),
            ("--view top", "fair grid.obj", "fair grid.obj --html page.html", "--picture and --html"),
            ("--view top", "measure arc.csv", "measure grid.obj --html page.html", "surfaces"),
            ("--picture-style wire", "fair grid.obj --html page.html", None, "--picture"),
            ("--picture-style wire", "fit arc.csv --points points.xyz --weight 0.1", None, "surfaces"),
            ("--picture-size 500", "measure grid.obj", None, "--picture"),
            ("--picture-size 500", curve + " --picture fair.svg", None, "SVG"),
            ("--seed 2", "generate genus", "generate genus --shuffle", "--shuffle"),
            ("--seed 2", "generate plane --jitter 0", "generate plane --jitter 0.1", "--jitter"),
            ("--noise-on-boundary", "generate plane", "generate plane --noise 0.1", "--noise"),
            ("--noise-on-boundary", "generate torus --noise 0.1", None, "no boundary"),
            ("--height 1", "generate annulus --profile flat", "generate annulus --profile cone", "--profile"),
        ):
            with self.subTest(f"{idle} {option}"):
                status, warnings = self.said(idle)
                self.assertEqual(warnings, [], "without the option")
                status_with, warnings = self.said(f"{idle} {option}")
                self.assertEqual([name for name, _ in warnings], option.split()[:1])
                self.assertIn(word, warnings[0][1])
                self.assertEqual(status_with, status)
                if used:
                    self.assertEqual(self.said(f"{used} {option}")[1], [])

    def test_they_are_in_the_report_too(self):
        run("fair", self.folder / "grid.obj", "-o", self.folder / "out.obj", "--levels", "3", "--quiet", "--report", self.folder / "r.json")
        self.assertEqual(self.read_json("r.json")["warnings"], ["--levels has no effect here: it is for --method multigrid"])

    def test_one_option_in_place_of_another(self):
        rules = self.folder / "rim.json"
        path = self.write("flat.obj", grid(8, lambda x, y: 0.1 * x * y))
        done = run("fair", path, "-o", self.folder / "out.obj", "--fair-boundary", "--constraints", rules, "--fix", "boundary",
                   "--method", "sweep", "--tolerance", "1e-3")
        self.assertEqual(re.findall(r"warning: (--[\w-]+) has no effect here: (.*)", done.stderr.decode()),
                         [("--fix", "--fair-boundary takes its place")])


# What the default of an option is in its own words; None where no word stands for it: it depends on the file, or is off.
DEFAULTS = {
    "--fix": "boundary", "--fix-normals": "none", "--method": "equilibrium", "--tolerance": "1e-5", "--step-tolerance": "0.001",
    "--pre-smoothing": "5", "--springs": "sphere", "--fair-by": "curvature", "--continuity": "tangent", "--pseudo-normals": "link", "--normal-plane": "full",
    "--distribution": "smooth", "--strength": "1", "--outliers": "0", "--resample-by": "length", "--color": "auto",
    "--picture-size": "1600", "--picture-style": "shaded,zebra", "--view": "1,-2,1.5,0,0,1",
    **dict.fromkeys(("--region", "--slide", "--symmetry", "--refine", "--remesh", "--weld", "--levels", "--max-iterations", "--threads", "--time-limit", "--format", "--columns",
                     "--point-columns", "--closed", "--order", "--resample", "--spacing", "--curve", "--paper", "--quiet", "--fair-boundary",
                     "--ignore-point-normals", "--min-radius", "--sharp", "--sharp-curves", "--move")),
}
# Where it is another one: a word of the command line, and what is its default then.
OTHER_DISTRIBUTIONS = {"--within": "keep", "--weight": "keep", "curve": "even", "--method": "even"}


class Defaults(Case):
    """Whoever says a default gets what comes without."""

    def options_of(self, command):
        """Those whose help tells a default."""
        entries = re.split(r"\n  (?=-)", run(command, "--help").stdout.decode())
        return [re.search(r"--[\w-]+", entry)[0] for entry in entries if "(default: " in entry]

    def outcome_of(self, line, *words):
        given = [str(self.folder / word) if re.search(r"\w\.[a-z]{3}$", word) else word for word in line.split()]
        out = self.folder / ("out" + pathlib.Path(given[1]).suffix)
        done = run(*given, *words, "--quiet", "-o", out, "--report", self.folder / "report.json")
        self.assertIn(done.returncode, (0, 3), (line, words, done.stderr.decode()))
        report = self.read_json("report.json")
        return done.returncode, report["outcome"], report["iterations"], out.read_bytes()

    def test_to_say_a_default_changes_nothing(self):
        crumpled = "".join(f"{x},{0.01 * (7 * k * k % 11)}\n" for k, x in enumerate(range(30)))
        for name, text in {"grid.obj": grid(8), "tube.obj": support.tube(8, 12, 6), "arc.csv": ARC, "helix.xyz": HELIX, "crumpled.csv": crumpled,
                           "above.xyz": "0.3 0.4 0.3\n0.5 0.5 0.2\n",
                           "beside.xyz": "0.3 0.4 0\n0.5 0.5 0\n"}.items():
            self.write(name, text)
        for line in ("fair grid.obj", "fair tube.obj", "fair grid.obj --method multigrid", "fair grid.obj --within 0.02", "fair grid.obj --weight 9",
                     "curve arc.csv", "curve helix.xyz", "curve crumpled.csv", "curve arc.csv --method multigrid", "curve arc.csv --within 0.01",
                     "curve arc.csv --resample 30", "fit grid.obj --points above.xyz --weight 0.1", "fit arc.csv --points beside.xyz --weight 0.1 --curve"):
            words = line.split()
            plain = self.outcome_of(line)
            for option in self.options_of(words[0]):
                said = DEFAULTS[option]
                if option == "--distribution":
                    said = next((other for word, other in OTHER_DISTRIBUTIONS.items() if word in words and words[0] != "fit"), said)
                    said = "even" if words[1].endswith(".csv") and said == "smooth" else said
                if said is None or option in words or option == "--outliers" and not {"--within", "--weight"} & set(words):
                    continue
                with self.subTest(f"{line} {option} {said}"):
                    self.assertEqual(self.outcome_of(line, option, said), plain)


class Outcomes(Case):
    def test_each_level_tells_its_own(self):
        path = self.write("in.obj", grid(20))
        done = run("fair", path, "-o", self.folder / "out.obj", "--method", "multigrid", "--levels", "3", "--max-iterations", "8",
                   "--step-tolerance", "0.5", "--report", self.folder / "r.json")
        report = self.read_json("r.json")
        self.assertEqual([level["outcome"] for level in report["levels"]], ["iteration-limit", "converged", "converged"])
        self.assertEqual((done.returncode, report["outcome"]), (0, "converged"))
        self.assertEqual(len(report["warnings"]), 1)
        self.assertEqual(report["warning_codes"], ["level-cut-short"])
        self.assertEqual({level["strategy"] for level in report["levels"]}, {"V-cycle"})
        self.assertRegex(report["warnings"][0], r"the coarsest level, of \d+ moving nodes, ended at its limit of 8 iterations.*"
                                                r"allow more iterations \(--max-iterations\)")

    def test_a_limit_that_nobody_gave_is_not_put_down_to_an_option(self):
        path = self.write("in.obj", grid(4))
        for options, words in ((["--step-tolerance", "1e-300"], "the default limit of iterations"),
                               (["--max-iterations", "3"], "limit of iterations (--max-iterations)")):
            done = run("fair", path, "-o", self.folder / "out.obj", "--method", "sweep", *options)
            self.assertEqual(done.returncode, 3)
            self.assertIn(words, done.stdout.decode())


class Words(Case):
    def test_the_library_names_no_options(self):
        for folder in ("src", "include", "bindings"):
            for path in (ROOT / folder).rglob("*.[ch]pp"):
                for line in path.read_text().splitlines():
                    self.assertNotRegex(line.split("//")[0], r'"[^"]*(?<![\w-])--[a-z]', f"{path.name}: the command line adds it")

    def test_all_advice_is_given_somewhere(self):
        given = "".join(path.read_text() for folder in ("src", "cli") for path in (ROOT / folder).rglob("*.cpp") if path.name != "advice.cpp")
        remedies = re.findall(r"^  (\w+),? +///<", (ROOT / "include/vspring/advice.hpp").read_text().partition("};")[0], re.MULTILINE)
        self.assertGreater(len(remedies), 10)
        for remedy in remedies:
            self.assertIn(f"Remedy::{remedy},", given, "no message advises it")

    def test_options_of_advice_exist(self):
        options = re.findall(r'return "(?:\w+ )?(--[\w-]+)', (ROOT / "cli/advice.cpp").read_text())
        self.assertGreater(len(options), 10)
        known = (ROOT / "docs/options.md").read_text()
        for option in options:
            self.assertIn(f"`{option}", known)

    def test_its_advice_comes_with_them(self):
        star = self.write("star.obj", "".join(f"v {math.cos(k)} {math.sin(k)} 0\n" for k in range(6)) + "v 0 0 0\nl 1 7 2\nl 3 7 4\n")
        free = self.write("free.json", json.dumps({"rules": [{"nodes": "all", "position": "free"}]}))
        loose = self.write("loose.json", json.dumps({"rules": [{"nodes": [1], "position": "free"}]}))
        surface, closed = self.write("in.obj", hat()), self.write("closed.obj", OCTAHEDRON)
        arc, ring = self.write("arc.csv", ARC), self.write("ring.csv", RING)
        broken = self.write("nan.obj", hat().replace("v 0 0 1\n", "v 0 0 nan\n"))
        for arguments, words in (
            (("fair", closed), ("by a rule (--constraints)", "let only a region move (--region)", "only take its noise off (--noise auto)")),
            (("fair", surface, "--fix", "none"), ("fix the boundary (--fix boundary)", "by a rule (--constraints)")),
            (("fair", broken), (', hold them by a rule such as {"nodes": [0], "position": "fixed"} (--constraints)', "or let only a region move, one without them (--region)")),
            (("curve", arc, "--fix", "none"), ("fix the ends (--fix boundary)", "let only a region move (--region)")),
            (("curve", ring, "--closed"), ("by a rule (--constraints)", "let only a region move (--region)", "a tolerance to stay within (--within)")),
            (("curve", star, "--constraints", free), ('hold it by a rule such as {"nodes": [6], "position": "fixed"} (--constraints)',)),
        ):
            with self.subTest(arguments):
                done = run(*arguments, "-o", self.folder / ("out" + pathlib.Path(arguments[1]).suffix))
                self.assertIn(done.returncode, (1, 2))
                line = self.assert_one_line(done)
                for part in words:
                    self.assertIn(part, line)
        rim = json.dumps({"rules": [{"nodes": [40], "position": "free"}]})
        done = run("fair", surface, "-o", self.folder / "out.obj", "--constraints", self.write("rim.json", rim))
        self.assertIn("1 boundary node is free and will be drawn in, node 40 first; fix the boundary to hold it (--fix boundary)",
                      done.stderr.decode())

    def test_standard_streams_have_names(self):
        surface = hat().encode()
        for arguments, stdin, words in (
            (("fair", "-", "-o", "-"), b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "standard input: no face in it"),
            (("fair", "-", "-o", "-"), b"v 0 zero 0\n", "standard input:1:"),
            (("fair", "-", "-o", "-"), b"", "standard input: is empty"),
            (("fair", "-", "-o", "-", "--format", "stl"), surface, "standard output: written without"),
            (("fair", "-", "-o", "out.obj", "--scalars", "-"), surface, "standard output: numbers at nodes go to VTP or PLY"),
            (("fair", "-", "-o", "out.obj", "--picture", "-"), surface, "standard output: pictures are PNG or SVG"),
            (("measure", "-", "--compare", EXAMPLES / "wave.csv"), surface, "wave.csv: a curve, and standard input is a surface"),
        ):
            with self.subTest(arguments):
                said = run(*arguments, stdin=stdin).stderr.decode()
                self.assertIn(words, said)
                self.assertNotRegex(said, r"(^|\s)-?:")
        table = run("measure", "-", "--compare", EXAMPLES / "saddle.ply", stdin=surface).stdout.decode()
        self.assertIn("standard input", table)


class Numbers(Case):
    def test_what_is_no_number_for_an_option_is_refused_with_its_range(self):
        path, arc = self.write("in.obj", hat()), self.write("arc.csv", ARC)
        fair, curve, fit = ("fair", path), ("curve", arc), ("fit", path, "--points", path, "--weight", "1")
        plane = ("generate", "plane")
        positive, from_0 = "a number greater than 0", "a number of 0 or more"
        whole = "a whole number from {} to {} is needed"
        for command, option, range_ in (
            (fair, "--tolerance", positive), (fair, "--step-tolerance", positive), (fit, "--tolerance", positive),
            (fit, "--step-tolerance", positive), (fair, "--smoothing-length", positive), (curve, "--spacing", positive),
            (curve, "--min-radius", positive), (curve, "--sharp", "a number of more than 0 and less than 180"), (fair, "--within", positive), (fair, "--rms", positive), (fair, "--noise", positive), (fair, "--weight", from_0),
            (fair, "--strength", "a number from 0 to 1 "), (fair, "--outliers", "a number from 0 to 0.999999"),
            (fair, "--levels", whole.format(1, 64)), (fair, "--pre-smoothing", whole.format(0, 2147483647)),
            (fair, "--max-iterations", whole.format(0, 2147483647)), (fit, "--max-iterations", whole.format(0, 2147483647)),
            (fair, "--threads", whole.format(1, 1024)), (curve, "--resample", whole.format(1, 2147483647)),
            (fair, "--picture-size", whole.format(100, 4000)), (("edit", path), "--port", whole.format(1, 65535)),
            (plane, "--noise", from_0), (plane, "--seed", "a whole number of 0 or more"), (plane, "--columns", "a whole number is needed"),
            (plane, "--width", "a number is needed"), (plane, "--jitter", "a number is needed"),
        ):
            wrong = ["nan", "inf", "1e999", "much"]
            wrong += ["-1"] if "or more" in range_ or "greater" in range_ or " to " in range_ else []
            wrong += ["0"] if "greater" in range_ else []
            wrong += ["2.5", "1e10"] if "whole" in range_ else []
            for value in wrong:
                with self.subTest(f"{command[0]} {option}={value}"):
                    done = run(*command, *(() if command[0] == "edit" else ("-o", self.folder / "out.obj")), f"{option}={value}")
                    self.assertEqual(done.returncode, 1, done.stderr.decode())
                    self.assertIn(range_, self.assert_one_line(done))
        self.assertEqual(self.files(), ["arc.csv", "in.obj"])


if __name__ == "__main__":
    unittest.main()
