"""Surfaces from curves."""
import json
import subprocess
import unittest

import numpy as np
from support import BUILD, Case, vspring


def circle(z, count=33):
    angle = 2 * np.pi * np.arange(count) / (count - 1)
    return np.column_stack([np.cos(angle), np.sin(angle), np.full(count, z)])


def tube():
    angles = np.pi / 2 * np.arange(4)
    sides = [np.column_stack([np.full(9, np.cos(angle)), np.full(9, np.sin(angle)), np.linspace(0, 2, 9)]) for angle in angles]
    return [circle(0.0), circle(1.0), circle(2.0), *sides]


class Spans(Case):
    def test_a_tube(self):
        curves = tube()
        spanned = vspring.span(curves)
        self.assertTrue(spanned.report.usable)
        self.assertEqual(sorted(loop.state for loop in spanned.loops), ["lid"] * 2 + ["spanned"] * 8)
        self.assertEqual(spanned.faces.shape[1], 4)
        self.assertLess(np.abs(np.hypot(spanned.vertices[:, 0], spanned.vertices[:, 1]) - 1).max(), 1e-5)
        for curve in spanned.curves:
            self.assertEqual(len(curve.origin) > 1, True)
            self.assertTrue(np.all(curve.nodes < min(loop.first_node for loop in spanned.loops if loop.first_node >= 0)))
        np.testing.assert_array_equal(curves[0], circle(0.0))

    def test_it_is_what_the_program_makes(self):
        curves = tube()
        text, first = "", 1
        for rows in curves:
            text += "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in rows.tolist())
            text += "l " + " ".join(map(str, range(first, first + len(rows)))) + "\n"
            first += len(rows)
        (self.folder / "tube.obj").write_text(text)
        subprocess.run([BUILD / "vspring", "span", self.folder / "tube.obj", "-o", self.folder / "out.obj", "--sharp", "0,2", "--length", "0.2",
                        "--report", self.folder / "report.json", "--quiet"], check=True)
        spanned = vspring.span(curves, sharp=[0, 2], length=0.2)
        made = vspring.read(self.folder / "out.obj")
        np.testing.assert_array_equal(spanned.vertices, made.vertices)
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(len(spanned.sharp_edges), report["sharp_edges"])
        self.assertEqual([loop.state for loop in spanned.loops], [loop["state"] for loop in report["loops"]])
        read = vspring.span(vspring.read(self.folder / "tube.obj"), sharp=[0, 2], length=0.2)
        np.testing.assert_array_equal(spanned.vertices, read.vertices)

    def test_loops_are_chosen(self):
        curves = tube()
        lids = [number for number, loop in enumerate(vspring.span(curves, flat=True).loops) if loop.state == "lid"]
        self.assertEqual({loop.state for loop in vspring.span(curves, also=lids, flat=True).loops}, {"spanned"})
        self.assertEqual([loop.state for loop in vspring.span(curves, loops=[3], flat=True).loops].count("spanned"), 1)
        self.assertEqual(vspring.span(curves, without=[0], flat=True).loops[0].state, "left-out")

    def test_masks_and_empty_lists(self):
        def sharp_of(**options):
            return [curve.sharp for curve in vspring.span(tube(), flat=True, **options).curves]

        middle = sharp_of(sharp=[1])
        self.assertIn(True, middle)
        self.assertEqual(sharp_of(sharp=np.arange(7) == 1), middle)
        self.assertEqual(sharp_of(sharp=[False, True, False, False, False, False, False]), middle)
        self.assertEqual(sharp_of(sharp=1), middle)
        self.assertEqual(sharp_of(sharp=[], also=[], without=[]), sharp_of())

    def test_refusals(self):
        for words, call in (("no curves make a loop", lambda: vspring.span([np.zeros((2, 3)), np.ones((3, 3))])),
                            ("12 in also is no loop", lambda: vspring.span(tube(), also=[12])),
                            ("sharp: a mask of 7 curves", lambda: vspring.span(tube(), sharp=[True, False])),
                            ("also: whole numbers are needed, not bool", lambda: vspring.span(tube(), also=[True, False])),
                            ("loops: no loop is named", lambda: vspring.span(tube(), loops=[])),
                            ("curve 1", lambda: vspring.span([np.zeros((2, 3)), np.ones((3, 2))]))):
            with self.assertRaisesRegex(vspring.Error, words):
                call()


if __name__ == "__main__":
    unittest.main()
