"""Drags a node of a sheet upwards, step by step, as an editor does, and prints how another one follows.
/usr/bin/python3 examples/python/06_session.py OUT"""
import sys

import numpy as np
import vspring

out = sys.argv[1] if len(sys.argv) > 1 else "."
cells = 24
y, x = np.meshgrid(*2 * [np.linspace(0, 2, cells + 1)], indexing="ij")
sheet = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
node = np.arange(len(sheet)).reshape(x.shape)
quads = np.stack([node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]], axis=-1).reshape(-1, 4)
dragged = node[cells // 2, cells // 2]
other = dragged + cells // 4

session = vspring.Session(sheet, quads, fix_normals="boundary")
for step in range(1, 7):
    session.hold(dragged, sheet[dragged] + [0, 0, 0.1 * step])
    positions, report = session.update()  # for a picture
    print(f"height {0.1 * step:.1f}: the other node is at {positions[other, 2]:.4f}, after {report.iterations} iterations")
# The button is released: to the tolerance, and never worse than the input without a word.
positions, report = session.fair()
print(f"{report.outcome}: the other node is at {positions[other, 2]:.4f}")
vspring.write(f"{out}/06_session.obj", positions, quads)
sys.exit(not report.usable)
