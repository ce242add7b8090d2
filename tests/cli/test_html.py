"""What --html writes: the file itself, and the page as a browser shows it."""
import base64
import json
import math
import re
import struct

import browser
import support
from support import Case, OCTAHEDRON, grid, hat, run, sphere, vertex_lines


def arc(count=60, noise=0.01):
    return "x,y\n" + "".join(
        f"{(1 + noise * math.sin(7 * k)) * math.cos(2 * k / count):.17g},{(1 + noise * math.sin(7 * k)) * math.sin(2 * k / count):.17g}\n"
        for k in range(count))


def flat(x, y):
    return 0


def nodes_of(text):
    return [tuple(map(float, line.split()[1:])) for line in vertex_lines(text)]


def block(page, name):
    """A JSON block of the page, NaN and infinities refused."""
    text = re.search(f'<script type="application/json" id="{name}">(.*?)</script>', page, re.DOTALL).group(1)
    return json.loads(text, parse_constant=lambda constant: (_ for _ in ()).throw(ValueError(constant)))


class Html(Case):
    def make(self, *arguments, status=(0, 3), **options):
        result = run(*arguments, "--html", self.folder / "page.html", "--report", self.folder / "report.json", "--quiet", **options)
        self.assertIn(result.returncode, status, result.stderr.decode())
        return (self.folder / "page.html").read_text()


