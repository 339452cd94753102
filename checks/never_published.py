# SPDX-License-Identifier: Apache-2.0
"""Topics that a node of a closed system publishes only in answer to messages that nobody publishes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Decidability, End, Finding, Level, Project, System, SystemNode, listed, unmet

if TYPE_CHECKING:  # it is loaded where there is something to ask
    from haros_ci.api.dependence import Output


def check(project: Project) -> Iterator[Finding]:
    for system in project.systems:
        silent = _silent(system)
        for node in system.nodes:
            if silent and any(end.name in silent for end in node.of("subscribers")):
                yield from _of_node(project, system, node, silent)


def _silent(system: System) -> frozenset[str]:
    """The topics that are subscribed to, and that certainly nobody publishes; none where something outside may."""
    found = unmet(system, system.topics, "givers", lambda topic: "")
    return frozenset(str(finding.about[0]) for finding in found)


def _of_node(project: Project, system: System, node: SystemNode, silent: frozenset[str]) -> Iterator[Finding]:
    from haros_ci.api.dependence import node_dependence

    for output in node_dependence(node.raw, project.code).outputs:
        if output.kind != "publishers" or "?" in output.name or not _is_never(output, silent):
            continue
        end = next(end for end in node.of("publishers") if end.name == output.name and not end.implicit)
        topics = sorted({cause.name for cause in output.causes if not cause.state})
        yield _finding(node, end, output, topics)


def _is_never(output: Output, silent: frozenset[str]) -> bool:
    """Whether it is published in callbacks of *silent* topics alone."""
    direct = [cause for cause in output.causes if not cause.state]
    if output.reason or output.is_start or not direct:
        return False
    return all(cause.kind == "subscription" and not cause.reason and cause.name in silent for cause in direct)


def _finding(node: SystemNode, end: End, output: Output, topics: list[str]) -> Finding:
    first = next(cause for cause in output.causes if not cause.state)
    return Finding(
        at=end.location,
        message=(
            f"{node} publishes {output.name} only in callbacks of {listed(topics)}, which no node of the system publishes: it "
            "is never published; remap what triggers it, or start a node that publishes that"
        ),
        about=(end, "never", *topics),
        flow=first.path,
    )


CHECK = Check(
    id="never-published",
    summary="Topic that is published only in answer to what nobody publishes.",
    level=Level.WARNING,
    decidability=Decidability.CLOSED_WORLD,
    tags=("topics", "code"),
    project=check,
)
