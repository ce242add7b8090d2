"""What holds a shape, from the keyword arguments of a call."""
from __future__ import annotations

from typing import Any, Mapping

from . import _vspring
from ._errors import Error
from ._shapes import Given, nodes_of


def constraints_of(given: Given, options: Mapping[str, Any]) -> _vspring.Constraints:
    """In the order of the command line."""
    shape = given.core
    held = _vspring.Constraints(shape.node_count)
    fix = options.get("fix")
    if fix is None:
        fix = "none" if options.get("fair_boundary") else "boundary"
    _hold(fix, "fix", shape, held.fix_boundary, held.fix)
    directions = options.get("fix_normals")
    _hold("none" if directions is None else directions, "fix_normals", shape, held.fix_boundary_directions,
          held.fix_directions)
    return held


def _hold(nodes: Any, name: str, shape: Any, boundary: Any, single: Any) -> None:
    if isinstance(nodes, str):
        if nodes not in ("boundary", "none"):
            raise Error("invalid-argument", f"{name}: \"boundary\", \"none\", a mask or node numbers, not {nodes!r}")
        if nodes == "boundary":
            boundary(shape)
        return
    single(shape, nodes_of(nodes, shape.node_count, name))
