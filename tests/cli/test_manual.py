"""The man page and the completions of shells that scripts/manual makes of the program's help."""
import os
import pathlib
import pty
import re
import select
import subprocess
import sys
import tempfile
import time
import unittest

from support import PROGRAM, Case, run

ROOT = pathlib.Path(__file__).parents[2]


class Manual(Case):
    @classmethod
    def setUpClass(cls):
        made = tempfile.TemporaryDirectory()
        cls.addClassCleanup(made.cleanup)
        cls.made = pathlib.Path(made.name)
        subprocess.run([sys.executable, "-B", ROOT / "scripts/manual", cls.made], check=True, env={**os.environ, "VSPRING": str(PROGRAM)})

    def setUp(self):
        super().setUp()
        for name in ("a.ply", "b.json", "with space.json"):
            (self.folder / name).write_text("")
        (self.folder / "folder").mkdir()

    def test_page(self):
        shown = subprocess.run(["man", "--warnings", "-l", self.made / "vspring.1.gz"], check=True, capture_output=True, text=True,
                               env={**os.environ, "MANWIDTH": "100", "LC_ALL": "C.UTF-8", "MAN_KEEP_FORMATTING": ""})
        self.assertEqual(shown.stderr, "")
        self.assertIn(run("--version").stdout.decode().strip(), shown.stdout)
        for command in ("fair", "curve", "fit", "fill", "span", "measure", "edit"):
            for option in set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", run(command, "--help").stdout.decode(), re.MULTILINE)) - {"--help"}:
                self.assertRegex(shown.stdout, rf"(?m)^ +(-\w, )?{option}\b", f"{command} {option}")

    def offered(self, *words):
        """By bash, for the last word."""
        script = 'source "$0"; compopt() { :; }; COMP_WORDS=(vspring "$@"); COMP_CWORD=$#; _vspring; printf "%s\\n" "${COMPREPLY[@]}"'
        told = subprocess.run(["bash", "-c", script, self.made / "bash/vspring", *words], check=True, capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(told.stderr, "")
        return sorted(told.stdout.splitlines())

    def test_bash(self):
        self.assertEqual(self.offered("f"), ["fair", "fill", "fit"])
        self.assertEqual(self.offered("fair", "--fix"), ["--fix", "--fix-normals"])
        self.assertEqual(self.offered("fair", "--fix", ""), ["boundary", "none"])
        self.assertEqual(self.offered("curve", "in.csv", "--resample-by", "=", "cos"), ["cosine"])
        self.assertEqual(self.offered("fair", "--within", ""), ["auto"])
        self.assertEqual(self.offered("fair", "--tolerance", ""), [""])
        self.assertEqual(self.offered("fair", "--constraints", ""), ["b.json", "folder", "with space.json"])
        self.assertEqual(self.offered("fair", "a"), ["a.ply"])
        self.assertEqual(self.offered("fair", "a.ply", "-o", "f"), ["folder"])
        self.assertIn("annulus", self.offered("generate", ""))
        self.assertEqual(self.offered("generate", "annulus", "--profile", ""), ["cone", "flat", "steps"])
        self.assertEqual(self.offered("generate", "fair", "--fix"), [""])

    def test_fish(self):
        def offered(line):
            told = subprocess.run(["fish", "--no-config", "-c", f"source {self.made}/fish/vspring.fish; complete -C '{line}'"], check=True,
                                  capture_output=True, text=True, cwd=self.folder, env={**os.environ, "HOME": str(self.folder)})
            self.assertEqual(told.stderr, "")
            return sorted(line.split("\t")[0] for line in told.stdout.splitlines())

        self.assertEqual(offered("vspring f"), ["fair", "fill", "fit"])
        self.assertEqual(offered("vspring fair --fix-n"), ["--fix-normals"])
        self.assertEqual(offered("vspring fair --fix "), ["boundary", "none"])
        self.assertEqual(offered("vspring generate annulus --profile "), ["cone", "flat", "steps"])
        self.assertIn("a.ply", offered("vspring fair "))

    def test_zsh(self):
        process, terminal = pty.fork()
        if process == 0:
            os.chdir(self.folder)
            os.environ.update(TERM="dumb", HOME=str(self.folder))
            os.execvp("zsh", ["zsh", "-f", "-i"])
        self.addCleanup(os.waitpid, process, 0)
        self.addCleanup(os.close, terminal)

        def told(line, *awaited):
            os.write(terminal, line.encode())
            text, end = "", time.monotonic() + 60
            while not all(word in text for word in awaited):
                self.assertTrue(select.select([terminal], [], [], max(0, end - time.monotonic()))[0], f"{line!r}: {text}")
                text += os.read(terminal, 65536).decode(errors="replace")
            return text

        told(f"PS1=; autoload -U compinit && compinit -D -u && source {self.made}/zsh/_vspring && echo lo''aded\n", "loaded")
        told("vspring fair --fix \t\t", "boundary", "none")
        told("\x15vspring generate annulus --profile \t\t", "cone", "flat", "steps")
        told("\x15vspring f\t\t", "Fair a polygonal surface", "fill", "fit")


if __name__ == "__main__":
    unittest.main()
