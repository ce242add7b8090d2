"""pip install . into a folder, without network, of what CMake has built."""
import importlib
import os
import re
import shutil
import subprocess
import sys
import unittest

import numpy as np
from support import BUILD, ROOT, Case, patch, vspring

PROGRAM = """
import sys
import numpy as np
import vspring
given = np.load(sys.argv[1])
np.save(sys.argv[2], vspring.fair(given["vertices"], given["faces"]).positions)
print(vspring.__version__, vspring.__file__)
"""


class Installed(Case):
    def test_package(self):
        folder = self.folder / "installed"
        subprocess.run([sys.executable, "-m", "pip", "install", ROOT, "--no-build-isolation", "--no-deps", "--no-index", "--quiet",
                        "--root-user-action=ignore", "--target", folder], check=True, env={**os.environ, "VSPRING_BUILD": str(BUILD)})
        vertices, faces = patch()
        np.savez(self.folder / "given.npz", vertices=vertices, faces=faces)
        done = subprocess.run([sys.executable, "-B", "-c", PROGRAM, self.folder / "given.npz", self.folder / "fair.npy"], check=True,
                              capture_output=True, text=True, cwd=self.folder, env={**os.environ, "PYTHONPATH": str(folder)})
        version, place = done.stdout.split()
        self.assertTrue(place.startswith(str(folder)))
        self.assert_same_bits(np.load(self.folder / "fair.npy"), vspring.fair(vertices, faces).positions)
        told = re.search(r"project\(vspring VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
        self.assertEqual(version, told)
        info = folder / f"vspring-{told}.dist-info"
        self.assertIn(f"Version: {told}\n", (info / "METADATA").read_text())
        self.assertIn("Tag: cp311-cp311-linux_x86_64", (info / "WHEEL").read_text())
        self.assertTrue((info / "LICENSE").exists())
        shipped = {path.name for path in (folder / "vspring").iterdir() if path.is_file()}
        for needed in [path.name for path in (ROOT / "bindings/python/vspring").iterdir() if path.is_file()]:
            self.assertIn(needed, shipped)

    def test_inside_of_another_package(self):
        """As a program may have it that brings its own along; both work side by side."""
        shutil.copytree(BUILD / "python/vspring", self.folder / "host/vspring")
        sys.path.insert(0, str(self.folder))
        self.addCleanup(sys.path.remove, str(self.folder))
        inner = importlib.import_module("host.vspring")
        vertices, faces = patch()
        self.assert_same_bits(inner.fair(vertices, faces).positions, vspring.fair(vertices, faces).positions)
        for one, other in ((inner, vspring), (vspring, inner)):
            with self.assertRaises(one.Error) as caught:
                one.fair(vertices, faces, fix="none")
            self.assertNotIsInstance(caught.exception, other.Error)


if __name__ == "__main__":
    unittest.main()
