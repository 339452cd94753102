# SPDX-License-Identifier: Apache-2.0
"""The configurations as the page has them: rows of nodes, ends and parameters, and the picture of each."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from typing import Any

from haros_ci.checking.transforms import Broadcast
from haros_ci.forks import shared
from haros_ci.html_page.dependence import dependence
from haros_ci.html_page.elements import Elements, elements
from haros_ci.html_page.launches import launch_tree
from haros_ci.html_page.layout import Layout, laid_out
from haros_ci.html_page.pool import NONE, Pool, presence_text
from haros_ci.html_page.transforms import transforms
from haros_ci.html_page.variants import variants
from haros_ci.model.architecture import KINDS, PROVENANCES, Configuration, Endpoint, Node, Parameter, Qos
from haros_ci.model.rates import Rate, total
from haros_ci.report.channels import UNKNOWN, endpoints_of, nodes_of, parameters_of
from haros_ci.report.model_json import plain

#: Bits of an end.
IMPLICIT, RULED_OUT, LATCHED, READ_ONLY = 1, 2, 4, 8
#: Characters of a value that are shown.
LONGEST_VALUE = 300


def configurations(
    pool: Pool, found: Iterable[Configuration], broadcasts: Mapping[str, Sequence[Broadcast]], processes: int = 1
) -> list[dict[str, Any]]:
    """Every configuration by name; those that only single programs make come after those of launch files.

    Their pictures are laid out by so many *processes*.
    """
    ordered = sorted(found, key=lambda one: (not one.launch, one.name))
    every = [elements(one) for one in ordered]
    layouts = shared([partial(laid_out, made) for made in every], range(len(every)), processes)
    return [
        {**_configuration(pool, one, made, layout), "transforms": transforms(pool, broadcasts.get(one.name, ()))}
        for one, made, layout in zip(ordered, every, layouts, strict=True)
    ]


def _configuration(pool: Pool, one: Configuration, made: Elements, layout: Layout | None) -> dict[str, Any]:
    ends = [end for node in one.nodes for end in node.endpoints if not end.implicit]
    return {
        "name": pool.text(one.name),
        "launch": pool.texts(one.launch),
        "arguments": [(pool.text(name), pool.text(str(plain(value)))) for name, value in one.arguments],
        "nodes": [_node(pool, node) for node in made.nodes],
        "parameters": [_parameter(pool, parameter) for parameter in parameters_of(one)],
        "others": [(_node(pool, node), pool.text(presence_text(node.presence))) for node in _others(one)],
        "variants": variants(pool, one, made.nodes, _others(one)),
        "unknown": (sum(UNKNOWN in end.name for end in ends), len(ends)),
        "picture": NONE if layout is None else pool.row("pictures", _picture(pool, made, layout)),
        "tree": launch_tree(pool, one),
        "rates": _rates(pool, one),
        "dependence": dependence(pool, one, made.nodes),
    }


def _rates(pool: Pool, one: Configuration) -> dict[str, Any]:
    """In words how often each node publishes on each topic, and of topics the sums; nothing where rates were not asked for."""
    every: dict[tuple[str, str], list[Rate]] = {}
    for found in one.rates.published if one.rates is not None else ():
        every.setdefault((found.node, found.topic), []).append(found.rate)
    return {
        "published": [
            (pool.text(node), pool.text(topic), pool.text(str(total(rates)))) for (node, topic), rates in every.items()
        ],
        "topics": [
            (pool.text(topic), pool.text(str(rate)))
            for topic, rate in (one.rates.topics if one.rates is not None else ())
        ],
    }


def _others(one: Configuration) -> tuple[Node, ...]:
    """The nodes of other launch arguments, by name and place."""
    return nodes_of(Configuration(name=one.name, nodes=one.alternatives))


def _picture(pool: Pool, made: Elements, layout: Layout) -> tuple[Any, ...]:
    """Size, boxes, nodes with their box, channels, edges, and what only one node has: its lines in the picture."""
    boxes = zip(made.boxes, layout.boxes, strict=True)
    channels = zip(made.channels, layout.channels, strict=True)
    return (
        layout.size,
        tuple((box.kind, pool.text(box.name), box.parent, *place) for box, place in boxes),
        tuple((box, *place) for box, place in zip(made.box_of, layout.nodes, strict=True)),
        tuple(
            (channel.channel.what, pool.text(channel.channel.name), channel.switch, channel.box, *place)
            for channel, place in channels
        ),
        tuple((node, channel, int(gives), points) for node, channel, gives, points in layout.edges),
    )


def _node(pool: Pool, node: Node) -> int:
    row = (
        pool.text(node.name),
        node.kind,
        pool.text(node.package),
        pool.text(node.type),
        pool.text(node.class_name),
        node.ros,
        pool.text(node.container),
        pool.text(node.arguments),
        tuple((pool.text(a), pool.text(b)) for a, b in node.remaps),
        pool.conditions(node.conditions),
        pool.place(node.location),
        _source(node.source),
        pool.unknowns(node.unknowns),
        pool.text(presence_text(node.presence)),
        tuple(_end(pool, end) for end in endpoints_of(node)),
    )
    return pool.row("nodes", row)


def _end(pool: Pool, end: Endpoint) -> int:
    bits = (
        IMPLICIT * end.implicit
        + RULED_OUT * end.is_ruled_out
        + LATCHED * bool(end.latched)
        + READ_ONLY * bool(end.read_only)
    )
    is_parameter = end.kind in ("getters", "setters", "parameters")
    more: tuple[Any, ...] = (
        (_value(pool, end.value), _value(pool, end.effective), tuple(plain(one) for one in end.range or ()))
        if is_parameter
        else (end.queue_size if isinstance(end.queue_size, int) else NONE, _qos(pool, end.qos))
    )
    row = (
        KINDS.index(end.kind),
        pool.text(end.name),
        pool.text(end.original_name),
        pool.text(end.type),
        bits,
        pool.conditions(end.conditions),
        pool.place(end.location),
        _source(end.source),
        pool.unknowns(end.unknowns),
        *more,
    )
    return pool.row("ends", row)


def _parameter(pool: Pool, one: Parameter) -> int:
    row = (
        pool.text(one.name),
        pool.text(one.type),
        _value(pool, one.value),
        pool.conditions(one.conditions),
        pool.place(one.location),
        pool.place(one.origin),
        _source(one.source),
        pool.unknowns(one.unknowns),
    )
    return pool.row("parameters", row)


def _qos(pool: Pool, qos: Qos | None) -> int:
    """The index of a list of names and values, without those that are the middleware's default."""
    if qos is None:
        return NONE
    values = {
        "history": qos.history,
        "depth": qos.depth,
        "reliability": qos.reliability,
        "durability": qos.durability,
        "deadline": qos.deadline,
        "lifespan": qos.lifespan,
        "liveliness": qos.liveliness,
        "lease": qos.lease,
    }
    policies = tuple((name, pool.text(str(plain(value)))) for name, value in values.items() if value is not None)
    return pool.row("qos", policies)


def _value(pool: Pool, value: object) -> int:
    """The text of a value, cut; ``NONE`` for none."""
    if value is None:
        return NONE
    text = value if isinstance(value, str) else json.dumps(plain(value), ensure_ascii=False)
    return pool.text(text if len(text) <= LONGEST_VALUE else f"{text[: LONGEST_VALUE - 1]}…")


def _source(source: str) -> int:
    return PROVENANCES.index(source) if source in PROVENANCES else NONE