class File(Html):
    def test_carries_the_report(self):
        surface = self.write("in.obj", hat())
        curve = self.write("in.csv", arc())
        for arguments in (("fair", surface, "-o", self.folder / "out.obj"), ("curve", curve, "-o", self.folder / "out.csv"),
                          ("measure", surface), ("measure", curve), ("measure", self.folder / "out.obj", "--compare", surface)):
            page = self.make(*arguments)
            self.assertEqual(block(page, "figures"), self.read_json("report.json"), arguments)
            self.assertNotRegex(page, "@[A-Z]+@")

    def test_needs_nothing_from_outside(self):
        page = self.make("fair", self.write("in.obj", hat()), "-o", self.folder / "out.obj")
        self.assertEqual(set(re.findall(r"https?://[^'\"\s<)]*", page)), {"http://www.w3.org/2000/svg"})
        self.assertEqual(re.findall(r"<(?:link|img|script|iframe)[^>]*?(?:src|href)=\"(?!data:)[^\"]*", page), [])
        self.assertEqual(re.findall(r"^\s*(?:import|export) .*|@import.*", page, re.MULTILINE), [])
        self.assertIn("default-src 'none'", page)

    def test_figures_are_those_of_the_report(self):
        page = self.make("fair", self.write("in.obj", grid(12)), "-o", self.folder / "out.obj", "--region", "sphere:0.5,0.5,0,0.4")
        rows = {row["key"]: row["values"] for row in block(page, "scene")["figures"]}
        fairness = self.read_json("report.json")["fairness"]
        for key in ("vspring_energy", "greatest_turn", "rms_turn"):
            self.assertEqual(rows[key], [fairness["before"][key], fairness["after"][key]], key)

    def scene(self, text, *options):
        return block(self.make("fair", self.write("in.obj", text), "-o", self.folder / "out.obj", *options), "scene")

    def test_what_moved_is_seen_first(self):
        """The middle of the part, its extents and from where it is seen; places are shares of the side of the box."""
        scene = self.scene(grid(20, lambda x, y: 0.03 * math.sin(40 * x)), "--region", "sphere:0.3,0.6,0,0.12")
        x, y, _ = scene["part"]["middle"]
        self.assertAlmostEqual(x, 0.3 - 0.5, delta=0.02)
        self.assertAlmostEqual(y, 0.6 - 0.5, delta=0.02)
        # Nodes up to 0.1 away move, and faces at them are another 0.05 wide.
        for extent in scene["part"]["extents"]:
            self.assertAlmostEqual(extent, 1.6 * 0.3, delta=0.05)
        self.assertGreater(scene["view"][2][2], 0.99)
        turned = re.sub(r"f (\d+) (\d+) (\d+)", r"f \3 \2 \1", grid(20, lambda x, y: 0.03 * math.sin(40 * x)))
        self.assertLess(self.scene(turned, "--region", "sphere:0.3,0.6,0,0.12")["view"][2][2], -0.99)
        given = self.scene(turned, "--region", "sphere:0.3,0.6,0,0.12", "--view", "right")
        self.assertEqual(given["view"][2], [1, 0, 0])
        self.assertAlmostEqual(given["part"]["middle"][1], 0.1, delta=0.02)

    def test_a_part_is_seen_from_outside(self):
        """Also where faces are turned inwards: the rest would hide it."""
        text = sphere(16, radius=1.0, noise=0.002)
        for text in (text, re.sub(r"f (\d+) (\d+) (\d+)", r"f \3 \2 \1", text)):
            self.assertGreater(self.scene(text, "--region", "sphere:0,-1,0,0.3")["view"][2][1] * -1, 0.99)

    def test_what_goes_round_is_seen_as_by_default(self):
        sides, rings = 12, 30
        text = "".join(f"v {0.5 * math.cos(6.2831853 * k / sides)} {0.5 * math.sin(6.2831853 * k / sides)} {0.2 * ring + 0.02 * (ring % 2)}\n"
                       for ring in range(rings) for k in range(sides))
        text += "".join(f"f {sides * r + k + 1} {sides * r + (k + 1) % sides + 1} {sides * (r + 1) + (k + 1) % sides + 1} {sides * (r + 1) + k + 1}\n"
                        for r in range(rings - 1) for k in range(sides))
        region = self.write("ring.json", json.dumps(list(range(10 * sides, 14 * sides))))
        scene = self.scene(text, "--region", region)
        self.assertIsNotNone(scene["part"])
        self.assertAlmostEqual(scene["view"][2][1] / scene["view"][2][0], -2)
        self.assertAlmostEqual(scene["view"][2][2] / scene["view"][2][0], 1.5)

    def test_all_is_seen_where_most_of_it_moved(self):
        scene = self.scene(grid(10))
        self.assertIsNone(scene["part"])
        self.assertAlmostEqual(scene["view"][2][1] / scene["view"][2][0], -2)
        self.assertIsNone(block(self.make("measure", self.write("in.obj", hat())), "scene")["part"])

    def test_the_part_of_a_curve(self):
        path = self.write("in.csv", arc(200, 0.001))
        scene = block(self.make("curve", path, "-o", self.folder / "out.csv", "--region", "sphere:1,0,0,0.1"), "scene")
        self.assertLess(max(scene["part"]["extents"]), 0.4)
        self.assertIsNone(block(self.make("curve", path, "-o", self.folder / "out.csv"), "scene")["part"])

    def test_a_curve_in_space_is_seen_in_its_plane_where_it_has_one(self):
        for height, planar in ((lambda x, y: 0.25, True), (lambda x, y: 0.5 * x + 0.75 * y, True), (lambda x, y: x * x, False)):
            points = [(math.cos(k / 10), math.sin(k / 10)) for k in range(30)]
            path = self.write("in.csv", "x,y,z\n" + "".join(f"{x!r},{y!r},{height(x, y)!r}\n" for x, y in points))
            scene = block(self.make("measure", path), "scene")
            self.assertEqual(scene["planar"], planar)
            across, up, towards = scene["view"]
            for a, b in ((across, up), (up, towards), (across, towards)):
                self.assertAlmostEqual(sum(x * y for x, y in zip(a, b)), 0)
            if planar:
                depths = [sum(n * p for n, p in zip(towards, (x, y, height(x, y)))) for x, y in points]
                self.assertAlmostEqual(min(depths), max(depths), msg="the plane is looked at from straight above")

    def test_deviation_is_from_the_surface(self):
        """A sphere that is turned deviates by less than its faces from their arcs, though its nodes went far."""
        text, angle, radius = sphere(12, radius=2.0), 0.3, 2.1
        turned = "".join(f"v {radius / 2 * (math.cos(angle) * x - math.sin(angle) * y)!r} {radius / 2 * (math.sin(angle) * x + math.cos(angle) * y)!r} "
                         f"{radius / 2 * z!r}\n" for x, y, z in nodes_of(text))
        path = self.write("turned.obj", turned + "".join(line + "\n" for line in text.splitlines() if line.startswith("f")))
        scene = block(self.make("measure", path, "--compare", self.write("in.obj", text)), "scene")
        for shape in scene["shapes"]:
            raw = base64.b64decode(shape["deviation"])
            values = [value * scene["unit"] for value, in struct.iter_unpack("<e", raw)]
            self.assertGreater(min(values), 0.08)
            self.assertLess(max(values), 0.13)

    def test_size(self):
        """Six megabytes at most for 100,000 nodes before and after; here a hundredth of that."""
        size = 31
        page = self.make("fair", self.write("in.obj", grid(size)), "-o", self.folder / "out.obj", "--max-iterations", "5")
        empty = self.make("fair", self.write("small.obj", grid(2)), "-o", self.folder / "out.obj", "--max-iterations", "5")
        self.assertLess(len(empty), 80_000)
        self.assertLess(len(page) - len(empty), 60 * (size + 1) ** 2)

    def test_no_number_that_is_none(self):
        meshes = {"flat": "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
                  "point": "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n",
                  "huge": "v 0 0 0\nv 1e308 0 0\nv 0 1e308 1e308\nf 1 2 3\n",
                  "loose": OCTAHEDRON + "v 1e300 0 0\n"}
        for name, text in meshes.items():
            page = self.make("measure", self.write(f"{name}.obj", text))
            block(page, "scene")
            block(page, "figures")
        for name, text in {"point": "1,1\n1,1\n1,1\n", "pair": "0,0\n1,0\n", "huge": "0,0\n1e308,0\n1e308,1e308\n"}.items():
            block(self.make("measure", self.write(f"{name}.csv", text)), "scene")

    def test_names_do_not_break_the_page(self):
        path = self.write("a<b>@SCENE@&.obj", hat())
        page = self.make("measure", path)
        self.assertIn("a&lt;b>@SCENE@&amp;.obj</h1>", page)
        self.assertTrue(block(page, "figures")["shape"].endswith("a<b>@SCENE@&.obj"))

    def test_whole_or_not_at_all(self):
        path = self.write("in.obj", hat())
        result = run("measure", path, "--html", self.folder / "no" / "page.html")
        self.assertEqual(result.returncode, 2)
        self.assert_one_line(result)
        self.assertEqual(run("measure", self.folder / "none.obj", "--html", self.folder / "page.html").returncode, 2)
        self.assertEqual(self.files(), ["in.obj"])

    def test_standard_output(self):
        result = run("measure", self.write("in.obj", hat()), "--html", "-")
        self.assertTrue(result.stdout.startswith(b"<!DOCTYPE html>"))
        self.assertTrue(result.stdout.endswith(b"</html>\n"))
        self.assertIn("bending energy", result.stderr.decode())

    def test_a_place_that_is_taken(self):
        surface = self.write("in.obj", hat())
        curve = self.write("in.csv", arc())
        out = self.folder / "out.obj"
        for arguments in (("fair", surface, "-o", "-", "--html", "-"), ("fair", surface, "-o", out, "--html", out),
                          ("fair", surface, "-o", out, "--html", surface), ("measure", surface, "--report", "-", "--html", "-"),
                          ("measure", surface, "--compare", curve, "--html", curve), ("measure", surface, "--html", surface),
                          ("curve", curve, "-o", self.folder / "o.csv", "--picture", self.folder / "p.svg", "--html", self.folder / "p.svg")):
            result = run(*arguments)
            self.assertEqual(result.returncode, 1, arguments)
            self.assertIn("--html", self.assert_one_line(result))
        self.assertEqual(self.files(), ["in.csv", "in.obj"])
        self.assertEqual(surface.read_text(), hat())

    def test_help(self):
        for command in ("fair", "curve", "measure"):
            self.assertIn("--html", run(command, "--help").stdout.decode())


