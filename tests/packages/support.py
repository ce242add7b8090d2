"""Where packages and empty places are."""
import math
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGES = ROOT / "build/packages"
VERSION = re.search(r"^project\(vspring VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE).group(1)
# Of the machine, as a user has it who knows nothing of the build.
BARE = {"PATH": "/usr/local/bin:/usr/bin:/bin", "LC_ALL": "C.UTF-8", "HOME": "/nonexistent", "PYTHONDONTWRITEBYTECODE": "1"}


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def package(self, pattern):
        found = list(PACKAGES.glob(pattern))
        self.assertEqual(len(found), 1, pattern)
        return found[0]

    def call(self, *command, **environment):
        """What it prints."""
        done = subprocess.run(command, cwd=self.folder, env={**BARE, **environment}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"{command}: {done.stdout}{done.stderr}")
        return done.stdout

    def hat(self, sides=24, rings=4):
        """A paper hat as OBJ, which becomes round."""
        lines = ["v 0 0 1"]
        for ring in range(1, rings + 1):
            for k in range(sides):
                turn = math.tau * k / sides
                lines.append(f"v {ring / rings * math.cos(turn)} {ring / rings * math.sin(turn)} {1 - ring / rings}")
        for k in range(sides):
            n = (k + 1) % sides
            lines.append(f"f 1 {2 + k} {2 + n}")
            lines += [f"f {2 + r * sides + k} {2 + (r + 1) * sides + k} {2 + (r + 1) * sides + n} {2 + r * sides + n}" for r in range(rings - 1)]
        path = self.folder / "hat.obj"
        path.write_text("\n".join(lines) + "\n")
        return path
