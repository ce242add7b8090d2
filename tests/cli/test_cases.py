"""Small inputs that were once not finished, or finished wrongly, each as users typed it. What comes out is measured here, by arithmetic
of the tests' own; docs/notes/cases.md tells what is difficult in each. Those in cases/ came as files, the others are made here."""
import collections
import itertools
import math
import pathlib
import random
import unittest

from polylines import curvatures, distances, extremes, places_on, root_mean_square, sign_changes, turns
from support import Case, parsed, run

FILES = pathlib.Path(__file__).parent / "cases"


def curve(file, options, *, columns=None, count=None, outliers=(), **claims):
    """count: of rows that come out, where they are not those that came. outliers: rows that are to be left out. Claims:

    within: no row is further from the curve, and no place of it further from the polyline of the rows
    rms: so far are rows from the curve, in the root mean square
    extremes, inflections: so many are left at most, of curvature, as far as they stand out
    turning: all turns together, in degrees, at most
    radius: the least, at least"""
    return file, options, columns, count, outliers, claims


CURVES = [
    curve("closed.csv", "--closed --within 0.00560743", within=0.00560743, extremes=8, inflections=0, turning=360),
    curve("arc.csv", "--within 0.201311", within=0.201311, extremes=0, inflections=0, turning=60),
    curve("wave.csv", "--rms 0.0501438", rms=0.0501438, extremes=12, inflections=5, turning=250),
    curve("space-uneven.csv", "--within 0.0446959", within=0.0446959, extremes=3, turning=70),
    curve("wave-2.csv", "--smoothing-length 0.203076", within=0.16, inflections=20, turning=180),
    curve("circle-in-space.csv", "--weight 3.27", within=0.05, turning=900),
    curve("track.csv", "--within 8", within=8, extremes=4, inflections=2, turning=180),
    curve("track.csv", "--within auto", within=8, extremes=8, inflections=2, turning=180),
    curve("track.csv", "--rms 3", rms=3, extremes=8, inflections=2, turning=180),
    curve("track.csv", "--rms auto", rms=2.2, extremes=12, inflections=4, turning=180),
    curve("track.csv", "--smoothing-length 15", within=8, extremes=35, inflections=12, turning=200),
    curve("track.csv", "--weight 0.01", within=8, extremes=55, inflections=40, turning=400),
    curve("out-and-back.csv", "--within 1.5 --spacing 5", count=209, within=1.5, extremes=8, inflections=4, turning=400),
    curve("cusp.csv", "--within 0.05", within=0.05, extremes=8, inflections=5, turning=600),
    curve("turn-135.csv", "--within 1.5", within=1.5, extremes=4, inflections=3, turning=220),
    curve("turn-90.csv", "--within 1.5 --spacing 5", count=81, within=1.5, extremes=3, inflections=2, turning=140),
    curve("space.csv", "--rms auto", rms=0.0813, extremes=8, turning=260),
    curve("spike.csv", "--within 1.5 --resample 400 --outliers 0.01", count=400, outliers=(151,),
          within=1.5, extremes=6, inflections=3, turning=460),
    curve("reversed-rows.csv", "--rms 0.5", rms=0.5, extremes=5, inflections=2, turning=360),
    curve("reversed-rows.csv", "--within 1.5", within=1.5, extremes=5, inflections=2, turning=360),
    curve("doubled-stop.csv", "--rms 0.5", rms=0.5, extremes=5, inflections=2, turning=360),
    curve("doubled-stop.csv", "--within 1.5", within=1.5, extremes=5, inflections=2, turning=360),
    curve("stop.csv", "--within 1.5", within=1.5, extremes=5, inflections=2, turning=360),
    curve("road.csv", "--within 0.3", columns="Easting,Northing", within=0.3, extremes=3, inflections=1, turning=110, radius=9),
    curve("road.csv", "--within 0.3 --resample 139", columns="Easting,Northing", count=139,
          within=0.3, extremes=3, inflections=1, turning=110, radius=9),
    curve("aerofoil.dat", "--rms 0.0002", rms=0.0002, extremes=2, inflections=0, turning=215),
    curve("bad-station.csv", "--within 12 --outliers 0.05", columns="x_mm,y_mm", outliers=(8,),
          within=12, extremes=4, inflections=0, turning=66),
    curve("profile.csv", "--rms 1.1 --outliers 0.01", columns="dist_m,ele_m", outliers=(151, 290),
          rms=1.1, extremes=6, inflections=5, turning=80),
]