@support.unittest.skipUnless(browser.PROGRAM, "chromium is not installed")
class Page(Html):
    @classmethod
    def setUpClass(cls):
        cls.shared = browser.Browser()
        cls.addClassCleanup(cls.shared.close)

    def show(self, *arguments, **options):
        self.text = self.make(*arguments, **options)
        self.browser = self.shared
        self.browser.open(self.folder / "page.html")
        return self.browser

    def tearDown(self):
        if hasattr(self, "browser"):
            self.assertEqual(self.browser.faults, [])
            asked = [address for address in self.browser.requests if not address.startswith("data:")]
            self.assertEqual(asked, [(self.folder / "page.html").as_uri()])
            self.assertEqual(self.browser.evaluate("document.getElementById('trouble').textContent"), "")
            self.assertNotRegex(self.browser.evaluate("document.body.outerHTML.replace(/<script.*?<\\/script>/gs, '')"), "NaN|Infinity|undefined")

    def table(self):
        """Key → the numbers that the table shows."""
        rows = self.browser.evaluate("[...document.querySelectorAll('#table tbody tr')].map("
                                     "(row) => [row.dataset.key, ...[...row.querySelectorAll('.number')].map((c) => c.textContent)])")
        return {key: [float(text.replace("−", "-")) for text in values if text] for key, *values in rows}

    def changed(self, before, after):
        """The share of pixels that differ."""
        self.assertEqual(len(before), len(after))
        return sum(max(abs(a - b) for a, b in zip(p, q)) > 12 for p, q in zip(before, after)) / len(before)

    def show_mode(self, mode):
        self.browser.click(f"label:has([value={mode}])")
        return self.browser.pixels("#canvas")

    def test_a_surface(self):
        page = self.show("fair", self.write("in.obj", grid(24)), "-o", self.folder / "out.obj", "--max-iterations", "200")
        modes = ("shaded", "wire", "zebra", "mean", "gaussian", "deviation")
        after = {mode: self.show_mode(mode) for mode in modes}
        bare = after["shaded"][0]
        surface = [k for k, p in enumerate(after["shaded"]) if p != bare]
        self.assertGreater(len(surface), 0.15 * len(after["shaded"]))
        for first in modes:
            for second in modes[:modes.index(first)]:
                share = self.changed([after[first][k] for k in surface], [after[second][k] for k in surface])
                self.assertGreater(share, 0.5, (first, second))
        # Reflection lines are black and white; colours are colours; the ground stays.
        grey = lambda p: max(p) - min(p) < 12
        self.assertTrue(all(grey(p) for p in after["zebra"]))
        self.assertGreater(sum(max(p) < 60 for p in after["zebra"]), 1000)
        self.assertGreater(sum(min(p) > 150 and p != bare for p in after["zebra"]), 1000)
        for mode in ("mean", "gaussian", "deviation"):
            self.assertGreater(sum(not grey(p) for p in after[mode]) / len(after[mode]), 0.03, mode)
        self.assertTrue(all(pixels[0] == bare for pixels in after.values()))
        # The shape before is another one.
        page.click("label:has([name=shape][value='0'])")
        self.assertEqual(page.evaluate("document.querySelector('[name=shape]:checked').value"), "0")
        for mode in modes:
            self.assertGreater(self.changed(after[mode], self.show_mode(mode)), 0.02, mode)

    def place_of(self, nodes, picture):
        """Takes points to where they are in the picture of a shape of these nodes: all of it is in view, from its side."""
        rows = block(self.text, "scene")["view"]
        low, high = ([end(part) for part in zip(*nodes)] for end in (min, max))
        side = max(b - a for a, b in zip(low, high))
        along = lambda row, point: sum(r * (p - (a + b) / 2) / side for r, p, a, b in zip(row, point, low, high))
        across, up = (2.2 * max(abs(along(row, node)) for node in nodes) for row in rows[:2])
        scale = min(picture.width / across, picture.height / up)
        return lambda point: (picture.width / 2 + scale * along(rows[0], point), picture.height / 2 - scale * along(rows[1], point))

    def check_wire(self, text, seen_count):
        """Shows a mesh with and without wire. Edges are where they belong and those behind faces are not seen."""
        self.show("measure", self.write("in.obj", text))
        shaded, wire = self.show_mode("shaded"), self.show_mode("wire")
        bare = shaded[0]
        nodes = nodes_of(text)
        faces = [[nodes[int(part) - 1] for part in line.split()[1:]] for line in text.splitlines() if line.startswith("f ")]
        place = self.place_of(nodes, wire)

        def towards_the_eye(face):
            (ax, ay), (bx, by), (cx, cy) = map(place, face)
            return (bx - ax) * (cy - ay) - (cx - ax) * (by - ay) < 0

        edges = lambda some: {tuple(sorted((face[k - 1], face[k]))) for face in some for k in range(3)}
        seen = list(filter(towards_the_eye, faces))
        self.assertEqual(len(seen), seen_count)
        for a, b in edges(faces):
            ink = [min(map(max, wire.around(*place([p + k / 40 * (q - p) for p, q in zip(a, b)])))) for k in range(41)]
            if (a, b) in edges(seen):
                self.assertLess(max(ink), 200, (a, b))
            else:
                self.assertGreater(min(ink[12], ink[20], ink[28]), 200, (a, b))
        # Lines are a pixel wide all along, but for those that nearly cover each other.
        length = sum(math.dist(place(a), place(b)) for a, b in edges(seen))
        black = min(map(max, wire))
        drawn = sum((max(bare) - max(p)) / (max(bare) - black) for p in wire)
        self.assertGreater(drawn, 0.75 * length)
        # Between edges faces are as the ground.
        for face in seen:
            self.assertEqual(set(wire.around(*place([sum(parts) / 3 for parts in zip(*face)]))), {bare})
        # Every pixel of the shape is another one; beside it there is nothing.
        changed = [k for k, (p, q) in enumerate(zip(shaded, wire)) if p != q]
        surface = [k for k, p in enumerate(shaded) if p != bare]
        self.assertGreater(len(surface), 0.15 * len(shaded))
        self.assertTrue(set(surface) <= set(changed))
        for k in set(changed) - set(surface):
            self.assertNotEqual(set(shaded.around(k % shaded.width, k // shaded.width)), {bare})
        return shaded

    def test_wire_shows_every_edge(self):
        shaded = self.check_wire(grid(6, flat), 72)
        self.assertGreater(min(map(max, shaded)), 140)  # no edge is seen there

    def test_wire_hides_what_is_behind(self):
        self.check_wire(OCTAHEDRON, 4)

    def test_colours_follow_gaussian_curvature(self):
        """Violet where it is negative, orange where it is positive."""
        height = lambda x, y: 1.2 * ((x - 0.5) ** 3 + (y - 0.5) ** 2 / 2)
        text = grid(24, height)
        self.show("measure", self.write("in.obj", text))
        picture = self.show_mode("gaussian")
        place = self.place_of(nodes_of(text), picture)
        for x in (0.1, 0.2, 0.3, 0.7, 0.8, 0.9):
            for y in (0.5, 0.8):
                red, _, blue = picture.around(*place((x, y, height(x, y))))[4]
                self.assertGreater((red - blue) * (x - 0.5), 0, (x, y))

    def test_a_plane_mirrors_straight_lines(self):
        self.show("measure", self.write("in.obj", grid(6, flat)))
        picture = self.show_mode("zebra")
        column, row = map(int, self.place_of(nodes_of(grid(6, flat)), picture)((0.5, 0.5, 0)))
        rows = [[picture[(row + k) * picture.width + column + i] for i in range(-80, 81)] for k in (-20, 0, 20)]
        for other in rows[1:]:
            self.assertLess(max(abs(p[0] - q[0]) for p, q in zip(rows[0], other)), 30)
        self.assertGreater(max(map(max, rows[0])), min(map(max, rows[0])) + 120)

    def test_a_plane_is_of_one_colour(self):
        self.show("measure", self.write("in.obj", grid(6, flat)))
        colours = []
        for mode in ("mean", "gaussian"):
            picture = self.show_mode(mode)
            place = self.place_of(nodes_of(grid(6, flat)), picture)
            inside = {picture.around(*place((x / 10, y / 10, 0)))[4] for x in range(1, 7) for y in range(3, 10)}
            self.assertEqual(len(inside), 1, mode)
            colours += inside
        self.assertEqual(len(set(colours)), 2)

    def test_both_themes(self):
        page = self.show("fair", self.write("in.obj", grid(8)), "-o", self.folder / "out.obj")
        self.addCleanup(page.theme, "")
        grounds = {}
        for mode in ("shaded", "wire"):
            self.show_mode(mode)
            for theme in ("light", "dark"):
                page.theme(theme)
                panel = page.evaluate("getComputedStyle(document.getElementById('stage')).backgroundColor")
                picture = page.pixels("#canvas")
                self.assertEqual(f"rgb({', '.join(map(str, picture[0]))})", panel)
                # The shape stands out from the ground.
                grounds[theme] = max(picture[0])
                self.assertGreater(max(abs(max(p) - max(picture[0])) for p in picture), 120, (mode, theme))
        self.assertGreater(grounds["light"], grounds["dark"] + 150)

    def test_the_legend(self):
        page = self.show("fair", self.write("in.obj", grid(10)), "-o", self.folder / "out.obj")
        hidden = lambda: page.evaluate("document.getElementById('legend').hidden")
        self.assertTrue(hidden())
        self.show_mode("gaussian")
        self.assertFalse(hidden())
        marks = lambda: [float(text.strip("≤≥ ").replace("−", "-")) for text in
                         page.evaluate("[...document.querySelectorAll('.marks span')].map((s) => s.textContent)")]
        low, middle, high = marks()
        self.assertEqual((low, middle), (-high, 0))
        page.evaluate("(() => { const s = document.getElementById('spread'); s.value = 1; s.dispatchEvent(new Event('input')); })()")
        page.settle()
        self.assertAlmostEqual(marks()[2] / high, 2, delta=0.02)
        self.show_mode("wire")
        self.assertTrue(hidden())

    def test_turning_moving_and_zooming(self):
        page = self.show("measure", self.write("in.obj", grid(16)))
        home = page.pixels("#canvas")
        last = home
        for act in (lambda: page.drag("#canvas", 80, 30), lambda: page.wheel("#canvas", -300),
                    lambda: page.evaluate("document.getElementById('canvas').focus()") or page.key("ArrowLeft"),
                    lambda: page.key("-", "-"), lambda: page.key("ArrowUp")):
            act()
            now = page.pixels("#canvas")
            self.assertGreater(self.changed(last, now), 0.01)
            last = now
        page.key("0", "0")
        self.assertLess(self.changed(home, page.pixels("#canvas")), 0.001)

    def test_all_and_what_moved(self):
        page = self.show("fair", self.write("in.obj", grid(16, lambda x, y: 0.03 * math.sin(40 * x))), "-o", self.folder / "out.obj",
                         "--region", "sphere:0.5,0.5,0,0.15")
        press = lambda text: page.evaluate(f"[...document.querySelectorAll('#controls button')].find((b) => b.textContent === '{text}').click()") or page.settle()
        part = page.pixels("#canvas")
        press("Show all")
        whole = page.pixels("#canvas")
        # The part fills the view from top to bottom, the whole has the ground around it.
        middle = lambda picture: [picture[k * picture.width + picture.width // 2] for k in range(1, picture.height - 1)]
        self.assertNotIn(whole[0], middle(part))
        self.assertIn(whole[0], middle(whole))
        press("Show what moved")
        self.assertLess(self.changed(part, page.pixels("#canvas")), 0.001)

    def test_keys_alone(self):
        page = self.show("fair", self.write("in.obj", grid(8)), "-o", self.folder / "out.obj")
        chosen = lambda name: page.evaluate(f"document.querySelector('[name={name}]:checked').value")
        page.evaluate("document.querySelector('[name=mode]:checked').focus()")
        page.key("ArrowRight")
        self.assertEqual(chosen("mode"), "wire")
        page.evaluate("document.getElementById('canvas').focus()")
        self.assertEqual(chosen("shape"), "1")
        page.key(" ", " ")
        self.assertEqual(chosen("shape"), "0")
        # Every control says what it is.
        nodes = page.call("Accessibility.getFullAXTree")["nodes"]
        controls = [node for node in nodes if not node["ignored"] and node["role"]["value"] in ("radio", "slider", "button", "checkbox")]
        self.assertGreaterEqual(len(controls), 9)
        for node in controls:
            self.assertTrue(node["name"]["value"], node)

    def test_the_table_shows_the_report(self):
        path = self.write("in.obj", hat())
        self.show("measure", path, "--compare", self.write("other.obj", grid(6)))
        report = self.read_json("report.json")
        table = self.table()
        self.assertEqual(set(table), set(report["figures"]))
        for key, values in table.items():
            self.assertEqual(len(values), 2)
            self.assertTrue(math.isclose(values[0], report["figures"][key], rel_tol=1e-3, abs_tol=1e-300), key)
            self.assertTrue(math.isclose(values[1], report["compared_with"]["figures"][key], rel_tol=1e-3, abs_tol=1e-300), key)
        # Nodes of another mesh have no deviation node by node, be they as many.
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('[value=deviation]').length"), 0)

    def test_the_table_of_a_run_is_what_measuring_its_files_gives(self):
        path, out = self.write("in.obj", grid(12)), self.folder / "out.obj"
        self.show("fair", path, "-o", out)
        fairness = self.read_json("report.json")["fairness"]
        table = self.table()
        self.assertEqual(run("measure", out, "--compare", path, "--fix", "boundary", "--quiet",
                             "--report", self.folder / "measured.json").returncode, 0)
        measured = self.read_json("measured.json")
        columns = [measured["compared_with"]["figures"], measured["figures"]]
        # How noisy a shape seems to be is no figure of a run.
        self.assertEqual(set(table) | {"noise", "noise_in_edges", "within_auto"}, set(columns[0]))
        self.assertLessEqual(set(fairness["before"]), set(table))
        for key, shown in table.items():
            for value, column, figures in zip(shown, ("before", "after"), columns, strict=True):
                self.assertTrue(math.isclose(value, figures[key], rel_tol=1e-3, abs_tol=1e-300), (key, column))
                if key in fairness[column]:
                    self.assertTrue(math.isclose(value, fairness[column][key], rel_tol=1e-3, abs_tol=1e-300), (key, column))

    def test_distances_of_points(self):
        shape, points = self.write("in.obj", grid(6, lambda x, y: 0)), self.write("points.xyz", "0.5 0.5 0.25\n0.4 0.6 0.25\n")
        page = self.show("fit", shape, "--points", points, "-o", self.folder / "out.obj", "--weight", "0")
        self.assertIn("2 points: root mean square distance 0.25 → 0.25, greatest 0.25 → 0.25",
                      page.evaluate("document.getElementById('summary').textContent"))
        dots = sum(p[0] > p[2] + 90 for p in self.show_mode("shaded"))
        self.assertGreater(dots, 4)
        self.assertEqual(sum(p[0] > p[2] + 90 for p in self.show_mode("wire")), 0)

    def test_charts_of_a_surface(self):
        self.show("fair", self.write("in.obj", grid(12)), "-o", self.folder / "out.obj")
        self.assertEqual(self.browser.evaluate("[...document.querySelectorAll('#charts figure')].map((f) => f.id)"),
                         ["turns", "mean-curvature", "history"])
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('#turns path').length"), 2)

    def test_a_curve(self):
        page = self.show("curve", self.write("in.csv", arc()), "-o", self.folder / "out.csv", "--fix-normals", "boundary")
        self.assertEqual(page.evaluate("document.querySelectorAll('#curvature path').length"), 2)
        both = page.pixels("#canvas")
        page.click("#behind")
        after = page.pixels("#canvas")
        self.assertGreater(self.changed(both, after), 0.005)
        page.click("label:has([name=shape][value='0'])")
        self.assertGreater(self.changed(after, page.pixels("#canvas")), 0.005)
        fairness = self.read_json("report.json")["fairness"]
        for key, name in (("vspring_energy", "V-Spring energy"), ("rms_turn", "rms turn")):
            for value, column in zip(self.table()[key], ("before", "after")):
                self.assertTrue(math.isclose(value, fairness[column][key], rel_tol=1e-3), name)

    def test_a_point(self):
        self.show("measure", self.write("in.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n"))

    def test_a_line(self):
        self.show("measure", self.write("in.csv", "0,0\n1,0\n"))

    def test_a_plane(self):
        self.show("measure", self.write("in.obj", grid(2, flat)))


if __name__ == "__main__":
    support.unittest.main()
