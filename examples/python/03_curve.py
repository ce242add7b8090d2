"""A fair curve through five points, with its direction given at both ends: nodes between them start on straight lines.
/usr/bin/python3 examples/python/03_curve.py OUT"""
import sys

import numpy as np
import vspring

out = sys.argv[1] if len(sys.argv) > 1 else "."
points = np.array([[0, 0], [2, 1.5], [4, 1], [6, -1], [8, 0]])
between = 12  # edges from point to point

places = np.arange(0, len(points) - 1 + 1 / between / 2, 1 / between)
start = np.column_stack([np.interp(places, np.arange(len(points)), column) for column in points.T])
held = {"fix": np.arange(len(points)) * between,
        "constraints": [{"nodes": [0], "tangent": [0, 1]}, {"nodes": [len(start) - 1], "tangent": [1, 0]}]}
positions, report = vspring.fair_curve(start, **held)
vspring.write(f"{out}/03_curve.csv", positions)
vspring.write(f"{out}/03_curve.svg", positions)

before, after = (vspring.measure(one, **held) for one in (start, positions))
print(f"{report.outcome}: greatest turn at a node {after.greatest_turn:.1f} degrees, before {before.greatest_turn:.1f}; "
      f"directions at the ends are met to {after.normal_error:.2f} degrees")
sys.exit(not report.usable)
