"""Colours and the progress bar: on terminals only, and off where people want them off."""
import os
import pty
import select
import subprocess

from support import PROGRAM, Case, grid, hat, run


def run_on_terminal(arguments, environment=None):
    """Runs the program with its output and errors on a terminal; what it printed there."""
    leader, follower = pty.openpty()
    process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=follower, stderr=follower, stdin=subprocess.DEVNULL,
                               env={**os.environ, "TERM": "xterm", "NO_COLOR": "", **(environment or {})})
    os.close(follower)
    text = b""
    while True:
        ready, _, _ = select.select([leader], [], [], 60)
        try:
            piece = os.read(leader, 65536) if ready else b""
        except OSError:
            break
        if not piece:
            break
        text += piece
    os.close(leader)
    process.wait(60)
    return text.decode()


class Terminal(Case):
    def test_colours_on_a_terminal_unless_told_otherwise(self):
        arguments = ["fair", self.write("in.obj", hat()), "-o", self.folder / "out.obj"]
        self.assertIn("\x1b[32mconverged", run_on_terminal(arguments))
        self.assertNotIn("\x1b[3", run_on_terminal(arguments, {"NO_COLOR": "1"}))
        self.assertNotIn("\x1b[3", run_on_terminal(arguments, {"TERM": "dumb"}))
        self.assertNotIn("\x1b[3", run_on_terminal([*arguments, "--color", "never"]))

    def test_no_escapes_elsewhere_unless_asked_for(self):
        arguments = ["fair", self.write("in.obj", hat()), "-o", self.folder / "out.obj"]
        result = run(*arguments)
        self.assertNotIn(b"\x1b", result.stdout + result.stderr)
        self.assertIn(b"\x1b[32m", run(*arguments, "--color", "always").stdout)

    def test_progress_bar_on_long_runs(self):
        # Many times as long as the bar waits, however fast the machine is.
        report, iterations, seconds = self.folder / "report.json", 50, 0
        while seconds < 1.5:
            iterations *= 2
            arguments = ["fair", self.write("in.obj", grid(40)), "-o", self.folder / "out.obj", "--method", "sweep",
                         "--step-tolerance", "1e-30", "--max-iterations", iterations, "--report", report, "--threads", "1"]
            result = run(*arguments)
            self.assertNotIn(b"fairing", result.stdout + result.stderr)
            self.assertEqual(self.read_json("report.json")["outcome"], "iteration-limit")
            seconds = self.read_json("report.json")["seconds"]
        text = run_on_terminal(arguments)
        self.assertIn("fairing [", text)
        self.assertRegex(text, r"iteration \d+")
        self.assertIn("left", text)
        self.assertNotIn("fairing [", run_on_terminal([*arguments, "--quiet"]))

    def test_a_reader_that_goes_away_is_told(self):
        path = self.write("in.obj", grid(100))
        process = subprocess.Popen([PROGRAM, "fair", path, "-o", "-", "--max-iterations", "1"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        process.stdout.close()
        errors = process.stderr.read().decode()
        process.stderr.close()
        self.assertEqual(process.wait(60), 2)
        self.assertIn("vspring: error: ", errors)
