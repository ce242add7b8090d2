"""Every command in README.md and docs/ runs, options that they name are options, and links lead somewhere."""
import itertools
import json
import math
import os
import pathlib
import random
import re
import shlex
import shutil
import subprocess
import unittest

import support
from support import PROGRAM, Case, grid, run, vertex_lines
from test_tracks import gpx, track

ROOT = pathlib.Path(__file__).parents[2]
DOCUMENTS = [ROOT / "README.md", ROOT / "examples/README.md", *sorted((ROOT / "docs").glob("*.md"))]
# Notes are a record: their commands may be of earlier versions.
LINKED = [*DOCUMENTS, *sorted((ROOT / "docs/notes").glob("*.md"))]
PROGRAMS = ("vspring ", "build/release/vspring ")
# In a block with commands, these make their files.
HELPERS = ("echo ", "cat ")


def walk():
    """A walk in metres, with a stop and a sharp turn, of a log that is some metres off."""
    noise = random.Random(1)
    places = [(4 * k, 40 * math.sin(k / 12)) for k in range(60)] + [(236, 40 * math.sin(59 / 12))] * 20 + [(236 - 3 * k, 3 * k) for k in range(40)]
    return "x,y\n" + "".join(f"{x + noise.gauss(0, 2):.2f},{y + noise.gauss(0, 2):.2f}\n" for x, y in places)


def outline():
    points = [(math.cos(a) * 2, math.sin(a)) for a in (math.tau * k / 40 for k in range(40))]
    return "".join(f"{x!r},{y!r}\n" for x, y in points)


def rules(**nodes):
    return json.dumps({"rules": [{"nodes": nodes["nodes"], "position": "fixed"}]})


def soup(cells):
    """A hill of quads of which each has its own corners."""
    text = ""
    for i in range(cells):
        for j in range(cells):
            for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                text += f"v {x} {y} {0.1 * x * (cells - x) * y * (cells - y) / cells ** 2}\n"
            text += "f -4 -3 -2 -1\n"
    return text


def marked_roof():
    """Two planes, and a line along the edge at which they meet."""
    text = grid(8, lambda x, y: -abs(y - 0.5))
    ridge = [str(k) for k, line in enumerate(vertex_lines(text), 1) if float(line.split()[2]) == 0.5]
    return text + f"l {' '.join(ridge)}\n"


def voxels(radius):
    """The sides of those whose middles are in a ball."""
    inside = lambda at: sum((x + 0.5) ** 2 for x in at) < radius ** 2
    nodes, faces = {}, []
    for at in itertools.product(range(-radius, radius), repeat=3):
        for axis, side in itertools.product(range(3), (0, 1)):
            beside = [x + (k == axis) * (2 * side - 1) for k, x in enumerate(at)]
            if not inside(at) or inside(beside):
                continue
            corners = [tuple(x + (side if k == axis else (u if k == (axis + 1) % 3 else v)) for k, x in enumerate(at))
                       for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))]
            faces.append([nodes.setdefault(corner, len(nodes) + 1) for corner in (corners if side else corners[::-1])])
    return "".join(f"v {x} {y} {z}\n" for x, y, z in nodes) + "".join(f"f {' '.join(map(str, face))}\n" for face in faces)


