"""pip install . has CMake build the Python module; scripts/setup python installs what that needs. All else is in pyproject.toml.

VSPRING_BUILD names a folder in which CMake has built the module already.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        given = os.environ.get("VSPRING_BUILD")
        folder = pathlib.Path(given or self.build_temp).resolve()
        if not given:
            subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DVSPRING_BUILD_PYTHON=ON",
                            "-DVSPRING_BUILD_CLI=OFF", "-DVSPRING_PRECOMPILE_HEADERS=ON", "-DVSPRING_UNITE_SOURCES=20",
                            f"-DPython_EXECUTABLE={sys.executable}"], check=True)
            subprocess.run(["cmake", "--build", folder, "--target", "_vspring"], check=True,
                           env={"CMAKE_BUILD_PARALLEL_LEVEL": str(os.cpu_count()), **os.environ})
        built = pathlib.Path(self.get_ext_fullpath(extension.name))
        built.parent.mkdir(parents=True, exist_ok=True)
        for path in [folder / "python/vspring" / built.name, *(folder / "python/vspring").glob("libfmt*")]:
            shutil.copy(path, built.parent)


version = re.search(r"^project\(vspring VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE).group(1)
made = ROOT / "build/python"
made.mkdir(parents=True, exist_ok=True)
setup(version=version, ext_modules=[Extension("vspring._vspring", sources=[])], cmdclass={"build_ext": BuildByCMake},
      options={"build": {"build_base": "build/python"}, "egg_info": {"egg_base": "build/python"}})
