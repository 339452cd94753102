# SPDX-License-Identifier: Apache-2.0
"""Private parameters of a ROS 1 node that neither it nor another node reads."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, Parameter, Status, System, SystemNode

#: Private parameters that client libraries and tools read (wiki.ros.org: tf, rosconsole, topic_tools, image_transport).
OF_LIBRARIES = frozenset("tf_prefix use_sim_time num_worker_threads diagnostic_period image_transport".split())


def check(system: System) -> Iterator[Finding]:
    reads = [end for end in system.ends if end.kind in ("getters", "setters") and end.node.ros == 1]
    named = {part for end in reads for part in _around(end.name)}
    read = {end.name for end in reads}
    vague = sorted({".*".join(map(re.escape, end.name.split("?"))) for end in reads if "?" in end.name})
    perhaps = re.compile("|".join(vague)) if vague else None
    nodes = {node.name: node for node in system.nodes if node.ros == 1 and node.known and node.complete}
    for parameter in system.parameters:
        node = _owner(parameter, nodes)
        if node is None or parameter.name in named or any(part in read for part in _around(parameter.name)):
            continue
        if perhaps is not None and perhaps.fullmatch(parameter.name):
            continue
        yield Finding(
            at=parameter.origin or parameter.location or node.location,
            message=f"{node} is given the parameter {parameter.name}, but neither {node.type} nor another node reads it: the value "
            "has no effect; correct the name, or remove it",
            about=(node, parameter.name),
        )


def _owner(parameter: Parameter, nodes: dict[str, SystemNode]) -> SystemNode | None:
    """The node whose private parameter it is, if it is one that a library does not read."""
    if "?" in parameter.name or parameter.name.rpartition("/")[2] in OF_LIBRARIES:
        return None
    return next((nodes[space] for space in _around(parameter.name) if space in nodes and space != parameter.name), None)


def _around(name: str) -> Iterator[str]:
    """The name itself and the namespaces that it is in."""
    while name:
        yield name
        name = name.rpartition("/")[0]


CHECK = Check(
    id="parameter-not-read",
    summary="Parameter set for a node that does not read it.",
    level=Level.WARNING,
    decidability=Decidability.HEURISTIC,
    status=Status.PREVIEW,
    tags=("parameters",),
    run=check,
)
