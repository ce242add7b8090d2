"""Small runs under valgrind: what they read has been written, and what they take they give back. Sanitizers of clang do
not see the former."""
import shutil
import subprocess
import unittest

from support import PROGRAM, Case, hat

VALGRIND = shutil.which("valgrind")


@unittest.skipUnless(VALGRIND, "needs valgrind")
class Memory(Case):
    def run_clean(self, *arguments):
        result = subprocess.run([VALGRIND, "-q", "--error-exitcode=99", "--leak-check=full", "--errors-for-leak-kinds=definite", PROGRAM,
                                 *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertIn(result.returncode, (0, 3), result.stderr)

    def test_a_surface_a_curve_and_a_fit(self):
        surface, out = self.write("in.obj", hat()), self.folder / "out.obj"
        self.run_clean("fair", surface, "-o", out, "--quiet", "--fix-normals", "boundary", "--report", self.folder / "report.json",
                       "--html", self.folder / "page.html", "--threads", "2")
        points = self.write("points.xyz", "0 0 1.1\n0.3 0.1 0.8\n")
        self.run_clean("fit", surface, "--points", points, "--within", "0.2", "-o", out, "--quiet")
        self.run_clean("fit", surface, "--points", points, "--weight", "0.1", "--method", "multigrid", "--levels", "1", "-o", out, "--quiet")
        curve = self.write("wave.csv", "x,y\n" + "".join(f"{k},{(k * k) % 7}\n" for k in range(40)))
        self.run_clean("curve", curve, "-o", self.folder / "out.csv", "--quiet", "--resample", "60")
