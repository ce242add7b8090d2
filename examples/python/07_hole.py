"""Closes the two holes of a sphere without its poles: the patches are fair with what is around, so it is a sphere again.
/usr/bin/python3 examples/python/07_hole.py OUT"""
import sys

import numpy as np
import vspring

out = sys.argv[1] if len(sys.argv) > 1 else "."
rows, columns = 25, 48
latitude, longitude = np.radians(np.meshgrid(np.linspace(-70, 70, rows), np.arange(columns) * 360 / columns, indexing="ij"))
vertices = np.stack([np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude), np.sin(latitude)], axis=-1).reshape(-1, 3)
node = np.arange(rows * columns).reshape(rows, columns)
onward = np.roll(node, -1, axis=1)
faces = np.stack([node[:-1], onward[:-1], onward[1:], node[1:]], axis=-1).reshape(-1, 4)

filled = vspring.fill(vertices, faces)
vspring.write(f"{out}/07_hole.obj", filled.vertices, filled.faces)
added = len(filled.vertices) - len(vertices)
off = np.abs(np.linalg.norm(filled.vertices, axis=1) - 1).max()
print(f"{filled.report.outcome}: {len(filled.holes)} holes, filled with {added} nodes and {sum(hole.face_count for hole in filled.holes)} "
      f"faces; at most {off:.1e} off the sphere")
sys.exit(not filled.report.usable)
