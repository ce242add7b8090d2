"""What --picture draws."""
import base64
import math
import os
import shutil
import signal
import subprocess
import time
import xml.etree.ElementTree as xml

import browser
import support
from support import Case, grid, hat, run, sphere
from test_measure import circle

SVG = "{http://www.w3.org/2000/svg}"
NO_DISPLAY = {"DISPLAY": "", "WAYLAND_DISPLAY": ""}
WHITE = (255, 255, 255)
STYLES = {"shaded": "shaded", "wire": "wire", "zebra": "zebra", "mean": "mean-curvature", "gaussian": "gaussian-curvature",
          "deviation": "deviation"}


def changed(first, second):
    """The share of pixels that differ."""
    return sum(max(abs(a - b) for a, b in zip(p, q)) > 12 for p, q in zip(first, second)) / len(first)


def tints(pixels):
    """The colours without how bright they are, in steps of a fifth."""
    return {tuple(round(5 * part / max(p)) for part in p) for p in pixels if max(p) - min(p) > 12}


class Picture(Case):
    def make(self, *arguments, name="out.png", status=(0,), path=None):
        """path: where programs are looked for."""
        result = run(*arguments, "--picture", self.folder / name, "--quiet", environment={**NO_DISPLAY, **({"PATH": str(path)} if path else {})})
        self.assertIn(result.returncode, status, result.stderr.decode())
        return (self.folder / name).read_bytes()

    def svg(self, *arguments, **options):
        """The root and, by style, the panels from left to right."""
        root = xml.fromstring(self.make(*arguments, name="out.svg", **options))
        panels = {}
        for image in root.iter(SVG + "image"):
            png = base64.b64decode(image.get("href").removeprefix("data:image/png;base64,"))
            panels.setdefault(image.get("class"), []).append(browser.pixels_of(png))
        return root, panels


