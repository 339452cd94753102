# SPDX-License-Identifier: Apache-2.0
"""Which inputs of a node can cause which of its outputs, as the page has it: a row for each node."""

from __future__ import annotations

from collections.abc import Sequence

from haros_ci.html_page.pool import NONE, Pool
from haros_ci.model.architecture import KINDS, Configuration, Node
from haros_ci.model.dependence import DIRECT, PERHAPS, STATE, Cause, Input, NodeDependence, Output

#: How an input leads to an output, by its number on the page.
WAYS = (DIRECT, STATE, PERHAPS)
#: Conditions and places of one way that are shown.
MOST_STEPS = 24


def dependence(pool: Pool, one: Configuration, nodes: Sequence[Node]) -> tuple[int, ...]:
    """For each of *nodes* the index of its row, ``NONE`` for one of which nothing was asked; () where nothing was."""
    if one.dependence is None:
        return ()
    found = {id(node): made for node, made in zip(one.nodes, one.dependence.nodes, strict=True)}
    return tuple(_node(pool, found[id(node)]) if id(node) in found else NONE for node in nodes)


def _node(pool: Pool, made: NodeDependence) -> int:
    row = (
        pool.text(made.reason or None),
        tuple(_input(pool, one) for one in made.inputs),
        tuple(_output(pool, one) for one in made.outputs),
    )
    return pool.row("dependence", row)


def _input(pool: Pool, one: Input) -> tuple[int, int, int, int]:
    return pool.text(one.kind), pool.text(one.name), pool.place(one.location), pool.text(one.reason or None)


def _output(pool: Pool, one: Output) -> tuple[object, ...]:
    causes = tuple(_cause(pool, cause) for cause in one.causes)
    return KINDS.index(one.kind), pool.text(one.name), int(one.is_start), pool.text(one.reason or None), causes


def _cause(pool: Pool, one: Cause) -> int:
    whens = tuple(
        (pool.text(when.text), int(when.is_met), pool.texts(when.reads), pool.place(when.location))
        for when in one.conditions[:MOST_STEPS]
    )
    path = tuple((pool.place(at), pool.text(text)) for at, text in one.path[:MOST_STEPS])
    row = (
        pool.text(one.kind),
        pool.text(one.name),
        WAYS.index(one.how),
        int(one.is_each),
        pool.texts(one.state),
        pool.text(one.reason or None),
        pool.place(one.location),
        whens,
        path,
    )
    return pool.row("causes", row)
