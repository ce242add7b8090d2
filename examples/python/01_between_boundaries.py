"""Reads a surface, makes it fair between its boundaries, which keep their places, and writes it.
From the project's folder: /usr/bin/python3 examples/python/01_between_boundaries.py OUT"""
import sys

import vspring

out = sys.argv[1] if len(sys.argv) > 1 else "."
surface = vspring.read("examples/annulus.obj")
positions, report = vspring.fair(surface)
vspring.write(f"{out}/01_between_boundaries.obj", positions, source=surface)
print(f"{report.outcome} after {report.iterations} iterations; nodes moved by up to {report.greatest_move:.3f}")
sys.exit(not report.usable)
