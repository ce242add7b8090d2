"""Shapes, and what the command line makes of them."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("VSPRING_BUILD", ROOT / "build/release"))
sys.path.insert(0, str(BUILD / "python"))

import numpy as np  # noqa: E402

import vspring  # noqa: E402


def patch(cells=12, noise=0.02, seed=7):
    """A saddle with noise: vertices and quads."""
    line = np.linspace(-1, 1, cells + 1)
    x, y = (one.ravel() for one in np.meshgrid(line, line, indexing="ij"))
    vertices = np.column_stack([x, y, (x * x - y * y) / 2])
    vertices += noise * np.random.default_rng(seed).standard_normal(vertices.shape)
    node = np.arange(len(vertices)).reshape(cells + 1, cells + 1)
    quads = np.stack([node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]], axis=-1).reshape(-1, 4)
    return vertices, quads


def wave(count=60, noise=0.02, seed=5):
    """A curve in space with noise."""
    t = np.linspace(0, 3, count)
    return np.column_stack([t, np.sin(t), 0.2 * t * t]) + noise * np.random.default_rng(seed).standard_normal((count, 3))


def boundary_of(cells=12):
    """The mask of the boundary nodes of a patch."""
    mask = np.ones((cells + 1, cells + 1), bool)
    mask[1:-1, 1:-1] = False
    return mask.ravel()


def write_obj(path, vertices, faces=None):
    lines = [f"v {float(x)!r} {float(y)!r} {float(z)!r}" for x, y, z in vertices]
    if faces is None:
        lines.append("l " + " ".join(str(k + 1) for k in range(len(vertices))))
    else:
        lines += ["f " + " ".join(str(node + 1) for node in face) for face in faces]
    pathlib.Path(path).write_text("\n".join(lines) + "\n")


def nodes_of_obj(path):
    rows = (line.split() for line in pathlib.Path(path).read_text().splitlines())
    return np.array([[float(number) for number in row[1:4]] for row in rows if row and row[0] == "v"])


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def by_command_line(self, command, vertices, faces=None, *options):
        """The nodes that the program comes to; its exit status is in self.status."""
        given, fair = self.folder / "given.obj", self.folder / "fair.obj"
        write_obj(given, vertices, faces)
        done = subprocess.run([BUILD / "vspring", command, given, "-o", fair, "--quiet", *map(str, options)], capture_output=True,
                              text=True)
        self.assertIn(done.returncode, (0, 3), done.stderr)
        self.status = done.returncode
        return nodes_of_obj(fair)

    def assert_same_bits(self, left, right):
        left, right = np.asarray(left), np.asarray(right)
        self.assertEqual((left.dtype, left.shape), (right.dtype, right.shape))
        self.assertEqual(left.tobytes(), right.tobytes())