def rows_of(path, columns):
    """The places in a table, and what else its rows hold. columns: names of those that are places, where they are not all or x, y and z."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    rows = [line.split() if path.suffix == ".dat" else line.split(";" if ";" in line else ",") for line in lines]
    first = rows.pop(0)
    names = first if path.suffix == ".csv" else ["x", "y"]
    places = [k for k, name in enumerate(names) if name in (columns or "x,y,z").split(",")] or range(len(names))
    return ([tuple(float(row[k]) for k in places) for row in rows], [[word for k, word in enumerate(row) if k not in places] for row in rows])


class Curves(Case):
    def check(self, file, options, columns, count, outliers, claims):
        words = [*options.split(), *(("--columns", columns) if columns else ())]
        out = self.folder / f"out{pathlib.Path(file).suffix}"
        done = run("curve", FILES / file, "-o", out, "--report", self.folder / "r.json", "--quiet", *words)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        before, carried = rows_of(FILES / file, columns)
        after, carried_on = rows_of(out, columns)
        self.assertEqual(len(after), count or len(before))
        if "--closed" in words:
            before, after = before + before[:1], after + after[:1]
        else:
            self.assertEqual((after[0], after[-1]), (before[0], before[-1]), "ends are held")
        if not {"--resample", "--spacing"} & set(words):
            self.assertEqual(carried_on, carried)
        self.assertTrue(all(math.isfinite(x) for node in after for x in node))
        self.assertGreater(min(map(math.dist, after, after[1:])), 0, "no edge has vanished")

        counted = [row for k, row in enumerate(before) if k not in outliers]
        off = distances(counted[:-1] if "--closed" in words else counted, after)
        astray = distances(places_on(after), counted)
        rms = root_mean_square(off)
        bends = curvatures(after)
        if "within" in claims:
            self.assertLessEqual(max(off), claims["within"])
            self.assertLessEqual(max(astray), claims["within"])
        if "rms" in claims:
            self.assertLess(rms, 1.001 * claims["rms"])
            self.assertGreater(rms, 0.95 * claims["rms"])
        if "extremes" in claims:
            self.assertLessEqual(extremes(bends), claims["extremes"])
        if "inflections" in claims:
            self.assertLessEqual(sign_changes(bends), claims["inflections"])
        if "radius" in claims:
            self.assertGreater(1 / max(map(abs, bends)), claims["radius"])
        angles = [abs(math.degrees(turn)) for turn in turns(after)]
        self.assertLess(math.fsum(angles), claims["turning"])
        self.assertGreater(math.fsum(abs(math.degrees(turn)) for turn in turns(before)), 1.2 * claims["turning"], "rows as they came would not do")

        # The report tells of the file that was written.
        report = self.read_json("r.json")
        points = report["points"]
        self.assertEqual((report["outcome"], points["outlying_points"]), ("converged", list(outliers)))
        self.assertAlmostEqual(points["distance"]["after"]["greatest"] / max(off), 1, 6)
        self.assertAlmostEqual(points["distance"]["after"]["rms"] / rms, 1, 6)
        # That one looks at other places, and takes rows in their order along the curve.
        self.assertAlmostEqual(points["shape"]["greatest"] / max(astray), 1, delta=0.1)
        self.assertAlmostEqual(report["fairness"]["after"]["greatest_turn"], max(angles), 5)

    def test_each_is_finished_near_its_rows_and_fair(self):
        for row in CURVES:
            with self.subTest(row[0], options=row[1]):
                self.check(*row)


def voxels(inside, reach):
    """The sides between unit voxels that are inside and those that are not, as OBJ; inside: of the middle of one."""
    numbers, faces = {}, []
    span = range(-reach, reach)
    cells = {cell for cell in itertools.product(span, repeat=3) if inside(*(c + 0.5 for c in cell))}
    for cell, axis, side in itertools.product(sorted(cells), range(3), (0, 1)):
        beyond = list(cell)
        beyond[axis] += 2 * side - 1
        if tuple(beyond) in cells:
            continue
        corners = []
        for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)) if side else ((0, 0), (0, 1), (1, 1), (1, 0)):
            corner = list(cell)
            corner[axis] += side
            corner[(axis + 1) % 3] += u
            corner[(axis + 2) % 3] += v
            corners.append(numbers.setdefault(tuple(corner), len(numbers) + 1))
        faces.append(corners)
    return as_obj(numbers, faces)


def staircase(inside, reach):
    """What marching tetrahedra make of a mask: triangles half way between neighbours of which one is inside, as OBJ."""
    numbers, faces = {}, []
    middle = lambda a, b: tuple((x + y) / 2 for x, y in zip(a, b))
    for cell in itertools.product(range(-reach, reach), repeat=3):
        for way in itertools.permutations(range(3)):
            corners = [cell]
            for axis in way:
                corners.append(tuple(c + (k == axis) for k, c in enumerate(corners[-1])))
            within = [inside(*corner) for corner in corners]
            ours, others = ([c for c, has in zip(corners, within) if has == side] for side in (True, False))
            ring = [middle(a, b) for a in ours for b in others]
            if len(ours) == 2 == len(others):
                ring = [ring[k] for k in (0, 1, 3, 2)]
            for k in range(1, len(ring) - 1):
                face = [ring[0], ring[k], ring[k + 1]]
                outwards = [math.fsum(x) / len(others) - math.fsum(y) / len(ours) for x, y in zip(zip(*others), zip(*ours))]
                if math.fsum(x * y for x, y in zip(area_vector(face), outwards)) < 0:
                    face.reverse()
                faces.append([numbers.setdefault(node, len(numbers) + 1) for node in face])
    return as_obj(numbers, faces)


def as_obj(nodes, faces):
    return "".join("v {!r} {!r} {!r}\n".format(*node) for node in nodes) + "".join("f " + " ".join(map(str, face)) + "\n" for face in faces)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def area_vector(corners):
    """Twice the area, along the normal."""
    return [math.fsum(parts) for parts in zip(*(cross(a, b) for a, b in zip(corners, corners[1:] + corners[:1])))]


def turns_of(nodes, faces):
    """Of the surface at all edges that two faces share, in degrees."""
    normals = [area_vector([nodes[node] for node in face]) for face in faces]
    sides = {}
    for number, face in enumerate(faces):
        for edge in zip(face, face[1:] + face[:1]):
            sides.setdefault(frozenset(edge), []).append(normals[number])
    pairs = [both for both in sides.values() if len(both) == 2]
    return [math.degrees(math.atan2(math.hypot(*cross(a, b)), math.fsum(x * y for x, y in zip(a, b)))) for a, b in pairs]


class Surfaces(Case):
    def fair(self, text, *options):
        """The run; faces, and places before and after; what was reported."""
        done = run("fair", self.write("in.obj", text), "-o", self.folder / "out.obj", "--report", self.folder / "r.json", "--quiet", *options)
        self.assertIn(done.returncode, (0, 3), done.stderr.decode())
        before, faces = parsed(text)
        after, faces_after = parsed((self.folder / "out.obj").read_text())
        report = self.read_json("r.json")
        self.assertEqual((faces_after, len(after)), (faces, len(before)))
        self.assertTrue(all(math.isfinite(x) for node in after for x in node))
        self.assertEqual(done.returncode == 0, report["outcome"] == "converged")
        self.assertAlmostEqual(report["greatest_move"], max(map(math.dist, before, after)), 9)
        return done, faces, before, after, report

    def assert_rims_stay(self, faces, before, after):
        edges = [frozenset(edge) for face in faces for edge in zip(face, face[1:] + face[:1])]
        once = collections.Counter(edges)
        rim = {node for edge, count in once.items() if count == 1 for node in edge}
        self.assertGreater(len(rim), 0)
        for node in rim:
            self.assertEqual(after[node], before[node])

    def test_a_noisy_band_held_with_the_normals_of_its_rims_is_no_worse_and_says_what_it_is(self):
        done, faces, before, after, report = self.fair((FILES / "band.obj").read_text(), "--fix-normals", "boundary")
        self.assertEqual(b"warning: no equilibrium was found: this is the shape on the way that is bent least" in done.stderr, done.returncode == 3)
        self.assert_rims_stay(faces, before, after)
        now, then = turns_of(after, faces), turns_of(before, faces)
        self.assertLess(root_mean_square(now), root_mean_square(then) / 2)
        self.assertLess(max(now), 90)
        self.assertAlmostEqual(report["fairness"]["after"]["greatest_turn"], max(now), 4)

    def test_a_noisy_tube_is_a_body_without_folds(self):
        done, faces, before, after, report = self.fair((FILES / "tube.obj").read_text())
        self.assertEqual(done.returncode, 0)
        self.assertEqual(report["warning_codes"], ["other-fairness"])
        self.assert_rims_stay(faces, before, after)
        self.assertGreater(max(turns_of(before, faces)), 150)
        self.assertLess(max(turns_of(after, faces)), 75)
        # It is widest in the middle, and as wide all round.
        radii = [[math.hypot(x, y) for x, y, z in after if abs(z - height) < 0.15] for height in (0.4, 1.0, 1.5, 2.0, 2.6)]
        for ring in radii:
            self.assertLess(max(ring), 1.2 * min(ring))
        middles = [math.fsum(ring) / len(ring) for ring in radii]
        self.assertTrue(middles[0] < middles[1] < middles[2] > middles[3] > middles[4], middles)

    def test_a_strip_that_springs_and_points_found_no_balance_for(self):
        done, faces, before, after, report = self.fair((FILES / "strip.obj").read_text(), "--weight", "9.02")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(report["warning_codes"], ["other-fairness"])
        self.assert_rims_stay(faces, before, after)
        now, then = turns_of(after, faces), turns_of(before, faces)
        self.assertLess(root_mean_square(now), 0.75 * root_mean_square(then))
        self.assertLess(max(map(math.dist, before, after)), 0.03)

    def test_steps_of_a_mask_come_off(self):
        ball = lambda x, y, z: math.hypot(x, y, z) < 6
        off = lambda places: root_mean_square([math.hypot(*place) - 6 for place in places])
        # Of what was off, and of the turns, what is left at most.
        for kind, text, options in (("sides of voxels", voxels(ball, 7), {"--within auto": 0.15, "--smoothing-length 1": 0.2}),
                                    ("marching tetrahedra", staircase(ball, 7), {"--noise auto": 0.4, "--smoothing-length 1": 0.4})):
            for option, share in options.items():
                with self.subTest(kind, option=option):
                    done, faces, before, after, report = self.fair(text, *option.split())
                    self.assertEqual((done.returncode, done.stderr), (0, b""))
                    self.assertLess(off(after), share * off(before))
                    self.assertLess(root_mean_square(turns_of(after, faces)), share * root_mean_square(turns_of(before, faces)))
                    self.assertLess(max(map(math.dist, before, after)), math.sqrt(3) / 2 + 0.1)
                    if option.endswith("auto"):
                        self.assertAlmostEqual(report["points"]["estimated_noise"], 1 / math.sqrt(12), 6)

    def test_a_part_that_touches_along_an_edge_does_not_keep_the_rest_from_moving(self):
        ball = lambda x, y, z: math.hypot(x, y, z) < 6
        touches = (5.5, 4.5, 0.5)
        text = voxels(lambda *middle: ball(*middle) or middle == touches, 7)
        done, faces, before, after, report = self.fair(text, "--smoothing-length", "1")
        self.assertEqual((done.returncode, report["warning_codes"]), (0, ["immovable-nodes"]))
        self.assertIn(b"more than two faces share it", done.stderr)
        held = [node for node in before if node[:2] == (5, 4) and 0 <= node[2] <= 1]
        self.assertEqual((len(held), [after[before.index(node)] for node in held]), (2, held))
        self.assertLess(root_mean_square(turns_of(after, faces)), 0.2 * root_mean_square(turns_of(before, faces)))

    def test_normals_of_a_file_agree_across_a_seam_where_they_did(self):
        columns, rows = 24, 12
        lines, places = [], []
        for row, column in itertools.product(range(rows + 1), range(columns + 1)):
            angle, height = 2 * math.pi * (column % columns) / columns, 3 * row / rows
            dent = 0.1 * (math.dist((math.cos(angle), math.sin(angle), height), (1, 0, 1.5)) < 0.6)
            places.append((math.cos(angle), math.sin(angle)))
            lines.append(f"v {(1 - dent) * math.cos(angle):.9f} {(1 - dent) * math.sin(angle):.9f} {height:.9f}")
        lines += [f"vt {column / columns:.5f} {row / rows:.5f}" for row, column in itertools.product(range(rows + 1), range(columns + 1))]
        lines += [f"vn {x:.9f} {y:.9f} 0.000000000" for x, y in places]
        at = lambda row, column: "/".join(3 * [str(1 + row * (columns + 1) + column)])
        lines += [f"f {at(row, column)} {at(row, column + 1)} {at(row + 1, column + 1)} {at(row + 1, column)}"
                  for row, column in itertools.product(range(rows), range(columns))]
        done, _, before, after, _ = self.fair("\n".join(lines) + "\n", "--weld", "0", "--region", "sphere:1,0,1.5,0.8")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        normals = [line for line in (self.folder / "out.obj").read_text().splitlines() if line.startswith("vn ")]
        self.assertEqual(len(normals), len(after))
        for row in range(rows + 1):
            first, last = row * (columns + 1), row * (columns + 1) + columns
            self.assertEqual((after[first], normals[first]), (after[last], normals[last]))
        self.assertLess(min(math.hypot(x, y) for x, y, _ in before), 0.91)
        self.assertLess(max(abs(math.hypot(x, y) - 1) for x, y, _ in after), 1e-4)
        for (x, y), normal in zip(places, normals):
            u, v, w = map(float, normal.split()[1:])
            self.assertGreater(x * u + y * v, math.cos(math.radians(1)))

    def test_a_cap_of_a_coarse_sphere_becomes_the_sphere_without_a_warning(self):
        draw = random.Random(1)
        sides, rings = 48, 24
        nodes = [(0, 0, 1)]
        for ring, side in itertools.product(range(1, rings), range(sides)):
            down, round_ = math.pi * ring / rings, 2 * math.pi * side / sides
            nodes.append((math.sin(down) * math.cos(round_), math.sin(down) * math.sin(round_), math.cos(down)))
        nodes.append((0, 0, -1))
        noisy = [tuple(x + draw.uniform(-0.04, 0.04) for x in node) if math.dist(node, (0, 0, 1)) < 0.65 else node for node in nodes]
        at = lambda ring, side: 2 + (ring - 1) * sides + side % sides
        faces = [(1, at(1, k), at(1, k + 1)) for k in range(sides)] + [(len(nodes), at(rings - 1, k + 1), at(rings - 1, k)) for k in range(sides)]
        faces += [(at(r, k), at(r + 1, k), at(r + 1, k + 1), at(r, k + 1)) for r in range(1, rings - 1) for k in range(sides)]
        done, _, before, after, report = self.fair(as_obj(noisy, faces), "--region", "sphere:0,0,1,0.7")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertLess(report["iterations"], 100)
        self.assertGreater(max(abs(math.hypot(*place) - 1) for place in before), 0.04)
        self.assertLess(max(abs(math.hypot(*place) - 1) for place in after), 1e-5)


if __name__ == "__main__":
    unittest.main()
