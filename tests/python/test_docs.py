"""Every example of docs/python.md and of docstrings runs; the stubs of the compiled module name what it has."""
import ast
import contextlib
import inspect
import io
import os
import re
import subprocess
import sys
import textwrap
import unittest
import warnings

import numpy as np
from support import BUILD, ROOT, Case, patch, vspring

PACKAGE = ROOT / "bindings/python/vspring"


def blocks_of(text):
    """Indented blocks of Python, each after an empty line."""
    blocks = re.findall(r"(?:(?<=\n\n)|\A)((?: {4}.*\n|\n(?= {4}))+)", text)
    return [textwrap.dedent(block) for block in blocks if "pip install" not in block]


class Examples(Case):
    def setUp(self):
        super().setUp()
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        vertices, quads = patch()
        self.names = {"np": np, "vspring": vspring, "vertices": vertices, "faces": quads}
        vspring.write("part.ply", vertices, np.vstack([quads[:, :3], quads[:, [0, 2, 3]]]))
        vspring.write("scan.ply", *patch(cells=30, seed=2))
        (self.folder / "examples").symlink_to(ROOT / "examples")
        (self.folder / "rules.json").write_text('{"rules": [{"nodes": "boundary", "normal": "fixed"}]}')

    def run_blocks(self, text, name):
        blocks = blocks_of(text)
        for block in blocks:
            with self.subTest(block=block), contextlib.redirect_stdout(io.StringIO()), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                exec(compile(block, name, "exec"), self.names)
        return len(blocks)

    def test_page(self):
        self.assertEqual(self.run_blocks((ROOT / "docs/python.md").read_text(), "python.md"), 9)
        self.assertTrue((self.folder / "fair.ply").exists())

    def test_faces_of_every_kind(self):
        (block,) = [one for one in blocks_of((ROOT / "docs/python.md").read_text()) if "surface.faces" in one]
        vertices, quads = patch()
        triangles = np.vstack([quads[:, :3], quads[:, [0, 2, 3]]])
        for faces in (quads, triangles, [quads[:70], triangles[70:144], triangles[214:]]):
            vspring.write("part.ply", vertices, faces)
            names = {**self.names, "surface": vspring.read("part.ply")}
            exec(compile(block, "python.md", "exec"), names)
            self.assert_same_bits(names["positions"], vspring.fair(vertices, faces).positions)

    def test_task_of_a_blend_prints_what_it_says(self):
        (block,) = [one for one in blocks_of((ROOT / "docs/python-tasks.md").read_text()) if "pipe-blend" in one]
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            exec(compile(block, "python-tasks.md", "exec"), {"vspring": vspring})
        said = re.search(r"# (\S+) and (\S+)$", block, re.MULTILINE).groups()
        self.assertEqual(tuple(f"{float(figure):.3g}" for figure in printed.getvalue().split()), said)

    def test_quick_start(self):
        (block,) = re.findall(r"^```python\n(.*?)^```$", (ROOT / "docs/quick-start.md").read_text(), re.MULTILINE | re.DOTALL)
        with contextlib.redirect_stdout(io.StringIO()) as told:
            exec(compile(block, "quick-start.md", "exec"), {})
        self.assertIn("converged", told.getvalue())
        self.assertEqual(len(vspring.read("blend.obj").vertices), len(vspring.read("examples/pipe-blend.obj").vertices))

    def test_tasks(self):
        self.assertEqual(self.run_blocks((ROOT / "docs/python-tasks.md").read_text(), "python-tasks.md"), 6)
        self.assertEqual(len(vspring.read("hornless.obj").vertices), len(vspring.read("examples/spot.obj").vertices))

    def test_gallery(self):
        """Every picture is drawn, and each shape is fairer, or nearer to the true one, than it was."""
        told = subprocess.run([sys.executable, "-B", ROOT / "examples/gallery.py", self.folder / "drawn"], check=True, capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": str(BUILD / "python"), "MPLCONFIGDIR": str(self.folder)}).stdout
        rows = re.findall(r"^(\w+): (\S+) to (\S+)$", told, re.MULTILINE)
        self.assertEqual([f"python-{name}.png" for name, _, _ in rows], re.findall(r"\(pictures/(.*?)\)", (ROOT / "docs/python-tasks.md").read_text()))
        for name, before, after in rows:
            self.assertLess(float(after), float(before) / 2, name)
            self.assertGreater((self.folder / f"drawn/python-{name}.png").stat().st_size, 10_000)

    def test_docstrings(self):
        ran = self.run_blocks(inspect.cleandoc(vspring.__doc__) + "\n", "vspring")
        ran += self.run_blocks(inspect.cleandoc(vspring.Session.__doc__) + "\n", "Session")
        self.assertEqual(ran, 2)


class Described(unittest.TestCase):
    def test_all_that_is_public_has_a_docstring(self):
        for name in vspring.__all__:
            one = getattr(vspring, name)
            self.assertTrue(inspect.getdoc(one), name)
            for part, value in vars(one).items() if inspect.isclass(one) else ():
                if not part.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                    self.assertTrue(inspect.getdoc(value), f"{name}.{part}")

    def test_signatures_show_every_argument(self):
        parameters = inspect.signature(vspring.fair).parameters
        for name in ("fix", "constraints", "within", "tolerance", "springs", "progress"):
            self.assertIs(parameters[name].kind, inspect.Parameter.KEYWORD_ONLY)
            self.assertIn(f"\n{name}: ", vspring.fair.__doc__)

    def test_stubs_name_what_the_compiled_module_has(self):
        tree = ast.parse((PACKAGE / "_vspring.pyi").read_text())
        defined = (ast.FunctionDef, ast.ClassDef)
        stubs = {node.name: node for node in tree.body if isinstance(node, defined)}
        module = {name: one for name, one in vars(vspring._vspring).items() if not name.startswith("__")}
        self.assertEqual(set(stubs), set(module))
        for name, node in stubs.items():
            if isinstance(node, ast.ClassDef):
                within = {part.name for part in node.body if isinstance(part, ast.FunctionDef)} - {"__init__", "__repr__"}
                has = {part for part in vars(module[name]) if not part.startswith("__") and part != "_pybind11_conduit_v1_"}
                self.assertEqual(within, has, name)
        self.assertTrue((PACKAGE / "py.typed").exists())


if __name__ == "__main__":
    unittest.main()
