# SPDX-License-Identifier: Apache-2.0
"""The dependence of configurations as a GraphViz digraph and as Mermaid flowcharts: what leads to what, in which node.

Topics are ellipses, services diamonds, actions hexagons, timers and other causes plain boxes. Through state is dashed, what may be is dotted; what nobody
knows is left out.
"""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.model.architecture import Architecture, Configuration
from haros_ci.model.dependence import DIRECT, PERHAPS, STATE, UNKNOWN, Reached
from haros_ci.model.dependence_edges import edges
from haros_ci.report.escape import markdown, terminal
from haros_ci.report.model_dot import quoted
from haros_ci.report.model_mermaid import MAX_EDGES, MAX_TEXT, label

SHAPES = {"topic": "ellipse", "service": "diamond", "action": "hexagon"}
BRACKETS = {"topic": ("([", "])"), "service": ("{", "}"), "action": ("{{", "}}")}
STYLES = {DIRECT: "solid", STATE: "dashed", PERHAPS: "dotted"}
ARROWS = {DIRECT: "-->", STATE: "-.->", PERHAPS: "-.->"}
RANKS = {DIRECT: 0, STATE: 1, PERHAPS: 2}


def dot(architecture: Architecture) -> str:
    """One digraph with a cluster for each configuration."""
    text = ["digraph dependence {", "  rankdir=LR;", "  node [fontname=Helvetica];", "  edge [fontname=Helvetica];"]
    for number, configuration in enumerate(_ordered(architecture)):
        places, drawn = _drawn(configuration)
        text += [f"  subgraph cluster_c{number} {{", f"    label={quoted(configuration.name)};"]
        ids = {place: f"c{number}p{count}" for count, place in enumerate(places)}
        for place, name in ids.items():
            text.append(f"    {name} [label={quoted(_title(place))}, shape={SHAPES.get(place[0], 'box')}];")
        for edge in drawn:
            style = f"label={quoted(_words(edge))}, style={STYLES[edge.how]}"
            text.append(f"    {ids[_source(edge)]} -> {ids[(*edge.target, '')]} [{style}];")
        text.append("  }")
    return "\n".join([*text, "}", ""])


def mermaid(architecture: Architecture) -> str:
    """Markdown: a heading and a fenced flowchart for each configuration, or why there is none."""
    blocks = []
    for configuration in _ordered(architecture):
        text = "\n".join(["flowchart LR", *(f"  {line}" for line in _flow(configuration)), ""])
        if text.count("\n") > MAX_EDGES or len(text) > MAX_TEXT:
            body = "Too large for a diagram here: print it as DOT and draw it with GraphViz.\n"
        else:
            body = f"```mermaid\n{text}```\n"
        blocks.append(f"### {markdown(configuration.name)}\n\n{body}")
    return "\n".join(blocks) or "No configurations.\n"


def _flow(configuration: Configuration) -> Iterator[str]:
    places, drawn = _drawn(configuration)
    ids = {place: f"p{count}x" for count, place in enumerate(places)}
    for place, name in ids.items():
        opening, closing = BRACKETS.get(place[0], ("[", "]"))
        yield f"{name}{opening}{label(_title(place))}{closing}"
    for edge in drawn:
        yield f"{ids[_source(edge)]} {ARROWS[edge.how]}|{label(_words(edge))}| {ids[(*edge.target, '')]}"


def _ordered(architecture: Architecture) -> list[Configuration]:
    return sorted(architecture.configurations, key=lambda one: one.name)


def _drawn(configuration: Configuration) -> tuple[tuple[tuple[str, str, str], ...], tuple[Reached, ...]]:
    """What stands at the ends of edges, and the edges: of each two ends in a node the best one."""
    dependence = configuration.dependence
    if dependence is None:
        return (), ()
    if dependence.slices:
        every = [step for one in dependence.slices for step in one.steps]
    else:
        every = list(edges(dependence))
    best: dict[tuple[object, ...], Reached] = {}
    for edge in every:
        key = edge.node, _source(edge), edge.target
        if edge.how != UNKNOWN and (key not in best or RANKS[edge.how] < RANKS[best[key].how]):
            best[key] = edge
    places = dict.fromkeys(place for edge in best.values() for place in (_source(edge), (*edge.target, "")))
    return tuple(sorted(places)), tuple(best.values())


def _source(edge: Reached) -> tuple[str, str, str]:
    """What an edge begins at: timers are those of their node."""
    return (*edge.source, "" if edge.source[1] else edge.node)


def _title(place: tuple[str, str, str]) -> str:
    kind, name, node = place
    return name or f"{kind} of {node}"


def _words(edge: Reached) -> str:
    cause = edge.cause
    words = [edge.node]
    if cause is not None and cause.state:
        words.append(f"state {', '.join(cause.state[:3])}")
    if cause is not None and cause.conditions:
        words.append("if " + terminal(cause.conditions[0].text)[:40])
    return "; ".join(words)
