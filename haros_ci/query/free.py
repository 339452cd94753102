# SPDX-License-Identifier: Apache-2.0
"""Which variables a part of a query takes from outside it."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from haros_ci.query.syntax import And, Chain, Flwr, Path, Quantified, QueryFunction, Tree


def free(tree: Any) -> frozenset[str]:
    """Names that *tree* uses and does not bind itself; global ones are among them."""
    if isinstance(tree, tuple):
        return frozenset().union(*map(free, tree))
    if isinstance(tree, Path):
        inside = free(tuple(step.condition for step in tree.steps)) - {"self"}
        return inside | {tree.steps[0].name}
    if isinstance(tree, Chain):
        return free(tree.links) | {tree.name}
    if isinstance(tree, Quantified):
        return free(tree.source) | (free(tree.condition) - {tree.name})
    if isinstance(tree, QueryFunction):
        return free(tree.body) - set(tree.parameters)
    if isinstance(tree, Flwr):
        bound = {*(one.name for one in tree.fors), *(one.name for one in tree.lets)}
        inside = free((*(let.value for let in tree.lets), tree.where, tree.output, tree.collects))
        return free(tuple(one.source for one in tree.fors)) | (inside - bound) | shadowed(tree)
    if hasattr(tree, "__dataclass_fields__"):
        return frozenset().union(*(free(getattr(tree, field.name)) for field in fields(tree)))
    return frozenset()


def shadowed(tree: Flwr) -> frozenset[str]:
    """Outer variables that a ``let`` uses before it gives their name to something else."""
    known = {one.name for one in tree.fors}
    found: set[str] = set()
    for let in tree.lets:
        found |= free(let.value) - known
        known.add(let.name)
    return frozenset(found)


def conjuncts(tree: Tree | None) -> tuple[Tree, ...]:
    """The conditions that ``and`` joins."""
    if isinstance(tree, And):
        return tuple(part for item in tree.items for part in conjuncts(item))
    return () if tree is None else (tree,)
