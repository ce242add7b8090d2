"""What is left when memory or disk fail, or the program is killed: the old output or the new one, never a mixture.

FAULTS=all lets every allocation fail and kills a thousand times; without, some."""
import json
import os
import pathlib
import random
import subprocess
import time
import unittest

import support
from support import PROGRAM, Case, grid, hat, run

SOURCE = pathlib.Path(__file__).parent / "faults/faults.c"
ALL = os.environ.get("FAULTS") == "all"
OLD = b"# what was there before\nv 0 0 0\n"
RULES = '{"rules": [{"nodes": "boundary", "position": "fixed", "normal": "fixed"}, {"nodes": [0, 3], "position": [[0, 0, 1], [0.1, 0.2, 1]]}]}'
WAVE = "x,y\n" + "".join(f"{k},{(k * k) % 7}\n" for k in range(40))


class Faults(Case):
    def setUp(self):
        super().setUp()
        self.before = self.write("in.obj", hat())
        self.out = self.folder / "out.obj"
        self.library = self.folder / "faults.so"
        subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", self.library, SOURCE, "-ldl"], check=True)
        self.preload = {"LD_PRELOAD": str(self.library)}
        self.begin_with("fair", self.before, "-o", self.out, "--quiet", "--threads", "1")

    def begin_with(self, *arguments, files=()):
        """Notes what a run without a fault leaves, and how many calls of each kind it makes. files: besides the shape."""
        self.arguments = arguments
        self.extra = [self.folder / name for name in files]
        for path in (self.out, *self.extra):
            path.write_bytes(OLD)
        counts = self.folder / "counts"
        done = run(*arguments, environment={**self.preload, "FAULT_COUNTS": str(counts)})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.new = self.out.read_bytes()
        self.endings = {path: path.read_bytes()[-8:] for path in self.extra}
        self.counts = {kind: int(count) for kind, count in (line.split() for line in counts.read_text().splitlines())}
        counts.unlink()
        self.names = self.files()

    def fail_at(self, kind, number):
        """Exit status, and whether the output is the new one. number: with + for all from there on."""
        for path in (self.out, *self.extra):
            path.write_bytes(OLD)
        done = run(*self.arguments, environment={**self.preload, "FAULT": f"{kind}:{number}"})
        where = f"{self.arguments} {kind} {number}: {done.stderr.decode()}"
        self.assertIn(done.returncode, (0, 2), where)
        self.assertEqual(self.files(), self.names, where)
        left = self.out.read_bytes()
        self.assertIn(left, (OLD, self.new), where)
        for path, ending in self.endings.items():
            bytes_there = path.read_bytes()
            self.assertTrue(bytes_there == OLD or bytes_there[-8:] == ending, where)
            if bytes_there != OLD and path.suffix == ".json":
                json.loads(bytes_there)
            if done.returncode == 0:
                self.assertNotEqual(bytes_there, OLD, where)
        if done.returncode == 0:
            self.assertEqual(left, self.new, where)
        else:
            self.assertEqual(self.assert_one_line(done).count("vspring: error:"), 1, where)
        return done.returncode, left == self.new

    def fail_at_allocations(self, tried):
        """One allocation at a time, and every one from there on; tried: how many of them, unless all."""
        count = self.counts["allocation"]
        self.assertGreater(count, 1000)
        step = 1 if ALL else max(1, count // tried)
        failed = 0
        for number in range(0, count, step):
            failed += self.fail_at("allocation", number)[0] == 2
            failed += self.fail_at("allocation", f"{number}+")[0] == 2
        self.assertGreater(failed, 2 * count // step // 3, "an allocation that fails is seen by most")

    def test_no_memory_at_an_allocation(self):
        self.fail_at_allocations(60)

    def test_no_memory_for_rules_report_page_and_numbers(self):
        self.write("rules.json", RULES)
        self.begin_with("fair", self.before, "-o", self.out, "--constraints", self.folder / "rules.json", "--threads", "1",
                        "--report", self.folder / "report.json", "--html", self.folder / "page.html", "--scalars", self.folder / "numbers.vtp",
                        "--time-limit", "1000", files=("report.json", "page.html", "numbers.vtp"))
        self.fail_at_allocations(60)

    def test_no_memory_for_points_and_deviations(self):
        self.write("points.xyz", "0 0 1.1\n0.3 0.1 0.8\n")
        self.begin_with("fit", self.before, "--points", self.folder / "points.xyz", "--within", "0.2", "-o", self.out, "--quiet", "--threads", "1",
                        "--deviation", self.folder / "deviation.ply", files=("deviation.ply",))
        self.fail_at_allocations(25)

    def test_no_memory_for_a_curve(self):
        path = self.write("wave.csv", WAVE)
        self.out = self.folder / "out.csv"
        self.begin_with("curve", path, "-o", self.out, "--quiet", "--resample", "60", "--report", self.folder / "report.json",
                        "--picture", self.folder / "picture.svg", files=("report.json", "picture.svg"))
        self.fail_at_allocations(25)

    def test_no_memory_on_several_threads(self):
        path = self.write("grid.obj", grid(70))
        self.begin_with("fair", path, "-o", self.out, "--quiet", "--threads", "3")
        self.fail_at_allocations(12)

    def test_no_thread_to_be_had(self):
        path = self.write("grid.obj", grid(70))
        self.begin_with("fair", path, "-o", self.out, "--quiet", "--threads", "3")
        self.assertGreaterEqual(self.counts["thread"], 2)
        for number in ("0", "1", "0+"):
            self.assertEqual(self.fail_at("thread", number), (0, True), "the threads that there are do the work")

    def test_a_disk_that_takes_no_more(self):
        self.write("rules.json", RULES)
        self.begin_with("fair", self.before, "-o", self.out, "--quiet", "--threads", "1", "--report", self.folder / "report.json",
                        "--html", self.folder / "page.html", "--scalars", self.folder / "numbers.vtp",
                        files=("report.json", "page.html", "numbers.vtp"))
        for kind in ("open", "write", "rename"):
            self.assertGreaterEqual(self.counts[kind], 4, kind)
            for number in range(self.counts[kind]):
                self.assertEqual(self.fail_at(kind, number)[0], 2, (kind, number))
                self.assertEqual(self.fail_at(kind, f"{number}+")[0], 2, (kind, number))

    def test_bytes_are_on_the_disk_before_the_name_and_the_folder_after(self):
        self.assertEqual((self.counts["sync"], self.counts["folder"]), (1, 1))
        self.assertEqual(self.fail_at("sync", 0), (2, False), "nothing has been renamed yet")
        self.assertEqual(self.fail_at("folder", 0), (0, True), "the file is there all the same")

    def test_an_input_that_is_changed_while_it_is_read_is_refused(self):
        text = self.before.read_bytes()
        for command in ("printf 'v 0 0 0\\n' >> '{}'", "truncate --size=100 '{}'", "printf '# A HAT\\n' | dd status=none conv=notrunc of='{}'"):
            self.before.write_bytes(text)
            os.utime(self.before, (0, 0))
            self.out.write_bytes(OLD)
            done = run(*self.arguments, environment={**self.preload, "AFTER_READ": command.format(self.before)})
            self.assertNotEqual(self.before.read_bytes(), text)
            self.assertEqual(done.returncode, 2, (command, done.stderr))
            self.assertIn("in.obj: was changed while it was read; try again", self.assert_one_line(done))
            self.assertEqual(self.out.read_bytes(), OLD)
            self.assertEqual(self.files(), self.names)

    def test_killed_at_any_moment(self):
        draw = random.Random(7)
        begin = time.monotonic()
        run("fair", self.before, "-o", self.out, "--quiet")
        whole = time.monotonic() - begin
        for _ in range(1000 if ALL else 40):
            self.out.write_bytes(OLD)
            process = subprocess.Popen([PROGRAM, "fair", self.before, "-o", self.out, "--quiet"], stderr=subprocess.DEVNULL)
            time.sleep(draw.uniform(0, 1.2 * whole))
            process.kill()
            process.wait()
            self.assertIn(self.out.read_bytes(), (OLD, self.new))
            # What a killed program leaves has a name of its own.
            for name in self.files():
                if name not in self.names:
                    self.assertRegex(name, r"^\.vspring-\d+-\d+\.tmp$")
                    (self.folder / name).unlink()


if __name__ == "__main__":
    unittest.main()