# Files that a reader would have: arguments of `vspring generate`, an example, or a text.
STAND_INS = {
    "part.ply": "saddle --columns 12 --rows 12 --noise 0.02",
    "part.off": "saddle --columns 12 --rows 12 --noise 0.02",
    "hull.obj": "annulus --nodes 300",
    "half-hull.obj": "plane --columns 8 --rows 12 --noise 0.02",
    "body.obj": "pipe-blend --cells 4",
    "funnel.obj": "funnel --nodes 300 --noise 0.02",
    "annulus.obj": "annulus --nodes 300",
    # With some nodes in the region of the examples.
    "scan.ply": "cylinder-patch --radius 0.2236 --angle 150 --height 0.1 --columns 40 --rows 8 --noise 0.001",
    "mesh.obj": "cylinder-patch --radius 0.2236 --angle 150 --height 0.1 --columns 30 --rows 6",
    "aerofoil.dat": ROOT / "examples/naca-2412.dat",
    "lines.obj": ROOT / "examples/hull-lines.obj",
    "outline.csv": outline,
    "track.csv": walk,
    "road.csv": lambda: "".join(f"{k},{8 * math.sin(k / 15) + (1 if 44 < k < 56 else 0)}\n" for k in range(100)),
    "profile.csv": lambda: "dist_m,ele_m\n" + "".join(f"{5 * k},{400 + 9 * math.sin(k / 9) + 0.2 * math.cos(37 * k):.2f}\n" for k in range(80)),
    "drawing.csv": lambda: "".join(f"{k},{0.1 * (k % 2)}\n" for k in range(20)) + "".join(f"{20 + 0.1 * (k % 2)},{k}\n" for k in range(20)),
    "track.gpx": lambda: gpx(track(60, 3)),
    "log.csv": lambda: "time,lat,lon\n" + "".join(f"{k},{a!r},{b!r}\n" for k, (a, b) in enumerate(track(60, 3))),
    "cloud.csv": lambda: "".join(sorted(f"{math.sin(7 * k):.3f},{k + 0.01 * math.cos(11 * k):.3f}\n" for k in (j / 40 for j in range(41)))),
    "soup.obj": lambda: soup(8),
    "mask.obj": lambda: voxels(5),
    "rules.json": lambda: rules(nodes="boundary"),
    "held.json": lambda: rules(nodes=[0, 10, 20, 30]),
    "slide.json": lambda: json.dumps({"rules": [{"nodes": "boundary", "normal": "fixed"},
                                                {"nodes": {"region": "box:0,-1,-1,1,1,0.35"},
                                                 "slide": {"plane": {"point": [0, 0, 0.342], "normal": [0, 0, 1]}}}]}),
}
# Where a document speaks of others by these names.
OF_DOCUMENT = {
    "fit.md": {"scan.ply": "cylinder-patch --radius 20 --angle 150 --height 40 --columns 40 --rows 30 --noise 0.08",
               "mesh.obj": "cylinder-patch --radius 20 --angle 150 --height 40 --columns 36 --rows 28"},
    "sharp-edges.md": {"part.ply": "pipe-blend --cells 8 --noise 0.005", "mesh.obj": "pipe-blend --cells 4", "scan.ply": "pipe-blend --cells 8",
                       "hull.obj": marked_roof},
    "curves.md": {"held.json": ROOT / "examples/naca-2412.json"},
}


def blocks(text):
    """Lines of code that stand together, and each piece of code within text."""
    block, fenced = [], False
    for line in text.splitlines():
        if line.startswith("```"):
            fenced = not fenced
        elif fenced or line.startswith("    "):
            block.append(line.strip())
            continue
        elif line:
            yield from ([code] for code in re.findall(r"`([^`]+)`", line))
        if line and block:
            yield block
            block = []
    if block:
        yield block


def commands(text):
    """What a reader can run, block by block."""
    for block in blocks(text):
        if any(line.startswith(PROGRAMS) or "| vspring " in line for line in block):
            yield [line for line in block if line.startswith(PROGRAMS + HELPERS)]


def is_complete(words):
    """Whether it is a command with all that it needs, rather than the name of one, or how to write one."""
    if any(re.fullmatch(r"\[?[A-Z][A-Z.]+\]?|\[.*", word) for word in words):
        return False
    if "--help" in words:
        return True
    least = {"measure": 3, "generate": 3}.get(words[1] if len(words) > 1 else "", 99)
    return "-o" in words or (len(words) >= least and not words[2].startswith("-"))


