"""What is left when memory or disk fail, or the program is killed: the old output or the new one, never a mixture.

FAULTS=all lets every allocation fail and kills a thousand times; without, some."""
import os
import pathlib
import random
import subprocess
import time
import unittest

import support
from support import PROGRAM, Case, hat, run

SOURCE = pathlib.Path(__file__).parent / "faults/faults.c"
ALL = os.environ.get("FAULTS") == "all"
OLD = b"# what was there before\nv 0 0 0\n"


class Faults(Case):
    def setUp(self):
        super().setUp()
        self.before = self.write("in.obj", hat())
        self.out = self.folder / "out.obj"
        self.library = self.folder / "faults.so"
        subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", self.library, SOURCE, "-ldl"], check=True)
        self.preload = {"LD_PRELOAD": str(self.library)}
        self.out.write_bytes(OLD)
        run("fair", self.before, "-o", self.out, "--quiet", "--threads", "1",
            environment={**self.preload, "FAULT_COUNTS": str(self.folder / "counts")})
        self.new = self.out.read_bytes()
        self.counts = {kind: int(count) for kind, count in (line.split() for line in (self.folder / "counts").read_text().splitlines())}
        (self.folder / "counts").unlink()
        self.names = self.files()

    def fail_at(self, kind, number):
        """Exit status, and whether the output is the new one."""
        self.out.write_bytes(OLD)
        done = run("fair", self.before, "-o", self.out, "--quiet", "--threads", "1",
                   environment={**self.preload, "FAULT": f"{kind}:{number}"})
        where = f"{kind} {number}: {done.stderr.decode()}"
        self.assertIn(done.returncode, (0, 2), where)
        self.assertEqual(self.files(), self.names, where)
        left = self.out.read_bytes()
        self.assertIn(left, (OLD, self.new), where)
        if done.returncode == 0:
            self.assertEqual(left, self.new, where)
        else:
            self.assertEqual(self.assert_one_line(done).count("vspring: error:"), 1, where)
        return done.returncode, left == self.new

    def test_no_memory_at_an_allocation(self):
        count = self.counts["allocation"]
        self.assertGreater(count, 1000)
        step = 1 if ALL else count // 80
        failed = sum(self.fail_at("allocation", number)[0] == 2 for number in range(0, count, step))
        self.assertGreater(failed, count // step // 3, "an allocation that fails is seen by most")

    def test_a_disk_that_takes_no_more(self):
        for kind in ("open", "write", "rename"):
            self.assertGreater(self.counts[kind], 0, kind)
            for number in range(self.counts[kind]):
                status, is_new = self.fail_at(kind, number)
                self.assertEqual((status, is_new), (2, False), (kind, number))

    def test_bytes_are_on_the_disk_before_the_name_and_the_folder_after(self):
        self.assertEqual(self.counts["sync"], 2)
        self.assertEqual(self.fail_at("sync", 0), (2, False))
        self.assertEqual(self.fail_at("sync", 1), (0, True), "of the folder: the file is there all the same")

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
