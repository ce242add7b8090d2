"""What is refused: one clear line, the right exit status, nothing left behind."""
import ctypes
import os
import stat

from support import Case, hat, run


def respect_permissions():
    """Takes from root, for the program that comes, the right to read and write whatever permissions say."""
    drop_from_bounding_set, rights = 24, (1, 2)
    for right in rights if os.geteuid() == 0 else ():
        if ctypes.CDLL(None).prctl(drop_from_bounding_set, right, 0, 0, 0) != 0:
            raise OSError("no right can be given up")


class WrongUse(Case):
    def test_exit_status_one_and_one_line(self):
        path = self.write("in.obj", hat())
        out = self.folder / "out.obj"
        for arguments in ([], ["fare", path], ["fair"], ["fair", path], ["fair", path, "-o", out, "--colour"],
                          ["fair", path, "-o", out, "--method", "magic"], ["fair", path, "-o", out, "--strength", "2"],
                          ["fair", path, "-o", out, "--step-tolerance", "0"], ["fair", path, "-o", out, "--threads", "0"],
                          ["fair", path, "-o", out, "--max-iterations", "many"], ["fair", path, "-o", out, "--step-tolerance", "nan"],
                          ["fair", path, "-o", out, "--paper", "--pseudo-normals", "area"]):
            result = run(*arguments)
            self.assertEqual(result.returncode, 1, (arguments, result.stderr))
            self.assert_one_line(result)
            self.assertEqual(self.files(), ["in.obj"])


