# SPDX-License-Identifier: Apache-2.0
"""Nodes that publish, subscribe to, call or serve what the project file does not let them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.api import (
    Check,
    End,
    Finding,
    Level,
    Location,
    Project,
    SystemNode,
    alternatives,
    is_slip,
    line_of,
    listed,
)
from haros_ci.api.security import Access, AccessRule

#: What a node does, and what it may do, by the list that says so.
_DOES = {
    "publish": ("publishes", "publish"),
    "subscribe": ("subscribes to", "subscribe to"),
    "call": ("calls", "call"),
    "serve": ("serves", "serve"),
}


def check(project: Project) -> Iterator[Finding]:
    if not project.access:
        return
    access = Access(project.access)
    nodes = [node for system in project.systems for node in system.nodes if node.kind != "library"]
    groups: dict[tuple[object, ...], tuple[tuple[AccessRule, ...], dict[tuple[str, str], End]]] = {}
    for node in nodes:
        for end in node.ends:
            rules = access.refusing(end.kind, end.name, node.name, node.type) if end.known and not end.implicit else ()
            if rules:  # one call is one finding, under however many names it runs
                key = (end.location.sort_key, end.kind, rules, "" if end.in_source else end.name)
                groups.setdefault(key, (rules, {}))[1].setdefault((node.name, end.name), end)
    for rules, ends in groups.values():
        yield _refused(project, list(ends.values()), rules)
    yield from _misspelt(project, nodes)


def _refused(project: Project, ends: list[End], rules: tuple[AccessRule, ...]) -> Finding:
    end = ends[0]
    does, may = _DOES[rules[0].verb]
    allowed = list(dict.fromkeys(pattern for rule in rules for pattern in rule.nodes))
    places = [(place, f"{rule.verb}: {rule.name}") for rule in rules for place in _places(project, rule)]
    where = f" ({line_of(places[0][0])})" if places else ""
    who = f"only {listed(allowed)} may" if allowed else "no node may"
    when = "" if end.node.is_default else " under other launch arguments than the defaults"
    others = [f"{other.node.name} ({other.name})" for other in ends[1:]]
    more = f"; likewise for {listed(others)}" if others else ""
    return Finding(
        at=end.location,
        message=f"{end.node.name} {does} {end.name}{when}, which {who} {may}{where}; take this out, or let the node do it there{more}",
        about=(end.kind, *(name for other in ends for name in (other.node.name, other.name))),
        related=tuple(places),
        apart=(end.kind, *(rule.name for rule in rules), "" if end.in_source else end.name),
    )


def _misspelt(project: Project, nodes: Iterable[SystemNode]) -> Iterator[Finding]:
    """Names in the rules that nothing has, where something else has nearly the same: they protect nothing."""
    ends = {end.name for node in nodes for end in node.ends}
    running = {node.name for node in nodes} | {node.type for node in nodes}
    for rule in project.access:
        for name, known, what in ((rule.name, ends, "nothing"), *((node, running, "no node") for node in rule.nodes)):
            near = sorted(other for other in known if _is_slip(name, other)) if _is_plain(name, known) else []
            for place in _places(project, rule) if near else ():
                yield Finding(
                    at=place,
                    message=f"The access rule for {rule.name} names {name}, which {what} has here; did you mean {alternatives(near)}?",
                    about=(rule.verb, rule.name, name),
                    level=Level.NOTE,
                    apart=(rule.verb, rule.name, name),
                )


def _is_plain(name: str, known: set[str]) -> bool:
    return "*" not in name and name not in known


def _is_slip(one: str, other: str) -> bool:
    """Whether two names differ in one part, by one slip."""
    differing = [pair for pair in zip(one.split("/"), other.split("/")) if pair[0] != pair[1]]
    return one.count("/") == other.count("/") and len(differing) == 1 and is_slip(*differing[0])


def _places(project: Project, rule: AccessRule) -> tuple[Location, ...]:
    """Where the rule stands in the project file; () if that is not in the workspace.

    The rules may be those of the base revision: where they have moved since, their name is looked for.
    """
    path = project.project_file
    if path not in project.workspace.names:
        return ()
    lines = project.text(path).splitlines()
    here = [number for number, line in enumerate(lines, 1) if rule.name in line]
    if not here:
        return (Location(path),)
    return (Location(path, min(here, key=lambda number: abs(number - rule.line))),)


CHECK = Check(
    id="access-not-allowed",
    summary="Node that does what the project file does not let it.",
    level=Level.ERROR,
    catalogue="S03",
    tags=("security",),
    project=check,
)
