"""What `--sharp` does with surfaces."""
import itertools
import math
import random

from support import Case, grid, run, vertex_lines


def roof(x, y):
    """Two planes, which meet at y = 0.5."""
    return -abs(y - 0.5)


def positions(text):
    return [tuple(map(float, line.split()[1:4])) for line in vertex_lines(text)]


def disturbed(text, deviation, disturbs=lambda p: True):
    """An OBJ file with Gaussian noise at some of its nodes."""
    noise = random.Random(5)
    lines = []
    for line in text.splitlines():
        if line.startswith("v ") and disturbs(tuple(map(float, line.split()[1:4]))):
            line = "v " + " ".join(repr(float(word) + noise.gauss(0, deviation)) for word in line.split()[1:4])
        lines.append(line)
    return "\n".join(lines) + "\n"


def cube(cells):
    """Triangles."""
    nodes, faces = {}, []
    for axis, far in itertools.product(range(3), (0, 1)):
        for i, j in itertools.product(range(cells), repeat=2):
            def node(u, v):
                place = [0, 0, 0]
                place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = far * cells, i + u, j + v
                return nodes.setdefault(tuple(place), len(nodes) + 1)
            a, b, c, d = (node(0, 0), node(1, 0), node(1, 1), node(0, 1)) if far else (node(0, 1), node(1, 1), node(1, 0), node(0, 0))
            faces += [(a, b, c), (a, c, d)]
    return "".join("v {} {} {}\n".format(*(x / cells for x in place)) for place in nodes) + "".join("f {} {} {}\n".format(*face) for face in faces)


