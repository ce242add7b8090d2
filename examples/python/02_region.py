"""Three pipes that meet in a rough block. Two of their rims keep their tangent planes, too; the end of the third pipe is
outside of the region that moves, stays to the bit, and is met smoothly.
From the project's folder: /usr/bin/python3 examples/python/02_region.py OUT"""
import sys

import vspring

out = sys.argv[1] if len(sys.argv) > 1 else "."
pipes = vspring.read("examples/pipe-blend.obj")
all_but_an_end = pipes.vertices[:, 0] >= -1.2
positions, report = vspring.fair(pipes, fix_normals="boundary", region=all_but_an_end)
vspring.write(f"{out}/02_region.obj", positions, source=pipes)

before, after = (vspring.measure(one, pipes.faces).bending_energy for one in (pipes.vertices, positions))
print(f"{report.outcome}: {report.moving_nodes} of {report.nodes} nodes moved; bending energy {after:.0f}, before {before:.0f}")
sys.exit(not report.usable)
