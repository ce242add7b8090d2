"""Every example of examples/python runs, says that its result is usable, prints what the index has, and leaves what it claims."""
import os
import re
import subprocess
import sys
import unittest

from support import BUILD, ROOT, Case

EXAMPLES = sorted((ROOT / "examples/python").glob("*.py"))


class Examples(Case):
    def setUp(self):
        super().setUp()
        self.index = (ROOT / "examples/README.md").read_text()

    def test_results_are_what_they_claim_to_be(self):
        for example in EXAMPLES:
            with self.subTest(example=example.stem):
                told = subprocess.run([sys.executable, "-B", example, self.folder], cwd=ROOT, capture_output=True, text=True,
                                      env={**os.environ, "PYTHONPATH": str(BUILD / "python")})
                self.assertEqual((told.returncode, told.stderr), (0, ""), told.stdout)
                figures = re.search(rf"\(python/{example.name}\).*", self.index).group()
                self.assertTrue(quoted := re.findall("`(.*?)`", figures))
                for text in quoted:
                    self.assertIn(text, told.stdout)
        checked = subprocess.run([ROOT / "tests/examples/check", BUILD / "vspring", self.folder, *(example.stem for example in EXAMPLES)],
                                 capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_index_has_those_of_every_language(self):
        names = {language: {path.stem for path in (ROOT / "examples" / language).glob(f"0*.{ending}")}
                 for language, ending in (("cpp", "cpp"), ("python", "py"), ("js", "mjs"))}
        self.assertEqual(names["python"], {example.stem for example in EXAMPLES})
        self.assertEqual(names["python"], names["cpp"])
        # The library for JavaScript reads shapes from files only.
        self.assertEqual(names["python"] - names["js"], {"09_arrays"})
        linked = re.findall(r"\]\(((?:cpp|python|js)/.*?)\)", self.index)
        self.assertEqual(len(linked), sum(map(len, names.values())))


if __name__ == "__main__":
    unittest.main()