@support.unittest.skipUnless(browser.PROGRAM, "chromium is not installed")
class Surface(Picture):
    def test_all_styles_before_and_after(self):
        arguments = ("fair", self.write("in.obj", grid(10)), "-o", self.folder / "out.obj",
                     "--picture-size", "300", "--picture-style", ",".join(STYLES.values()))
        root, panels = self.svg(*arguments)
        self.assertEqual(list(panels), list(STYLES))
        for style, pair in panels.items():
            self.assertEqual(len(pair), 2)
            self.assertEqual((pair[0].width, pair[0].height), (pair[1].width, pair[1].height))
            self.assertGreater(changed(*pair), 0.02, style)
        shaded = panels["shaded"]
        surface = [k for k, p in enumerate(shaded[1]) if p != WHITE]
        self.assertGreater(len(surface), 0.3 * len(shaded[1]))
        coloured = [style for style in STYLES if style != "wire"]
        for first in coloured:
            for second in coloured[:coloured.index(first)]:
                self.assertGreater(changed([panels[first][1][k] for k in surface], [panels[second][1][k] for k in surface]), 0.4, (first, second))
        self.assertTrue(all(max(p) - min(p) < 12 for p in panels["zebra"][1]))
        # The rim is held, and its corners are the ends of the shape to the left and right: the same scale and place.
        for style in coloured:
            ends = [[edge(k % picture.width for k, p in enumerate(picture) if p != WHITE) for edge in (min, max)] for picture in panels[style]]
            self.assertEqual(*ends, style)
        texts = ["".join(text.itertext()) for text in root.iter(SVG + "text")]
        for wanted in ("before", "after", "Mean curvature × D", "Gaussian curvature × D²"):
            self.assertIn(wanted, texts)
        self.assertEqual(len(list(root.iter(SVG + "linearGradient"))), 3)
        self.assertEqual(sum(text.startswith("≤") for text in texts), 3)
        # PNG is that picture, the legends too.
        picture = browser.pixels_of(self.make(*arguments))
        self.assertEqual((picture.width, picture.height), (int(root.get("width")), int(root.get("height"))))
        for ramp in root.iter(SVG + "rect"):
            if not ramp.get("fill").startswith("url"):
                continue
            x, y, width, height = (float(ramp.get(key)) for key in ("x", "y", "width", "height"))
            along = [picture.around(x + share * width, y + height / 2)[4] for share in (0.02, 0.5, 0.98)]
            self.assertEqual(len(set(along)), 3, along)
        text = next(t for t in root.iter(SVG + "text") if t.text == "before")
        x, y = float(text.get("x")), float(text.get("y"))
        self.assertLess(min(max(p) for k in range(8) for p in picture.around(x + k, y - 4)), 200)

    def test_a_region_fills_the_picture(self):
        path = self.write("in.obj", grid(24, lambda x, y: 0.05 * math.sin(60 * x) if math.hypot(x - 0.3, y - 0.3) < 0.1 else 0))
        options = ("fair", path, "-o", self.folder / "out.obj", "--region", "sphere:0.3,0.3,0,0.12", "--picture-size", "300",
                   "--picture-style", "shaded,deviation")
        _, panels = self.svg(*options)
        for picture in panels["shaded"]:
            self.assertNotIn(WHITE, picture)
        self.assertGreater(changed(*panels["shaded"]), 0.05)
        # The range of colours is that of the part: its middle is coloured, what stayed is not.
        after = panels["deviation"][1]
        tinted = sum(max(p) - min(p) > 25 for p in after) / len(after)
        self.assertTrue(0.05 < tinted < 0.6, tinted)

    def test_a_sphere_has_one_mean_curvature(self):
        path = self.write("in.obj", sphere(20))
        noisy = self.write("noisy.obj", sphere(20, noise=0.01))
        options = ("--picture-style", "mean-curvature", "--picture-size", "120", "--view", "front")
        _, panels = self.svg("measure", path, *options)
        (picture,) = panels["mean"]
        self.assertAlmostEqual(sum(p != WHITE for p in picture) / len(picture), math.pi / 4 / 1.04 ** 2, delta=0.02)
        inside = lambda picture: [p for k, p in enumerate(picture) if math.hypot(
            k % picture.width / picture.width - 0.5, k // picture.width / picture.height - 0.5) < 0.45]
        self.assertLessEqual(len(tints(inside(picture))), 3, tints(inside(picture)))
        _, panels = self.svg("measure", noisy, *options)
        self.assertGreater(len(tints(inside(panels["mean"][0]))), 8)

    def test_polygons_of_all_kinds_from_another_side(self):
        mixed = "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\nv 4 2 0\nv 4 0 0\nf 1 2 3 4 5\nf 3 6 4\nf 2 7 6 3\n"
        path = self.write("in.obj", mixed)
        _, panels = self.svg("measure", path, "--picture-style", "shaded", "--view", "top", "--picture-size", "200")
        (top,) = panels["shaded"]
        # A rectangle of 4 by 2, all covered but for the margin.
        self.assertAlmostEqual(top.height / top.width, 0.5, delta=0.02)
        self.assertAlmostEqual(sum(p != WHITE for p in top) / len(top), 1 / 1.04 ** 2, delta=0.03)
        _, panels = self.svg("measure", "--picture-size", "200", "--view", "0,-1,1", "--picture-style", "shaded", path)
        (aslant,) = panels["shaded"]
        self.assertAlmostEqual(aslant.height / aslant.width, 0.5 ** 1.5, delta=0.02)

    def test_points_that_a_surface_is_fitted_to(self):
        shape = self.write("flat.obj", grid(6, lambda x, y: 0))
        points = self.write("points.xyz", "".join(f"{x / 9} {y / 9} 0.1\n" for x in range(10) for y in range(10)) + "0.5 0.5 99\n")
        _, panels = self.svg("fit", shape, "--points", points, "-o", self.folder / "out.obj", "--weight", "0", "--picture-size", "400",
                             "--picture-style", "shaded,wire,zebra", "--view", "top")
        dots = {style: [sum(p[0] > p[2] + 90 for p in picture) for picture in pair] for style, pair in panels.items()}
        self.assertEqual((dots["wire"], dots["zebra"]), ([0, 0], [0, 0]))
        self.assertGreater(min(dots["shaded"]), 60, dots)
        _, panels = self.svg("measure", shape, "--picture-style", "shaded", "--picture-size", "400")
        self.assertEqual(sum(p[0] > p[2] + 90 for p in panels["shaded"][0]), 0)

    def test_default(self):
        _, panels = self.svg("measure", self.write("in.obj", hat()), "--compare", self.write("other.obj", grid(4)), "--picture-size", "200")
        self.assertEqual({style: len(pair) for style, pair in panels.items()}, {"shaded": 2, "zebra": 2})


class Curve(Picture):
    def test_vectors_need_no_browser(self):
        path = self.write("in.csv", circle(30))
        result = run("curve", path, "-o", self.folder / "out.csv", "--picture", self.folder / "a.svg", environment={"PATH": "/nonexistent"})
        self.assertEqual(result.returncode, 0, result.stderr)
        root = xml.fromstring((self.folder / "a.svg").read_bytes())
        self.assertEqual([g.get("id") for g in root.iter(SVG + "g") if g.get("id")], ["before", "curve", "nodes", "plot"])
        texts = [text.text for text in root.iter(SVG + "text")]
        for wanted in ("before", "after", "curvature comb", "arc length, units of the input; curvature is positive to the left", "curvature, 1/unit"):
            self.assertIn(wanted, texts)

    def test_the_part_that_moved(self):
        line = "".join(f"{k} {0.2 * (k % 2)} 0\n" for k in range(201))
        options = ("curve", self.write("in.xyz", line), "-o", self.folder / "out.xyz")
        self.make(*options, "--region", "sphere:45,0,0,6.5", name="part.svg")
        self.make(*options, name="all.svg")
        nodes = {name: (self.folder / f"{name}.svg").read_text().count("<circle") for name in ("part", "all")}
        # Nodes 38 to 52 and their lines, 1.6 times as far, with one more at either end.
        self.assertEqual(nodes["all"], 201)
        self.assertAlmostEqual(nodes["part"], 1.6 * 14, delta=3)

    @support.unittest.skipUnless(shutil.which("chromium") and shutil.which("chromium-headless-shell"), "one of two browsers is not installed")
    def test_chromium_draws_what_its_headless_shell_does(self):
        path = self.write("in.csv", circle(30))
        first = browser.pixels_of(self.make("measure", path, "--picture-size", "300"))
        alone = self.folder / "bin"
        alone.mkdir()
        (alone / "chromium").write_text(f'#!/bin/sh\nPATH={os.environ["PATH"]} exec {shutil.which("chromium")} "$@"\n')
        (alone / "chromium").chmod(0o755)
        second = browser.pixels_of(self.make("measure", path, "--picture-size", "300", path=alone))
        self.assertEqual((first.width, first.height), (second.width, second.height))
        self.assertLess(changed(first, second), 0.01)

    @support.unittest.skipUnless(browser.PROGRAM, "chromium is not installed")
    def test_png(self):
        path = self.write("in.csv", circle(30))
        self.make("measure", path, name="out.svg")
        root = xml.fromstring((self.folder / "out.svg").read_bytes())
        picture = browser.pixels_of(self.make("measure", path, "--picture-size", "300"))
        self.assertEqual(picture.width, 300)
        self.assertAlmostEqual(picture.height, 300 * float(root.get("height")) / float(root.get("width")), delta=1)
        self.assertGreater(sum(p[0] > p[2] + 60 for p in picture), 200)  # the comb
        self.assertGreater(sum(p[2] > p[0] + 40 for p in picture), 200)  # curve and plot


class Refusals(Picture):
    def setUp(self):
        super().setUp()
        self.surface, self.curve = self.write("in.obj", hat()), self.write("in.csv", circle())
        self.fake = self.folder / "bin"
        self.fake.mkdir()

    def refused(self, status, word, *arguments, path=None):
        before = self.files()
        result = run(*arguments, environment={"PATH": str(path)} if path else None)
        self.assertEqual(result.returncode, status, (arguments, result.stderr))
        self.assertIn(word, self.assert_one_line(result))
        self.assertEqual(self.files(), before)

    def browser(self, script):
        """A program in the place of the browser, by the name that is looked for first."""
        program = self.fake / "chromium-headless-shell"
        program.write_text("#!/bin/sh\n" + script)
        program.chmod(0o755)
        return f"{self.fake}:{os.environ['PATH']}"

    def test_names_and_options(self):
        out = self.folder / "out.obj"
        for command in (("measure", self.surface), ("fair", self.surface, "-o", out), ("curve", self.curve, "-o", out)):
            self.refused(1, ".png", *command, "--picture", self.folder / "a.gif")
            self.refused(1, "--picture-size", *command, "--picture", self.folder / "a.png", "--picture-size", "5")
        measure = ("measure", self.surface, "--picture", self.folder / "a.png")
        path = self.browser("exit 1")
        self.refused(1, "zebra", *measure, "--picture-style", "zebras")
        self.refused(1, "--compare", *measure, "--picture-style", "deviation", path=path)
        self.refused(2, "faces", *measure, "--picture-style", "deviation", "--compare", self.write("other.obj", grid(3)), path=path)
        for view in ("above", "1,2", "0,0,0", "nan,0,1", "1,0,0,2,0,0", "1,0,0,0,0,0"):
            self.refused(1, "--view", *measure, "--view=" + view)
        self.refused(1, "surfaces", "measure", self.curve, "--picture", self.folder / "a.svg", "--view", "top")
        self.refused(1, "--picture", "fair", self.surface, "-o", self.folder / "a.svg", "--picture", self.folder / "a.svg", path=path)

    def test_without_a_browser(self):
        self.refused(2, "apt install chromium", "fair", self.surface, "-o", self.folder / "out.obj", "--picture", self.folder / "a.svg", path=self.fake)
        self.refused(2, "apt install chromium", "curve", self.curve, "-o", self.folder / "out.csv", "--picture", self.folder / "a.png", path=self.fake)

    def test_a_browser_that_fails(self):
        for script in ("exit 1", "echo hello", "echo 'picture:*;'"):
            self.refused(2, "chromium", "measure", self.surface, "--picture", self.folder / "a.png", path=self.browser(script))
        self.refused(2, "too dim", "measure", self.surface, "--picture", self.folder / "a.png",
                     path=self.browser(f"echo '<html>error:{base64.b64encode(b'too dim').decode()};</html>'"))

    def test_a_place_that_cannot_be_written(self):
        path = self.browser(f"echo '<html>picture:{base64.b64encode(b'picture').decode()};</html>'")
        self.refused(2, "no", "measure", self.surface, "--picture", self.folder / "no" / "a.png", path=path)
        # Before anything is faired or written.
        self.refused(2, "no", "fair", self.surface, "-o", self.folder / "out.obj", "--picture", self.folder / "no" / "a.png", path=path)
        result = run("measure", self.surface, "--picture", self.folder / "a.png", environment={"PATH": path})
        self.assertEqual((result.returncode, (self.folder / "a.png").read_bytes()), (0, b"picture"))

    def test_interrupted_while_it_is_drawn(self):
        mark = self.folder / "begun"
        path = self.browser(f"echo $$ >{mark}.part\nmv {mark}.part {mark}\nexec sleep 60")
        for command, status in ((("fair", self.surface, "-o", self.folder / "out.obj"), 130), (("measure", self.surface), 130)):
            process = subprocess.Popen([support.PROGRAM, *map(str, command), "--picture", self.folder / "a.png", "--quiet"],
                                       env={**os.environ, "PATH": path, "TMPDIR": str(self.fake)}, stderr=subprocess.PIPE)
            while not mark.exists():
                self.assertIsNone(process.poll(), "it ended before the browser began")
                time.sleep(0.05)
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate(timeout=30)
            self.assertEqual(process.returncode, status, errors)
            self.assertFalse((self.folder / "a.png").exists())
            self.assertRaises(ProcessLookupError, os.kill, int(mark.read_text()), 0)
            self.assertEqual([entry.name for entry in self.fake.iterdir()], ["chromium-headless-shell"])
            mark.unlink()
        self.assertTrue((self.folder / "out.obj").exists())


if __name__ == "__main__":
    support.unittest.main()
