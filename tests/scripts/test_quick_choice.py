"""What `./check --quick` chooses."""
import pathlib
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from quick_choice import choose, dependent  # noqa: E402


class ByPath(unittest.TestCase):
    def test_each_file_brings_the_tests_that_know_it(self):
        for path, steps in {
            "src/solve/attempt.cpp": {"build": set()},
            "include/vspring/fair.hpp": {"build": set()},
            "tests/claims/fill_test.cpp": {"build": set()},
            "tests/cli/test_fill.py": {"command line": {"fill"}},
            "docs/fill.md": {"command line": {"docs"}},
            "tests/python/test_fill.py": {"Python": {"test_fill"}},
            "bindings/python/module.cpp": {"Python": set()},
            "bindings/wasm/surface.cpp": {"WebAssembly": {"core", "sequences", "threads"}},
            "editor/src/main.ts": {"editor: modules": set()},
            "editor/e2e/view.test.mjs": {"editor: in a browser": {"view"}},
        }.items():
            self.assertEqual(choose([path]), (steps, []), path)
        chosen, _ = choose(["cli/report.cpp"])
        self.assertEqual(chosen["build"], set())
        self.assertIn("fair", chosen["command line"])

    def test_what_is_asked_for_twice_is_run_once_and_all_of_a_step_is_more_than_some(self):
        self.assertEqual(choose(["tests/cli/test_fit.py", "docs/fit.md", "docs/fill.md"])[0], {"command line": {"fit", "docs"}})
        self.assertEqual(choose(["tests/python/test_fit.py", "bindings/python/module.cpp"])[0], {"Python": set()})

    def test_what_nothing_looks_at_is_named(self):
        self.assertEqual(choose(["somewhere/new.cpp", "docs/fill.md"])[1], ["somewhere/new.cpp"])
        listed = subprocess.run(["git", "ls-files", "*.cpp", "*.hpp", "*.py", "*.mjs", "*.ts", "*.js"], cwd=ROOT, check=True, capture_output=True, text=True)
        _, unknown = choose(path for path in listed.stdout.split() if not path.startswith("benchmarks/"))
        self.assertEqual(unknown, [])


class ByObject(unittest.TestCase):
    # Of the tests one is linked with a by b, one with c alone.
    defines = {"a": {"f", "g"}, "b": {"h"}, "c": {"k"}, "first": {"main"}, "second": {"main"}}
    needs = {"a": set(), "b": {"f"}, "c": {"sqrt"}, "first": {"h", "printf"}, "second": {"k"}}

    def depend_on(self, *changed):
        return dependent({"first", "second"}, changed, self.defines, self.needs)

    def test_tests_follow_what_they_are_linked_with(self):
        self.assertEqual(self.depend_on("a"), {"first"})
        self.assertEqual(self.depend_on("b"), {"first"})
        self.assertEqual(self.depend_on("c"), {"second"})
        self.assertEqual(self.depend_on("a", "c"), {"first", "second"})

    def test_a_test_that_changes_brings_no_other(self):
        self.assertEqual(self.depend_on("second"), {"second"})
        self.assertEqual(self.depend_on(), set())


if __name__ == "__main__":
    unittest.main()
