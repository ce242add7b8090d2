"""Draws a flat sheet to 4,000 scattered points with noise: what is shorter than some six times the smoothing length goes.
From the project's folder: /usr/bin/python3 examples/python/05_points.py OUT"""
import sys

import vspring

out = sys.argv[1] if len(sys.argv) > 1 else "."
sheet = vspring.read("examples/figure-12.obj")
points = vspring.read_points("examples/figure-12.xyz")
positions, report = vspring.fit(sheet, points=points, smoothing_length=0.1)
vspring.write(f"{out}/05_points.obj", positions, source=sheet)
print(f"{report.outcome}: {report.points} points, of which {report.pulling_points} pull, are {report.after.rms:.4f} away "
      f"(root mean square), before {report.before.rms:.4f}")
sys.exit(not report.usable)
