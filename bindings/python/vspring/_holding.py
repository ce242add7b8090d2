"""Constraints from the keyword arguments of a call."""
from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import Any, Callable, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import _vspring
from ._errors import Error
from ._options import Rules
from ._shapes import Given, indices_of, nodes_of
from ._sharp import SharpEdges


@dataclass(frozen=True)
class Held:
    """What holds a shape, and its sharp edges."""

    constraints: _vspring.Constraints
    sharp_edges: np.ndarray
    """(k, 2), those given and those that rules name."""

    def settled(self, options: Mapping[str, Any]) -> dict[str, Any]:
        """The options for the library."""
        settled = dict(options)
        if len(self.sharp_edges):
            directions = options.get("fix_normals")
            settled.update(sharp_edges=self.sharp_edges, fix_sharp_normals=isinstance(directions, str) and directions == "boundary")
        else:
            settled.pop("sharp_edges", None)
        return settled


def constraints_of(given: Given, options: Mapping[str, Any]) -> _vspring.Constraints:
    """The constraints alone."""
    return held_in(given, options).constraints


def held_in(given: Given, options: Mapping[str, Any]) -> Held:
    """The constraints, applied in the order of the command line, and the sharp edges."""
    shape = given.whole
    apply = _rules_of(options.get("constraints"), given)
    # Normals at the boundary are those of each side.
    sharp = np.concatenate([_given_edges(options.get("sharp_edges"), given), apply(_vspring.Constraints(shape.node_count))])
    if options.get("sharp") is not None and not given.is_curve and not len(sharp):
        raise Error("invalid-argument", "sharp: that is for curves, and for chains of sharp_edges; find_sharp_edges() finds those of a surface")
    held = _vspring.Constraints(shape.node_count)
    fix = options.get("fix")
    if fix is None:
        fix = "none" if options.get("fair_boundary") else "boundary"
    _hold(fix, "fix", given, held.fix_boundary, held.fix)
    directions = options.get("fix_normals")
    _hold("none" if directions is None else directions, "fix_normals", given,
          lambda whole: held.fix_boundary_directions(whole, sharp), held.fix_directions)
    apply(held)
    if options.get("region") is not None:
        nodes = given.with_images(region_of(given, options))
        if options.get("fair_boundary"):
            held.restrict_boundary_to(shape, nodes)
        held.restrict_to(shape, nodes)
    if given.ends is not None:
        given.ends.hold(held)
    return Held(held, sharp)


def region_of(given: Given, options: Mapping[str, Any]) -> np.ndarray:
    """The numbers of the nodes of the region; none if there is no region."""
    region = options.get("region")
    if region is None:
        return np.zeros(0, np.int32)
    nodes = (_vspring.Constraints(0).select(given.core, region, given.file) if isinstance(region, str)
             else given.nodes_of(region, "region"))
    if not len(nodes):
        raise Error("unusable-constraint", "region: no node lies in it")
    return nodes


def _given_edges(edges: ArrayLike | SharpEdges | None, given: Given) -> np.ndarray:
    """Pairs of nodes; of welded ones their representatives."""
    if edges is None:
        return np.zeros((0, 2), np.int32)
    if given.is_curve:
        raise Error("invalid-argument", "sharp_edges: that is for surfaces; of curves, sharp keeps corners")
    pairs = indices_of(edges.edges if isinstance(edges, SharpEdges) else edges, "sharp_edges")
    if not pairs.size:
        return np.zeros((0, 2), np.int32)
    if pairs.ndim != 2 or pairs.shape[1] != 2:
        raise Error("invalid-argument", f"sharp_edges: pairs of nodes of the shape (k, 2) are needed, not {pairs.shape}")
    if given.welded is None:
        return pairs
    if not 0 <= pairs.min() <= pairs.max() < given.core.node_count:
        raise Error("invalid-argument", f"sharp_edges: nodes have the numbers 0 to {given.core.node_count - 1}")
    return given.welded.representative[pairs]


def _rules_of(rules: Rules | None, given: Given) -> Callable[[_vspring.Constraints], np.ndarray]:
    """A call that applies the rules, whose file is read once, and returns the sharp edges that they name."""
    if rules is None:
        return lambda held: np.zeros((0, 2), np.int32)
    path = os.fspath(rules) if isinstance(rules, (str, os.PathLike)) else None
    text = (_vspring.read_file(path).decode(errors="surrogateescape") if path is not None
            else _json_of(rules, given.core.node_count))  # type: ignore[arg-type]

    def apply(held: _vspring.Constraints) -> np.ndarray:
        try:
            return held.apply_rules(given.whole, text, given.file, given.welded, given.core.node_count)
        except Error as error:
            if path is None:
                raise
            raise Error(error.code, f"{path}: {error}") from None

    return apply


def _json_of(rules: Mapping[str, Any] | Sequence[Mapping[str, Any]], count: int) -> str:
    whole = rules if isinstance(rules, Mapping) else {"rules": list(rules)}
    if isinstance(whole.get("rules"), (list, tuple)):
        whole = {**whole, "rules": [_plain_rule(rule, count) for rule in whole["rules"]]}
    try:
        return json.dumps(whole, default=lambda value: np.asarray(value).tolist(), allow_nan=False)
    except ValueError:
        raise Error("unusable-constraint", "constraints: a number is not finite") from None


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
            boundary(given.whole)
        return
    single(given.whole, given.nodes_of(nodes, name))
