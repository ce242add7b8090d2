"""What is in the zip."""
import pathlib
import re
import subprocess
import sys
import tomllib
import unittest
import zipfile

from support import ADDON, BUILD, ROOT, module


class Package(unittest.TestCase):
    def test_one_folder_with_all_that_is_needed(self):
        archive = subprocess.run([ROOT / "blender/pack", "--build", BUILD], check=True, capture_output=True, text=True).stdout.strip()
        with zipfile.ZipFile(archive) as packed:
            names = packed.namelist()
        self.assertEqual({name.split("/")[0] for name in names}, {ADDON})
        for name in ("__init__.py", "blender_manifest.toml", "LICENSE", "vspring/__init__.py", "vspring/libfmt.copyright"):
            self.assertIn(f"{ADDON}/{name}", names)
        self.assertEqual(sum(name.endswith(".so") for name in names), 1)

    def test_versions_agree(self):
        version = re.search(r"^project\(vspring VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE).group(1)
        manifest = tomllib.loads((ROOT / "blender/vspring_addon/blender_manifest.toml").read_text())
        self.assertEqual(manifest["version"], version)
        self.assertEqual(".".join(map(str, sys.modules[ADDON].bl_info["version"])), version)
        self.assertEqual(module().__version__, version)

    def test_manifest(self):
        """What Blender 4.2 and later ask for."""
        manifest = tomllib.loads((ROOT / "blender/vspring_addon/blender_manifest.toml").read_text())
        for key in ("schema_version", "id", "version", "name", "tagline", "maintainer", "type", "blender_version_min", "license"):
            self.assertIn(key, manifest)
        self.assertEqual(manifest["type"], "add-on")
        self.assertLessEqual(len(manifest["tagline"]), 64)
        self.assertNotRegex(manifest["tagline"], r"[.!?]$")

    def test_module_is_the_one_inside(self):
        inside = pathlib.Path(sys.modules[ADDON].__file__).parent / "vspring"
        self.assertEqual(pathlib.Path(module().__file__).parent, inside)
        loaded = pathlib.Path("/proc/self/maps").read_text()
        self.assertIn(str(inside / "libfmt.so"), loaded)
