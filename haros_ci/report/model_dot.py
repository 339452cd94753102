# SPDX-License-Identifier: Apache-2.0
"""The architecture as a GraphViz digraph: a cluster per configuration, nodes as boxes, topics as ellipses.

Services are diamonds, actions hexagons. What is conditional is dashed, what has an unknown name or type is red.
"""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.model.architecture import Architecture, Configuration
from haros_ci.report.channels import Channel, channels, is_known, nodes_of
from haros_ci.report.escape import terminal
from haros_ci.report.model_rates import known_rates

SHAPES = {"topics": "ellipse", "services": "diamond", "actions": "hexagon"}


def render(architecture: Architecture) -> str:
    """One digraph for ``dot``; implicit endpoints are left out, as every node would connect to them."""
    configurations = sorted(architecture.configurations, key=lambda item: item.name)
    lines = ["digraph architecture {", "  rankdir=LR;", "  node [fontname=Helvetica];"]
    for number, configuration in enumerate(configurations):
        lines += (f"  {line}" for line in _cluster(configuration, f"c{number}"))
    return "\n".join([*lines, "}", ""])


def quoted(text: str) -> str:
    """*text* as a double-quoted DOT string that is shown as it stands.

    In one a backslash begins an escape sequence and an ampersand an HTML entity (graphviz.org, escString and character
    sets); a line break or control character becomes U+FFFD.
    """
    return '"' + _inner(text) + '"'


def _inner(text: str) -> str:
    return terminal(text).replace("&", "&amp;").replace("\\", "\\\\").replace('"', '\\"')


def _cluster(configuration: Configuration, prefix: str) -> Iterator[str]:
    nodes = nodes_of(configuration)
    ids = {id(node): f"{prefix}n{number}" for number, node in enumerate(nodes)}
    yield f"subgraph cluster_{prefix} {{"
    yield f"  label={quoted(configuration.name)};"
    for node in nodes:
        label = f'"{_inner(node.name)}\\n{_inner(f"{node.package}/{node.type}")}"'
        unknown = not (is_known(node.name) and is_known(node.type) and is_known(node.package))
        yield f"  {ids[id(node)]} [label={label}, shape=box{_style(bool(node.conditions), unknown)}];"
    rates = known_rates(configuration)
    shown = (channel for channel in channels(configuration) if not channel.implicit)
    for number, channel in enumerate(shown):
        yield from _channel(channel, f"{prefix}{channel.what[0]}{number}", ids, rates)
    yield "}"


def _channel(channel: Channel, name: str, ids: dict[int, str], rates: dict[tuple[str, str], str]) -> Iterator[str]:
    types = [*channel.types, *(["?"] if any(not is_known(end.type) for _, end in channel.ends) else [])]
    label = f'"{_inner(channel.name)}\\n{_inner(", ".join(types))}"'
    style = _style(channel.conditional, not is_known(channel.name) or "?" in types)
    yield f"  {name} [label={label}, shape={SHAPES[channel.what]}{style}];"
    for (tail, head), (conditional, rate) in channel.edges(name, ids, rates).items():
        look = ["style=dashed"] if conditional else []
        look += [f"label={quoted(rate)}"] if rate else []
        text = f" [{', '.join(look)}]" if look else ""
        yield f"  {tail} -> {head}{text};"


def _style(conditional: bool, unknown: bool) -> str:
    return (", style=dashed" if conditional else "") + (", color=red, fontcolor=red" if unknown else "")
