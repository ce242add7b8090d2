"""Files that others change, replace or remove while the program works. It waits for its rules in a pipe: by then it has read the shape."""
import os
import subprocess

from support import PROGRAM, Case, hat, run

RULES = '{"rules": [{"nodes": "boundary", "position": "fixed"}]}'


def garbage(path):
    path.write_bytes(b"v 7 7 7\n" * 1000)


def emptied(path):
    os.truncate(path, 0)


def replaced(path):
    other = path.with_name("other")
    other.write_text(hat().replace("v 0 0 1\n", "v 0 0 3\n"))
    other.rename(path)


class SharedFiles(Case):
    def setUp(self):
        super().setUp()
        self.rules = self.folder / "rules"
        os.mkfifo(self.rules)

    def run_while(self, meanwhile, command, shape, out):
        """Lets something happen between the reading of the shape and the writing of the result."""
        words = [PROGRAM, command, shape, "-o", out, "--constraints", self.rules]
        with subprocess.Popen([*map(str, words), "--quiet"], stderr=subprocess.PIPE) as program:
            with open(self.rules, "w", encoding="utf-8") as rules:
                meanwhile()
                rules.write(RULES)
            told = program.stderr.read().decode()
        return program.returncode, told

    def shapes(self):
        """One of each format, with what a program may keep of it."""
        hat_obj = self.write("hat.obj", hat())
        for name in ("ascii.ply", "hat.off", "hat.stl"):
            self.assertEqual(run("fair", hat_obj, "--strength", "0", "-o", self.folder / name).returncode, 0)
            yield "fair", (self.folder / name).read_bytes(), name
        places = [line.split()[1:] for line in hat().splitlines() if line.startswith("v ")]
        faces = [[int(corner.split("/")[0]) - 1 for corner in line.split()[1:]] for line in hat().splitlines() if line.startswith("f ")]
        facets = [(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)]
        yield "fair", ("solid hat\n" + "".join("facet normal 0 0 1\nouter loop\n" + "".join(f"vertex {' '.join(places[node])}\n" for node in facet)
                                              + "endloop\nendfacet\n" for facet in facets) + "endsolid hat\n").encode(), "text.stl"
        yield "fair", hat_obj.read_bytes(), "in.obj"
        bow = [f"{k} {0.05 * k * (19 - k) + 0.1 * (k % 2)}" for k in range(20)]
        yield "curve", "\n".join(["x,y", *(line.replace(" ", ",") for line in bow), "# the end"]).encode(), "bow.csv"
        yield "curve", "\n".join(["A bow", *bow]).encode(), "bow.dat"
        yield "curve", "\n".join(f"{line} 0" for line in bow).encode(), "bow.xyz"
        yield "curve", "\n".join([*(f"v {line} 0" for line in bow), "# open", "l " + " ".join(str(k + 1) for k in range(20))]).encode(), "bow.obj"

    def test_the_result_is_of_what_was_read(self):
        for command, content, name in self.shapes():
            shape, out = self.folder / ("in-" + name), self.folder / ("out-" + name)
            shape.write_bytes(content)
            undisturbed = self.run_while(lambda: None, command, shape, out)
            self.assertEqual(undisturbed[0], 0, undisturbed)
            whole = out.read_bytes()
            self.assertNotEqual(whole, content)
            for change in (garbage, emptied, replaced, os.unlink):
                shape.write_bytes(content)
                out.write_bytes(b"what was there before")
                self.assertEqual(self.run_while(lambda: change(shape), command, shape, out), undisturbed, (name, change))
                self.assertEqual(out.read_bytes(), whole, (name, change))
            shape.write_bytes(content)
            link = self.folder / "link"
            link.unlink(missing_ok=True)
            link.symlink_to(shape)
            out = link.with_suffix(shape.suffix)
            link.rename(out)
            self.assertEqual(self.run_while(lambda: None, command, shape, out)[0], 0, name)
            self.assertTrue(out.is_symlink())
            self.assertEqual(shape.read_bytes(), whole, "the input is the output, behind a link")

    def test_an_output_that_others_touch_is_whole_in_the_end(self):
        shape, out, aside = self.write("in.obj", hat()), self.folder / "out.obj", self.folder / "aside"
        self.assertEqual(self.run_while(lambda: None, "fair", shape, out), (0, ""))
        whole = out.read_bytes()

        def link():
            out.unlink()
            out.symlink_to(aside)

        for change in (lambda: garbage(out), lambda: emptied(out), lambda: replaced(out), out.unlink, link):
            self.assertEqual(self.run_while(change, "fair", shape, out), (0, ""))
            self.assertEqual(out.read_bytes(), whole)
        self.assertEqual(aside.read_bytes(), whole)
        self.assertTrue(out.is_symlink())
        self.assertEqual(self.files(), ["aside", "in.obj", "out.obj", "rules"])

    def test_a_place_that_others_take_away_is_told(self):
        shape, folder = self.write("in.obj", hat()), self.folder / "there"
        for change, reason in ((lambda: folder.rename(self.folder / "gone"), "No such file or directory"),
                               (lambda: (folder / "out.obj").mkdir(), "Is a directory")):
            folder.mkdir()
            status, told = self.run_while(change, "fair", shape, folder / "out.obj")
            self.assertEqual((status, told.count("\n")), (2, 1), told)
            self.assertIn(f"out.obj: cannot be written: {reason}", told)
        self.assertEqual([path.name for path in folder.iterdir()], ["out.obj"])
        self.assertEqual(list((self.folder / "gone").iterdir()), [])