class Sharp(Case):
    def fair(self, text, *options, status=0, name="in.obj"):
        shape = self.write(name, text)
        result = run("fair", shape, "-o", self.folder / "out.obj", "--report", self.folder / "r.json", *options)
        self.assertEqual(result.returncode, status, result.stderr.decode())
        return result

    def off_roof(self):
        """The furthest node of the result from the two planes."""
        return max(abs(z - roof(x, y)) for x, y, z in positions((self.folder / "out.obj").read_text())) / math.sqrt(2)

    def noisy_roof(self):
        inside = lambda p: 0 < p[0] < 1 and 0 < p[1] < 1 and p[1] != 0.5
        return disturbed(grid(16, roof), 0.005, inside)

    def test_a_roof_keeps_its_ridge(self):
        self.fair(self.noisy_roof(), "--tolerance", "1e-12")
        self.assertGreater(self.off_roof(), 0.02)
        result = self.fair(self.noisy_roof(), "--sharp", "60", "--tolerance", "1e-12")
        self.assertLess(self.off_roof(), 1e-9)
        self.assertIn("sharp edges      16 in 1 chain of 1 units in all, 0 corners", result.stdout.decode())
        sharp = self.read_json("r.json")["sharp"]
        self.assertEqual((sharp["angle"], sharp["edges"], sharp["corners"], len(sharp["chains"])), (60, 16, [], 1))
        chain = sharp["chains"][0]
        self.assertEqual((len(chain["nodes"]), chain["closed"], chain["length"]), (17, False, 1))

    def test_its_tangent_planes_may_be_held_on_either_side(self):
        bent = grid(12, lambda x, y: -abs(y - 0.5) - 2 * (y - 0.5) ** 2)
        result = self.fair(bent, "--sharp", "60", "--fix-normals", "boundary")
        self.assertNotIn("warning", result.stderr.decode())
        off = max(abs(z + abs(y - 0.5) + 2 * (y - 0.5) ** 2) for _, y, z in positions((self.folder / "out.obj").read_text()))
        self.assertLess(off, 0.03)
        self.fair(bent, "--fix-normals", "boundary")
        rounded = max(abs(z + abs(y - 0.5) + 2 * (y - 0.5) ** 2) for _, y, z in positions((self.folder / "out.obj").read_text()))
        self.assertGreater(rounded, 0.06)

    def test_a_cube_with_noise_keeps_edges_and_corners(self):
        cells = 12
        true = positions(cube(cells))
        noisy = disturbed(cube(cells), 0.1 / cells)

        def off_edges(places):
            """Nodes of edges and corners from these, root mean square, in edges of the mesh."""
            squares = [sum((x - t) ** 2 for x, t in zip(place, at) if t in (0, 1)) for place, at in zip(places, true)
                       if sum(t in (0, 1) for t in at) > 1]
            return cells * math.sqrt(sum(squares) / len(squares))

        self.assertGreater(off_edges(positions(noisy)), 0.12)
        self.fair(noisy, "--noise", "auto")
        without = off_edges(positions((self.folder / "out.obj").read_text()))
        result = self.fair(noisy, "--noise", "auto", "--sharp", "40")
        off = off_edges(positions((self.folder / "out.obj").read_text()))
        self.assertLess(off, 0.05)
        self.assertGreater(without, 1.3 * off)
        self.assertIn(f"sharp edges      {12 * cells} in 12 chains", result.stdout.decode())
        self.assertEqual(len(self.read_json("r.json")["sharp"]["corners"]), 8)

    def test_chains_may_stay_or_become_fair(self):
        text = disturbed(grid(16, roof), 0.005, lambda p: 0 < p[0] < 1 and 0 < p[1] < 1)
        ridge = [k for k, (_, y, _) in enumerate(positions(grid(16, roof))) if y == 0.5]
        self.fair(text, "--sharp", "60")
        before, after = positions(text), positions((self.folder / "out.obj").read_text())
        self.assertEqual([before[k] for k in ridge], [after[k] for k in ridge])
        self.fair(text, "--sharp", "60", "--sharp-curves", "fit", "--tolerance", "1e-12")
        self.assertLess(self.off_roof(), 1e-8)

    def test_a_fit_to_points_keeps_them(self):
        shape = self.write("in.obj", grid(12, roof))
        points = self.write("points.xyz", "".join(
            f"{x / 40} {y / 40} {roof(x / 40, y / 40) + 0.1 * math.sin(math.pi * x / 40) * math.sin(2 * math.pi * y / 40) ** 2}\n"
            for x in range(41) for y in range(41)))
        for options, low, high in (((), 0.02, 1), (("--sharp", "60"), 0, 0.01)):
            result = run("fit", shape, "--points", points, "-o", self.folder / "out.obj", "--smoothing-length", "0.05", *options)
            self.assertEqual(result.returncode, 0, result.stderr.decode())
            ridge = [z for _, y, z in positions((self.folder / "out.obj").read_text()) if abs(y - 0.5) < 0.02]
            self.assertTrue(low <= max(map(abs, ridge)) <= high, (options, max(map(abs, ridge))))

    def test_what_has_no_effect_is_said(self):
        self.assertIn("no edge turns by more", self.fair(grid(8), "--sharp", "170").stderr.decode())
        self.assertIn("--sharp-curves", self.fair(grid(8), "--sharp-curves", "hold").stderr.decode())

    def test_bad_input_is_refused_with_the_reason(self):
        shape = self.write("in.obj", grid(8, roof))
        for angle in ("0", "180", "nan", "steep"):
            result = run("fair", shape, "-o", self.folder / "out.obj", "--sharp", angle)
            self.assertEqual(result.returncode, 1)
            self.assertIn("less than 180", result.stderr.decode())
        points = self.write("p.xyz", "0 0 0\n1 1 0\n0.5 0.5 0\n")
        result = run("fit", shape, "--points", points, "-o", self.folder / "out.obj", "--weight", "1", "--sharp", "60", "--sharp-curves", "fit")
        self.assertEqual(result.returncode, 1, result.stderr.decode())
        self.assertIn("scattered points do not say", result.stderr.decode())


if __name__ == "__main__":
    import unittest
    unittest.main()
