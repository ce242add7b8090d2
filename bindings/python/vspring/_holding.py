"""Constraints from the keyword arguments of a call."""
from __future__ import annotations

import json
import os
from typing import Any, Mapping, Sequence

import numpy as np

from . import _vspring
from ._errors import Error
from ._options import Rules
from ._shapes import Given, nodes_of


def constraints_of(given: Given, options: Mapping[str, Any]) -> _vspring.Constraints:
    """The constraints, applied in the order of the command line."""
    shape = given.core
    held = _vspring.Constraints(shape.node_count)
    fix = options.get("fix")
    if fix is None:
        fix = "none" if options.get("fair_boundary") else "boundary"
    _hold(fix, "fix", given, held.fix_boundary, held.fix)
    directions = options.get("fix_normals")
    _hold("none" if directions is None else directions, "fix_normals", given, held.fix_boundary_directions,
          held.fix_directions)
    if (rules := options.get("constraints")) is not None:
        _apply(rules, given, held)
    if (region := options.get("region")) is not None:
        nodes = (held.select(shape, region, given.file) if isinstance(region, str)
                 else given.nodes_of(region, "region"))
        if options.get("fair_boundary"):
            held.restrict_boundary_to(shape, nodes)
        held.restrict_to(shape, nodes)
    return held


def _apply(rules: Rules, given: Given, held: _vspring.Constraints) -> None:
    if not isinstance(rules, (str, os.PathLike)):
        held.apply_rules(given.core, _json_of(rules, given.core.node_count), given.file, given.welded)
        return
    path = os.fspath(rules)
    text = _vspring.read_file(path).decode(errors="surrogateescape")
    try:
        held.apply_rules(given.core, text, given.file, given.welded)
    except Error as error:
        raise Error(error.code, f"{path}: {error}") from None


def _json_of(rules: Mapping[str, Any] | Sequence[Mapping[str, Any]], count: int) -> str:
    whole = rules if isinstance(rules, Mapping) else {"rules": list(rules)}
    if isinstance(whole.get("rules"), (list, tuple)):
        whole = {**whole, "rules": [_plain_rule(rule, count) for rule in whole["rules"]]}
    return json.dumps(whole, default=lambda value: np.asarray(value).tolist())


def _plain_rule(rule: Any, count: int) -> Any:
    """The rule with node numbers in place of a mask."""
    nodes = rule.get("nodes") if isinstance(rule, Mapping) else None
    if nodes is None or isinstance(nodes, (str, Mapping)):
        return rule
    return {**rule, "nodes": nodes_of(nodes, count, "nodes").tolist()}


def _hold(nodes: Any, name: str, given: Given, boundary: Any, single: Any) -> None:
    if isinstance(nodes, str):
        if nodes not in ("boundary", "none"):
            raise Error("invalid-argument", f"{name}: \"boundary\", \"none\", a mask or node numbers, not {nodes!r}")
        if nodes == "boundary":
            boundary(given.core)
        return
    single(given.core, given.nodes_of(nodes, name))
