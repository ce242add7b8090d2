"""Small inputs, and a way to run the program."""
import contextlib
import itertools
import json
import math
import os
import pathlib
import pty
import random
import signal
import subprocess
import tempfile
import threading
import unittest

PROGRAM = os.environ["VSPRING"]
EXAMPLES = pathlib.Path(__file__).parents[2] / "examples"


def run(*arguments, stdin=None, environment=None, timeout=120, before=None):
    """before: what the new process calls first."""
    return subprocess.run([PROGRAM, *map(str, arguments)], input=stdin, capture_output=True, timeout=timeout,
                          env={**os.environ, **(environment or {})}, preexec_fn=before)


def run_interrupted(*arguments, by=signal.SIGINT, timeout=60):
    """Signals the program as soon as its progress bar tells of an iteration. What it then did, `stderr` as a terminal shows it."""
    terminal, of_program = pty.openpty()
    process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=of_program,
                               env={**os.environ, "TERM": "xterm"})
    os.close(of_program)
    limit = threading.Timer(timeout, process.kill)
    limit.start()
    shown = b""
    with contextlib.suppress(OSError):  # at the end of what the program shows
        while piece := os.read(terminal, 65536):
            if b"iteration" not in shown and b"iteration" in shown + piece:
                process.send_signal(by)
            shown += piece
    limit.cancel()
    os.close(terminal)
    output, _ = process.communicate(timeout=timeout)
    return subprocess.CompletedProcess(arguments, process.returncode, output, shown)


def hat(rings=4, sides=12):
    """A paper hat as OBJ: a cone of triangles at the tip and quads below, with a comment, a group and texture coordinates."""
    lines = ["# a hat", "v 0 0 1"]
    for ring in range(1, rings + 1):
        for k in range(sides):
            angle = 2 * math.pi * k / sides
            radius = ring / rings
            lines.append(f"v {radius * math.cos(angle):.17g} {radius * math.sin(angle):.17g} {1 - radius:.17g}")
    lines += ["vt 0 0", "g tip"]
    at = lambda ring, k: 2 + (ring - 1) * sides + k % sides
    lines += [f"f 1/1 {at(1, k)}/1 {at(1, k + 1)}/1" for k in range(sides)]
    lines.append("g brim")
    for ring in range(1, rings):
        lines += [f"f {at(ring, k)}/1 {at(ring + 1, k)}/1 {at(ring + 1, k + 1)}/1 {at(ring, k + 1)}/1" for k in range(sides)]
    return "\n".join(lines) + "\n"


def bumps(x, y):
    return 0.3 * math.sin(9 * x) * math.sin(7 * y)


def grid(size, height=bumps):
    """A square of triangles with bumps or of another height, as OBJ."""
    lines = []
    for y in range(size + 1):
        for x in range(size + 1):
            lines.append(f"v {x / size} {y / size} {height(x / size, y / size)}")
    for y in range(size):
        for x in range(size):
            a = y * (size + 1) + x + 1
            b = a + size + 1
            lines += [f"f {a} {a + 1} {b + 1}", f"f {a} {b + 1} {b}"]
    return "\n".join(lines) + "\n"


OCTAHEDRON = """v 1 0 0
v 0 1 0
v -1 0 0
v 0 -1 0
v 0 0 1
v 0 0 -1
f 1 2 5
f 2 3 5
f 3 4 5
f 4 1 5
f 2 1 6
f 3 2 6
f 4 3 6
f 1 4 6
"""


def sphere(cells, radius=2.0, noise=0.0):
    """An octahedron whose faces are cut into cells × cells triangles and blown up, as OBJ."""
    nodes, faces = {}, []
    generator = random.Random(1)

    def node(*place):
        length = math.hypot(*place) / radius
        return nodes.setdefault(place, (len(nodes) + 1, [p / length + noise * generator.uniform(-1, 1) for p in place]))[0]

    for signs in itertools.product((1, -1), repeat=3):
        at = lambda i, j: node(*(s * k for s, k in zip(signs, (i, j, cells - i - j))))
        for i in range(cells):
            for j in range(cells - i):
                triangles = [(at(i, j), at(i + 1, j), at(i, j + 1))]
                if i + j + 1 < cells:
                    triangles.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
                faces += [t if math.prod(signs) > 0 else t[::-1] for t in triangles]
    return "".join(f"v {x!r} {y!r} {z!r}\n" for _, (x, y, z) in nodes.values()) + "".join(f"f {a} {b} {c}\n" for a, b, c in faces)


def tube(rings, sides, length):
    """A tube of radius 1 along z, of quads, with a rough wall, as OBJ: too long for mean curvature that changes evenly."""
    lines = []
    for ring in range(rings + 1):
        for k in range(sides):
            angle = 2 * math.pi * k / sides
            radius = 1 + (0.02 * math.sin(7 * ring + 3 * k) if 0 < ring < rings else 0)
            lines.append(f"v {radius * math.cos(angle)!r} {radius * math.sin(angle)!r} {length * ring / rings!r}")
    at = lambda ring, k: 1 + ring * sides + k % sides
    for ring in range(rings):
        lines += [f"f {at(ring, k)} {at(ring, k + 1)} {at(ring + 1, k + 1)} {at(ring + 1, k)}" for k in range(sides)]
    return "\n".join(lines) + "\n"


def parsed(text):
    """Positions and faces (numbers from 0) of OBJ."""
    nodes, faces = [], []
    for line in text.splitlines():
        words = line.split("#")[0].split()
        if words and words[0] == "v":
            nodes.append(tuple(map(float, words[1:4])))
        if words and words[0] == "f":
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return nodes, faces


def vertex_lines(text):
    return [line for line in text.splitlines() if line.startswith("v ")]


class Case(unittest.TestCase):
    """Each test has a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def assert_one_line(self, result):
        text = result.stderr.decode()
        self.assertEqual(text.count("\n"), 1, text)
        self.assertTrue(text.startswith("vspring: error: "), text)
        return text

    def read_json(self, name):
        return json.loads((self.folder / name).read_text())
