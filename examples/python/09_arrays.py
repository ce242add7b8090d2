"""Fairs a surface that lies in NumPy's arrays, as other libraries have them, and takes the result as one.
/usr/bin/python3 examples/python/09_arrays.py OUT"""
import sys

import numpy as np

import vspring

out = sys.argv[1] if len(sys.argv) > 1 else "."
# Somebody else's arrays: a row x, y, z for each node, and a row of three nodes for each triangle. The sheet is rough inside its flat boundary.
cells = 20
node = np.arange((cells + 1) ** 2).reshape(cells + 1, cells + 1)
row, column = np.indices(node.shape)
inside = (row % cells != 0) & (column % cells != 0)
vertices = np.column_stack([column.ravel() * 0.05, row.ravel() * 0.05, np.where(inside, 0.02 * np.sin(7.0 * node), 0).ravel()])
a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]))
triangles = np.column_stack([a, b, c, a, c, d]).reshape(-1, 3)

positions, report = vspring.fair(vertices, triangles)
height = [np.abs(z).max() for z in (positions[:, 2], vertices[:, 2])]
print(f"{report.outcome}: heights of up to {height[0]:.4f}, before {height[1]:.4f}")
vspring.write(f"{out}/09_arrays.obj", positions, triangles)
sys.exit(not report.usable)
