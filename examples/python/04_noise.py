"""Takes the noise off a scan: no node ends further from where it was measured than a tolerance. The scan is of the saddle
z = xy, so the program can say how near it comes to the truth.
From the project's folder: /usr/bin/python3 examples/python/04_noise.py OUT"""
import sys

import numpy as np
import vspring


def from_truth(nodes):
    x, y, z = nodes.T
    return np.sqrt(np.mean((z - x * y) ** 2))


out = sys.argv[1] if len(sys.argv) > 1 else "."
scan = vspring.read("examples/saddle.ply")
# Without points the surface is drawn to its own nodes.
positions, report = vspring.fit(scan, within=0.05)
vspring.write(f"{out}/04_noise.ply", positions, source=scan)
print(f"{report.outcome}: {from_truth(positions):.4f} from the truth, before {from_truth(scan.vertices):.4f}; "
      f"points are at most {report.distances.max():.4f} away")
sys.exit(not report.usable)
