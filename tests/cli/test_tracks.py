"""Curves in degrees: GPX, and tables with latitudes and longitudes."""
import math
import random
import re
import unittest
import xml.etree.ElementTree as ElementTree

from support import Case, run

NAMESPACE = "{http://www.topografix.com/GPX/1/1}"
# Of a minute of latitude, roughly; enough to draw tracks.
METRES = 111_200


def track(count, noise, seed=1):
    """Places along an arc of a kilometre, as (latitude, longitude), the inner ones disturbed by so many metres."""
    generator = random.Random(seed)
    places = []
    for k in range(count):
        angle = 2 * k / (count - 1)
        east, north = 500 * math.cos(angle), 500 * math.sin(angle)
        if 0 < k < count - 1:
            east, north = east + noise * generator.uniform(-1, 1), north + noise * generator.uniform(-1, 1)
        places.append((47.4 + north / METRES, 8.5 + east / METRES / math.cos(math.radians(47.4))))
    return places


def gpx(places):
    points = "".join(f'<trkpt lat="{a:.7f}" lon="{b:.7f}">\n<ele>{400 + k}</ele><time>2024-01-01T00:{k // 60:02}:{k % 60:02}Z</time>\n</trkpt>\n'
                     for k, (a, b) in enumerate(places))
    return f'<?xml version="1.0"?>\n<gpx version="1.1" creator="test" xmlns="{NAMESPACE[1:-1]}"><trk><name>run</name><trkseg>\n{points}</trkseg></trk></gpx>\n'


def places_of(path):
    return [(float(point.get("lat")), float(point.get("lon"))) for point in ElementTree.parse(path).iter(NAMESPACE + "trkpt")]


def apart(a, b):
    return math.hypot((a[0] - b[0]) * METRES, (a[1] - b[1]) * METRES * math.cos(math.radians(a[0])))