def prose(text):
    """A document without its code."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    lines = (line for line in text.splitlines() if not line.startswith("    "))
    return "\n".join(re.sub(r"`[^`]*`", lambda code: code[0].strip("`").replace("[", ""), line) for line in lines)


def anchors(text):
    """What links may name in a document: headings as GitHub spells them, and explicit anchors."""
    found = re.findall(r'<a id="([^"]+)">', text)
    seen = {}
    for heading in re.findall(r"^#+ +(.*)$", prose(text), re.MULTILINE):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        slug = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        found.append(f"{slug}-{seen[slug]}" if slug in seen else slug)
        seen[slug] = seen.get(slug, 0) + 1
    return found


def options_of(command):
    return set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", run(*command, "--help").stdout.decode()))


class Docs(Case):
    def make(self, name, document):
        path = self.folder / name
        kind = OF_DOCUMENT.get(document, {}).get(name) or STAND_INS.get(name)
        if kind is None or path.exists():
            return
        if isinstance(kind, str):
            self.assertEqual(run("generate", *kind.split(), "-o", path).returncode, 0, name)
        elif isinstance(kind, pathlib.Path):
            shutil.copy(kind, path)
        else:
            path.write_text(kind())

    def run_line(self, line, document):
        for word in shlex.split(line, comments=True):
            self.make(word, document)
        done = subprocess.run(["bash", "-c", "set -euo pipefail\n" + line], cwd=self.folder, capture_output=True, timeout=60,
                              env={**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"})
        said = done.stderr.decode()
        self.assertEqual(done.returncode, 3 if "status 3" in line else 0, said)
        self.assertNotIn("has no effect", said)
        for option, picture in itertools.pairwise(shlex.split(line, comments=True)):
            if option == "--picture":
                self.assertGreater((self.folder / picture).stat().st_size, 0, picture)

    def test_every_command_runs(self):
        for document in DOCUMENTS:
            self.setUp()
            (self.folder / "examples").symlink_to(ROOT / "examples")
            for place in ("bin", "build/release"):
                (self.folder / place).mkdir(parents=True)
                (self.folder / place / "vspring").symlink_to(PROGRAM)
            for block in commands(document.read_text()):
                for line in block:
                    if line.startswith(PROGRAMS) and not is_complete(shlex.split(line, comments=True)):
                        continue
                    with self.subTest(document=document.name, line=line):
                        self.run_line(line, document.name)

    def test_the_gallery_shows_what_its_commands_draw_for_anybody(self):
        text = (ROOT / "docs/gallery.md").read_text()
        lines = [line for block in commands(text) for line in block]
        pictures = re.findall(r"^!\[.+\]\(pictures/(.+)\)$", text, re.MULTILINE)
        self.assertEqual([picture.removeprefix("gallery-") for picture in pictures], [re.search(r"--picture (\S+)", line)[1] for line in lines])
        self.assertEqual(len(lines), 12)
        for line, picture in zip(lines, pictures):
            self.assertEqual(set(shlex.split(line)) & set(STAND_INS), set(), "files that nobody has")
            self.assertLess((ROOT / "docs/pictures" / picture).stat().st_size, 100_000, picture)

    def test_every_header_is_listed(self):
        linked = re.findall(r"\(\.\./(include/vspring/\w+\.hpp)\)", (ROOT / "docs/cpp.md").read_text())
        self.assertEqual(sorted(linked), sorted(str(path.relative_to(ROOT)) for path in (ROOT / "include/vspring").iterdir()))

    def test_options_that_are_named_are_options(self):
        known = {}
        for document in DOCUMENTS:
            for block in commands(document.read_text()):
                for line in block:
                    for words in re.findall(r"(?:^|\| )(?:build/release/)?vspring +([^|#]*)", line):
                        command = words.split()[:1]
                        if not command or not command[0].islower():
                            command = []
                        if command == ["generate"] and words.split()[1:2] and words.split()[1].islower():
                            command.append(words.split()[1])
                        of_it = known.setdefault(tuple(command), options_of(command))
                        self.assertTrue(of_it, f"{document.name}: {line}: is there such a command?")
                        for option in re.findall(r"(?<!\S)--?[a-z][a-z-]*", words):
                            self.assertIn(option, of_it, f"{document.name}: {line}")

    def test_the_reference_of_options_is_the_programs(self):
        done = subprocess.run([ROOT / "scripts/option-reference", "--check"], env={**os.environ, "VSPRING": str(PROGRAM)},
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_links_lead_somewhere(self):
        count = 0
        for document in LINKED:
            for link in re.findall(r"\]\(([^)\s]+)\)", prose(document.read_text())):
                if re.match(r"[a-z]+:", link):
                    continue
                count += 1
                path, _, anchor = link.partition("#")
                target = document.parent / path if path else document
                with self.subTest(document=document.name, link=link):
                    self.assertTrue(target.exists(), "no such file")
                    if anchor:
                        self.assertIn(anchor, anchors(target.read_text()), "no such heading")
        self.assertGreater(count, 100, "links that this looks for are still written so")

    def test_there_are_commands(self):
        count = sum(len(block) for document in DOCUMENTS for block in commands(document.read_text()))
        self.assertGreater(count, 60, "the words that this looks for are still those of the documents")


if __name__ == "__main__":
    unittest.main()
