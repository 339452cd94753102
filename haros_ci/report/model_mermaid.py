# SPDX-License-Identifier: Apache-2.0
"""The architecture as Mermaid flowcharts, for job summaries and other Markdown that GitHub shows.

Nodes are boxes, topics stadiums, services diamonds, actions hexagons; conditional is dashed, unknown red.
"""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.model.architecture import Architecture, Configuration
from haros_ci.regex import regex
from haros_ci.report.channels import Channel, channels, is_known, nodes_of
from haros_ci.report.escape import markdown, terminal
from haros_ci.report.model_rates import known_rates
from haros_ci.report.summary import plural

#: What Mermaid draws at most by default (mermaid.js.org, maxTextSize and maxEdges).
MAX_TEXT = 50_000
MAX_EDGES = 500
BRACKETS = {"topics": ("([", "])"), "services": ("{", "}"), "actions": ("{{", "}}")}
STYLES = ("classDef conditional stroke-dasharray:5 5", "classDef unknown stroke:red,color:red")

_ACTIVE = regex(r"[^A-Za-z0-9_/?.~, -]|\A[^A-Za-z/]")


def render(architecture: Architecture) -> str:
    """Markdown: a heading and a fenced diagram for each configuration, or why there is none."""
    blocks = []
    for configuration in sorted(architecture.configurations, key=lambda item: item.name):
        blocks.append(f"### {markdown(configuration.name)}\n\n{_body(configuration)}")
    return "\n".join(blocks) or "No configurations.\n"


def diagram(configuration: Configuration) -> str:
    """The flowchart of one configuration, without a fence; implicit endpoints are left out."""
    lines = ["flowchart LR", *(f"  {line}" for line in (*_lines(configuration), *STYLES))]
    return "\n".join(lines) + "\n"


def label(text: str) -> str:
    """*text* in double quotes; every character that Mermaid or Markdown could act on is its ``#code;`` entity.

    So is a first character that could begin a list; an empty text, which Mermaid refuses, is a space.
    """
    return '"' + _ACTIVE.sub(lambda match: f"#{ord(match[0])};", terminal(text) or " ") + '"'


def _body(configuration: Configuration) -> str:
    text = diagram(configuration)
    edges = sum(1 for line in text.splitlines() if " -->" in line or " -.->" in line)
    if edges > MAX_EDGES or len(text) > MAX_TEXT:
        size = f"{plural(len(configuration.nodes), 'node')}, {plural(edges, 'edge')}"
        return f"Too large for a diagram here ({size}): print it as DOT and draw it with GraphViz.\n"
    return f"```mermaid\n{text}```\n"


def _lines(configuration: Configuration) -> Iterator[str]:
    nodes = nodes_of(configuration)
    ids = {id(node): f"n{number}" for number, node in enumerate(nodes)}
    rates = known_rates(configuration)
    for node in nodes:
        unknown = not (is_known(node.name) and is_known(node.type) and is_known(node.package))
        yield f"{ids[id(node)]}[{label(node.name)}]"
        yield from _classes(ids[id(node)], bool(node.conditions), unknown)
    for number, channel in enumerate(item for item in channels(configuration) if not item.implicit):
        name = f"{channel.what[0]}{number}x"
        opening, closing = BRACKETS[channel.what]
        yield f"{name}{opening}{label(channel.name)}{closing}"
        known = is_known(channel.name) and all(is_known(end.type) for _, end in channel.ends)
        yield from _classes(name, channel.conditional, not known)
        yield from _edges(channel, name, ids, rates)


def _edges(channel: Channel, name: str, ids: dict[int, str], rates: dict[tuple[str, str], str]) -> Iterator[str]:
    for (tail, head), (conditional, rate) in channel.edges(name, ids, rates).items():
        text = f"|{label(rate)}|" if rate else ""
        yield f"{tail} {'-.->' if conditional else '-->'}{text} {head}"


def _classes(name: str, conditional: bool, unknown: bool) -> Iterator[str]:
    if conditional:
        yield f"class {name} conditional"
    if unknown:
        yield f"class {name} unknown"