class Tracks(Case):
    def curve(self, path, output, *options, status=0):
        result = run("curve", path, "-o", self.folder / output, *options)
        self.assertEqual(result.returncode, status, result.stderr.decode())
        return result

    def test_a_track_stays_within_metres_and_keeps_all_else(self):
        path = self.write("in.gpx", gpx(track(100, 2)))
        places = places_of(path)
        said = self.curve(path, "out.gpx", "--within", "3", "--report", self.folder / "r.json").stdout.decode()
        self.assertRegex(said, r"note: latitudes and longitudes are projected onto a plane; units are metres, x east and y north of 47\.\d{6}, 8\.\d{6}")
        after = places_of(self.folder / "out.gpx")
        distances = [apart(a, b) for a, b in zip(places, after)]
        self.assertEqual((distances[0], distances[-1]), (0, 0))
        self.assertGreater(max(distances), 1.5)
        self.assertLess(max(distances), 3.02)
        figures = self.read_json("r.json")
        self.assertAlmostEqual(figures["local_plane"]["latitude"], 47.4, 2)
        self.assertLess(figures["points"]["distance"]["after"]["greatest"], 3.0001)
        without = lambda name: re.sub(r'(lat|lon)="[\d.]+"', "", (self.folder / name).read_text())
        self.assertEqual(without("in.gpx"), without("out.gpx"))
        # What is read again is as fair as what was written.
        run("measure", self.folder / "out.gpx", "--quiet", "--report", self.folder / "m.json")
        self.assertEqual(self.read_json("m.json")["figures"]["inflections"], figures["fairness"]["after"]["inflections"])

    def test_elevations_alone_are_smoothed(self):
        path = self.write("in.gpx", gpx(track(100, 2)).replace("<ele>401<", "<ele>403<").replace("<ele>450<", "<ele>448.50<"))
        said = self.curve(path, "out.gpx", "--columns", "lon,lat,ele", "--move", "ele", "--within", "4").stdout.decode()
        self.assertIn("moved            ele alone", said)
        before, after = path.read_text(), (self.folder / "out.gpx").read_text()
        elevations = [float(text) for text in re.findall("<ele>(.*?)</ele>", after)]
        for k, elevation in enumerate(elevations):
            self.assertLessEqual(abs(elevation - 400 - k), 4 + 2)
        differences = [b - a for a, b in zip(elevations, elevations[1:])]
        self.assertLess(max(differences) - min(differences), 1)
        blank = lambda text: re.sub("<ele>.*?</ele>", "", text)
        self.assertEqual(blank(before), blank(after))
        # Without its column there is none to move.
        self.assertIn(b"'ele' is no coordinate", self.curve(path, "out.gpx", "--move", "ele", "--within", "4", status=1).stderr)

    def test_new_points_are_a_new_track(self):
        self.curve(self.write("in.gpx", gpx(track(100, 2))), "out.gpx", "--within", "3", "--spacing", "5")
        after = places_of(self.folder / "out.gpx")
        self.assertAlmostEqual(len(after), 205, delta=5)
        self.assertLess(max(abs(apart(a, b) - 5) for a, b in zip(after, after[1:])), 0.3)
        text = (self.folder / "out.gpx").read_text()
        self.assertNotIn("<time>", text)

    def test_tables_say_degrees_by_their_columns(self):
        places = track(60, 2)
        table = "time,ele,Lat,Lon\n" + "".join(f"{k},{400 + k},{a!r},{b!r}\n" for k, (a, b) in enumerate(places))
        path = self.write("in.csv", table)
        said = self.curve(path, "out.csv", "--within", "3").stdout.decode()
        self.assertIn("note: latitudes and longitudes are projected onto a plane", said)
        found = (self.folder / "out.csv").read_text()
        self.curve(path, "out.csv", "--within", "3", "--columns", "lon,lat")
        self.assertEqual((self.folder / "out.csv").read_text(), found)
        rows = [line.split(",") for line in found.splitlines()[1:]]
        self.assertLess(max(apart(place, (float(row[2]), float(row[3]))) for place, row in zip(places, rows)), 3.02)
        self.assertEqual([row[:2] for row in rows], [[str(k), str(400 + k)] for k in range(60)])
        self.curve(path, "out.gpx", "--within", "3")
        for place, row in zip(places_of(self.folder / "out.gpx"), rows):
            self.assertLess(apart(place, (float(row[2]), float(row[3]))), 1e-6)

    def test_two_tracks_are_compared_in_one_plane(self):
        places = track(100, 2)
        path = self.write("in.gpx", gpx(places))
        other = self.write("other.gpx", gpx([(a + 10 / METRES, b) for a, b in places[:60]]))
        run("measure", other, "--compare", path, "--quiet", "--report", self.folder / "r.json")
        self.assertAlmostEqual(self.read_json("r.json")["distance"]["to_other"]["greatest"], 10, delta=1)
        self.assertEqual(run("fit", path, "--points", other, "-o", self.folder / "out.gpx", "--weight", "1e-5").returncode, 0)
        moved = max(apart(a, b) for a, b in zip(places, places_of(self.folder / "out.gpx")))
        self.assertTrue(3 < moved < 30, moved)
        plain = self.write("plain.csv", "x,y\n1,2\n3,4\n5,7\n")
        for command in (("measure", path, "--compare", plain), ("fit", path, "--points", plain, "-o", self.folder / "no.gpx", "--weight", "1"),
                        ("fit", plain, "--points", path, "-o", self.folder / "no.csv", "--weight", "1")):
            done = run(*command)
            self.assertEqual(done.returncode, 2)
            self.assertRegex(self.assert_one_line(done), "in.gpx: it gives latitudes and longitudes, and .*plain.csv does not; give both")

    def test_standard_input_and_errors(self):
        text = gpx(track(50, 1))
        done = run("curve", "-", "-o", "-", "--within", "2", "--quiet", stdin=text.encode())
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertEqual(done.stdout, run("curve", "-", "-o", "-", "--within", "2", "--quiet", "--format", "gpx", stdin=text.encode()).stdout)
        for broken, line in ((text[:-20], r"in\.gpx:\d+: .* cut off"), (text.replace("</trkpt>", "", 1), r"in\.gpx:\d+: .*repair the")):
            done = self.curve(self.write("in.gpx", broken), "out.gpx", status=2)
            self.assertRegex(self.assert_one_line(done), line)
        self.assertEqual(self.files(), ["in.gpx"])

    def test_what_is_read_is_what_another_reader_of_xml_reads(self):
        """Documents that are broken at random: what both take has as many points, and comes out as it came in."""
        generator = random.Random(7)
        whole = gpx(track(4, 1)).replace("<trkseg>", "<!-- c --><trkseg>").replace("</name>", " &amp; <![CDATA[<b>]]></name>")
        pieces = ["<", ">", "/", "\"", "'", "=", " ", "<a>", "</a>", "<a/>", "<!--", "-->", "<![CDATA[", "]]>", "<?x", "?>", "\n", "lat=\"1\"", "x"]
        taken = 0
        for _ in range(200):
            text = whole
            for _ in range(generator.choice((1, 1, 2))):
                at = generator.randrange(len(text))
                text = text[:at] + generator.choice(pieces) + text[at + generator.choice((0, 0, 1, 5)):]
            try:
                points = sum(element.tag.split("}")[-1] == "trkpt" for element in ElementTree.fromstring(text).iter())
            except ElementTree.ParseError:
                points = None
            done = run("curve", "-", "-o", "-", "--max-iterations", "0", "--quiet", "--format", "gpx", "--report", self.folder / "r.json",
                       stdin=text.encode())
            if done.returncode == 2:
                self.assert_one_line(done)
                continue
            with self.subTest(text):
                if points is None:
                    # XML is broken there too, but no tag is.
                    self.assertRegex(text, r"&(?!amp;)|\]\]>|--|<\?")
                    continue
                self.assertEqual((done.stdout.decode(), self.read_json("r.json")["nodes"]), (text, points))
                taken += 1
        self.assertGreater(taken, 30)


if __name__ == "__main__":
    unittest.main()
