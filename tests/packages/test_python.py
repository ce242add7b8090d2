"""The wheel, and the sources that pip makes one of."""
import os
import sys
import tarfile
import unittest
import zipfile

from support import ROOT, VERSION, Case

USE = """
import sys, vspring
hat = vspring.read("hat.obj")
positions, report = vspring.fair(hat)
vspring.write("fair.ply", positions, source=hat)
print(vspring.__version__, report.outcome, vspring.__file__)
print(*{line.split()[-1] for line in open("/proc/self/maps") if "libfmt" in line})
"""


class Python(Case):
    def test_wheel(self):
        place = self.folder / "place"
        self.call(sys.executable, "-m", "pip", "install", "--no-index", "--no-deps", "--quiet", "--root-user-action=ignore", "--target", place,
                  self.package("vspring-*.whl"))
        self.hat()
        version, outcome, *loaded = self.call(sys.executable, "-c", USE, PYTHONPATH=str(place)).split()
        self.assertEqual((version, outcome), (VERSION, "converged"))
        # The module, and the library that not every Linux has.
        self.assertEqual([path.startswith(str(place)) for path in loaded], [True, True], loaded)
        self.assertTrue((self.folder / "fair.ply").read_bytes().startswith(b"ply"))

    def test_sources(self):
        """Are those of the module, all of them, and make the same wheel."""
        with tarfile.open(self.package(f"vspring-{VERSION}.tar.gz")) as packed:
            packed.extractall(self.folder)
        sources = self.folder / f"vspring-{VERSION}"
        for name in ("src", "include", "bindings/python"):
            for path in (ROOT / name).rglob("*.[ch]pp"):
                self.assertTrue((sources / path.relative_to(ROOT)).exists(), path)
        self.call("cmake", "-S", sources, "-B", self.folder / "build", "-DVSPRING_BUILD_PYTHON=ON", "-DVSPRING_BUILD_CLI=OFF")
        self.call(sys.executable, "-m", "pip", "wheel", sources, "--no-build-isolation", "--no-deps", "--no-index", "--quiet", "--wheel-dir", self.folder,
                  VSPRING_BUILD=str(ROOT / "build/release"), HOME=os.environ.get("HOME", "/root"))
        made = next(self.folder.glob("*.whl"))
        names = lambda path: sorted(zipfile.ZipFile(path).namelist())
        self.assertEqual(names(made), names(self.package("vspring-*.whl")))


if __name__ == "__main__":
    unittest.main()