class BadFiles(Case):
    def refuse(self, path, *options, output="out.obj", unprivileged=False):
        before = self.files()
        result = run("fair", path, "-o", self.folder / output, *options, before=respect_permissions if unprivileged else None)
        self.assertEqual(result.returncode, 2, (path, result.stderr))
        line = self.assert_one_line(result)
        self.assertLess(len(line), 1000)
        self.assertEqual(self.files(), before)
        return line

    def test_unusable_surfaces(self):
        text = hat()
        cases = {
            "empty.obj": "", "empty.off": "", "empty.ply": "", "empty.stl": "", "zeros.obj": bytes(10_000_000),
            "zeros.stl": bytes(10_000_000), "zeros.ply": bytes(10_000_000), "zeros.off": bytes(10_000_000),
            "words.obj": text.replace("v 0 0 1\n", "v 0 zero 1\n"), "index.obj": text + "f 1 2 900\n",
            "cut.off": "OFF\n4 2 0\n0 0 0\n1 0 0\n", "count.off": "OFF\n3 5 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
            "huge.off": "OFF\n1000000000000 1 0\n0 0 0\n",
            "cut.ply": "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n",
            "short.ply": "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                         "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n1234",
            "cut.stl": "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
        }
        for name, content in cases.items():
            with self.subTest(name):
                line = self.refuse(self.write(name, content))
                self.assertIn(name, line)

    def test_places_that_cannot_be_read_or_written(self):
        path = self.write("in.obj", hat())
        self.refuse(self.folder / "missing.obj")
        self.refuse(self.folder)
        (self.folder / "folder.obj").mkdir()
        self.refuse(path, output="folder.obj")
        self.refuse(path, output="nowhere/out.obj")
        # Before anything is faired or written, as the folder shows.
        for option, name in (("--report", "r.json"), ("--scalars", "s.vtp"), ("--html", "page.html")):
            self.assertIn("nowhere", self.refuse(path, option, self.folder / "nowhere" / name))

    def test_full_disk(self):
        path = self.write("in.obj", hat())
        result = run("fair", path, "-o", "/dev/full", "--format", "obj")
        self.assertEqual(result.returncode, 2)
        self.assertIn("/dev/full", self.assert_one_line(result))
        self.assertEqual(self.files(), ["in.obj"])

    def test_no_permission(self):
        path, fixed = self.write("in.obj", hat()), self.write("fixed.obj", "what was there before")
        path.chmod(0)
        self.assertIn("in.obj: cannot be read: Permission denied", self.refuse(path, unprivileged=True))
        path.chmod(0o600)
        fixed.chmod(0o400)
        self.assertIn("fixed.obj: cannot be written: Permission denied", self.refuse(path, output="fixed.obj", unprivileged=True))
        self.folder.chmod(stat.S_IRUSR | stat.S_IXUSR)
        self.assertIn("out.obj: cannot be written: Permission denied", self.refuse(path, unprivileged=True))
        self.folder.chmod(0o700)
        self.assertEqual(fixed.read_text(), "what was there before")

    def test_unusable_constraints(self):
        path = self.write("in.obj", hat())
        for text, word in (("{", "line 1"), ("[]", "rules"), ('{"rules": [{"nodes": [0]}]}', "rule 1"),
                           ('{"rules": [{"nodes": [99], "position": "fixed"}]}', "99"),
                           ('{"rules": [{"nodes": [0, 0], "position": "fixed"}]}', "twice"),
                           ('{"rules": [{"nodes": [0], "normal": [0, 0, 0]}]}', "node 0"),
                           ('{"rules": [{"nodes": [0], "position": [[0, 0, 0], [1, 1, 1]]}]}', "2 positions"),
                           ('{"rules": [{"nodes": {"group": "ear"}, "position": "fixed"}]}', "ear"),
                           ('{"rules": [{"nodes": [0], "normal": "file"}]}', "file"),
                           ('{"rules": [{"nodes": [0], "tangent": [1, 0, 0]}]}', "tangent"),
                           ('{"rules": [{"nodes": [0], "colour": "red"}]}', "colour")):
            with self.subTest(text):
                self.assertIn(word, self.refuse(path, "--constraints", self.write("rules.json", text)))
        for region in ("sphere:0,0,0", "sphere:0,0,0,one", "sphere:9,9,9,0.1", "box:1,2", "group:ear", "cube:1", "missing.json"):
            with self.subTest(region):
                self.assertIn(region, self.refuse(path, "--region", region))

    def test_numbers_and_commands_that_are_none_are_refused_in_words(self):
        path = self.write("in.obj", hat())
        for option, given, words in (("--tolerance", "0", "a number greater than 0 is needed, not 0;"),
                                     ("--tolerance", "much", "a number greater than 0 is needed, not much;"),
                                     ("--smoothing-length", "inf", "a number greater than 0 is needed, not inf;"),
                                     ("--weight", "-1", "a number of 0 or more is needed, not -1;")):
            result = run("fair", path, "-o", self.folder / "out.obj", option, given)
            self.assertEqual((result.returncode, words in result.stderr.decode()), (1, True), result.stderr)
        result = run("measur", path)
        self.assertEqual(result.returncode, 1)
        self.assertIn('"measur" is none of the commands fair, curve, fit, fill, span, edit, generate, measure; did you mean measure?',
                      result.stderr.decode())
        self.assertNotIn("did you mean", run("polish", path).stderr.decode())
        result = run("generate", "sadle", "-o", self.folder / "out.obj")
        self.assertEqual(result.returncode, 1)
        self.assertIn('"sadle" is none of the shapes ', result.stderr.decode())
        self.assertIn("; did you mean saddle?; see vspring generate --help", result.stderr.decode())

    def test_a_surface_without_a_face_is_refused(self):
        self.assertIn("no face in it", self.refuse(self.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")))

    def test_no_file_is_written_over_another_one_of_the_run(self):
        shape = self.write("in.obj", hat())
        other = self.write("other.obj", hat())
        out = self.folder / "out.obj"
        for command, taken in ((["fair", shape, "-o", out, "--report", out], "--output"),
                               (["fair", shape, "-o", out, "--report", f"{self.folder}/./out.obj"], "--output"),
                               (["fair", shape, "-o", out, "--report", shape], "the input"),
                               (["measure", shape, "--report", shape], "the input"),
                               (["measure", shape, "--compare", other, "--report", other], "--compare"),
                               (["fit", shape, "--points", other, "-o", other, "--within", "0.1"], "--points"),
                               (["fair", shape, "-o", "-", "--report", "-"], "--output")):
            with self.subTest(command=command[3:]):
                result = run(*command)
                self.assertEqual(result.returncode, 1)
                self.assertIn(f" is {taken} already; give it a file of its own", result.stderr.decode())
                self.assertFalse(out.exists())
                self.assertEqual((shape.read_text(), other.read_text()), (hat(), hat()))

    def test_a_failed_run_leaves_the_old_output(self):
        path = self.write("in.obj", hat().replace("v 0 0 1\n", "v 0 0 nan\n"))
        self.write("out.obj", "what was there before")
        self.refuse(path)
        self.assertEqual((self.folder / "out.obj").read_text(), "what was there before")

    def test_nodes_that_cannot_move_are_held_and_counted(self):
        # A fin on edge 1–2. Its nodes are of the boundary, so they are held unless a rule frees them.
        fin = self.write("fin.obj", hat() + "v 0 0 3\nf 2 3 50\n")
        free = self.write("rules.json", '{"rules": [{"nodes": [1, 2], "position": "free"}]}')
        result = run("fair", fin, "-o", self.folder / "out.obj", "--constraints", free)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("2 nodes cannot move and are held: edge 1–2: more than two faces share it", result.stderr.decode())
        lone = self.write("lone.obj", hat() + "v 5 5 5\n")
        self.assertEqual(run("fair", lone, "-o", self.folder / "out.obj").returncode, 0)
        self.assertIn("v 5 5 5\n", (self.folder / "out.obj").read_text())
