# SPDX-License-Identifier: Apache-2.0
"""What a change renames or removes, and the workspace still refers to under the old name."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, End, Finding, Level, Location, Project, System
from haros_ci.api.changes import CHANGED_ENDS, Causes, Change, Lost, both, change_said, lost_in

#: What the ends that are left over do with a topic, service or action that nobody gives.
DOES = {
    "subscribers": ("listens to", "it gets nothing any more"),
    "clients": ("calls", "no call gets an answer"),
    "action_clients": ("sends goals to", "no goal is taken"),
}
#: A display's topic in a configuration of rviz.
_RVIZ = re.compile(r"^\s*(?:Topic|Value|Image Topic|Marker Topic): [\"']?(/[\w/]+)[\"']?\s*(?:#.*)?$")
#: The largest configuration of rviz that is looked into, in characters.
MAX_RVIZ = 500_000
SHOWN = 10


def check(project: Project) -> Iterator[Finding]:
    if project.base is None:
        return
    yield from _ends(project)
    causes = Causes(project)
    for old, new in both(project):
        if causes.touches(new):
            yield from _remaps(old, new, causes)
            yield from _values(new, causes)
    yield from _displays(project)


def _ends(project: Project) -> Iterator[Finding]:
    """Ends at a name that nobody gives any more, one finding for each call."""
    told: dict[tuple[str, Location], tuple[Lost, dict[str, End]]] = {}
    for lost in lost_in(project):
        for end in lost.left:
            told.setdefault((lost.name, end.location), (lost, {}))[1].setdefault(end.node.name, end)
    for (name, at), (lost, ends) in told.items():
        nodes = sorted(ends)
        end = ends[nodes[0]]
        does, result = DOES[end.kind]
        who = nodes[0] + (f" and {len(nodes) - 1} more" if len(nodes) > 1 else "")
        if lost.is_new_name:
            said = f"{who} {does} {end.name} now, as {name} was {change_said(lost.change, name)}, but only {name} is given: {result}"
        else:
            said = f"{who} still {does} {name}, {_gone(lost.change, name)}: {result}"
        yield Finding(
            at=at,
            message=f"{said}; give both the same name, or remap one",
            about=(name, *nodes[:SHOWN]),
            related=tuple(_cause(lost.change)),
        )


def _gone(change: Change, name: str) -> str:
    if change.what == "node":
        old = (change.old_names or change.names)[0]
        return f"whose node {old} was {change_said(change, old)}"
    return f"which was {change_said(change, name)}"


def _cause(change: Change) -> Iterator[tuple[Location, str]]:
    if change.head is not None:
        yield change.head, f"the {change.what} has its new name here"


def _remaps(old: System, new: System, causes: Causes) -> Iterator[Finding]:
    """Rules for a name that an end of the node had, and has no more."""
    before = {node.name: node for node in old.nodes}
    for node in new.nodes:
        was = before.get(node.name)
        if was is None or not node.known:
            continue
        names = {end.original_name for end in node.ends}
        for rule in node.raw.rules:
            if rule.source_name is None or rule.source_name in names:
                continue
            for end in was.ends:
                if end.original_name != rule.source_name or end.implicit:
                    continue
                change = causes.named(CHANGED_ENDS.get(end.kind, "parameter"), end.name, new)
                if change is not None and not any(not other.known for other in node.of(end.kind)):
                    yield Finding(
                        at=rule.location,
                        message=(
                            f"{rule.source} of {node} is still remapped to {rule.target} here, but the {end.word} was "
                            f"{change_said(change, end.name)}: the rule does nothing"
                        ),
                        about=(node.name, rule.source_name),
                        related=tuple(_cause(change)),
                    )
                    break


def _values(new: System, causes: Causes) -> Iterator[Finding]:
    """Values for a parameter that the node had, and has no more."""
    for given in new.given:
        if given.node.names.has(given.key) or given.node.raw.takes_undeclared:
            continue
        name = f"{given.node.name}:{given.key}"
        change = causes.named("parameter", name, new)
        if change is not None and given.key not in given.node.names.declared:
            yield _value(given.at, name.partition(":")[2], given.node.name, change, name)
    read = {end.name for node in new.nodes for end in node.of("getters")}
    for parameter in new.parameters:
        if ":" in parameter.name or parameter.name in read or parameter.unknowns:
            continue
        change = causes.named("parameter", parameter.name, new)
        at = parameter.origin or parameter.location
        if change is not None and at is not None:
            yield _value(at, parameter.name, change.nodes[0] if change.nodes else "", change, parameter.name)


def _value(at: Location, key: str, node: str, change: Change, name: str) -> Finding:
    owner = f" of {node}" if node else ""
    return Finding(
        at=at,
        message=f"{key}{owner} is still set here, but the parameter was {change_said(change, name)}: the value has no effect",
        about=(node or key, key),
        related=tuple(_cause(change)),
    )


def _displays(project: Project) -> Iterator[Finding]:
    """Displays of rviz for a topic that nobody publishes any more."""
    base = project.base
    if base is None:
        return
    changes = {
        name: change
        for change in Causes(project).all
        if change.what == "publisher"
        for name in (change.old_names or change.names)
        if "?" not in name
    }
    if not changes:
        return
    given = {channel.name for system in project.systems for channel in system.topics if channel.givers}
    for path in sorted(project.workspace.names):
        if not path.endswith(".rviz"):
            continue
        for number, line in enumerate(project.text(path)[:MAX_RVIZ].splitlines(), 1):
            match = _RVIZ.match(line)
            if match and match[1] in changes and match[1] not in given:
                change = changes[match[1]]
                yield Finding(
                    at=Location(path, number),
                    message=f"rviz still shows {match[1]}, which was {change_said(change, match[1])}: the display stays empty",
                    about=(match[1], path),
                    related=tuple(_cause(change)),
                )


CHECK = Check(
    id="graph-change",
    summary="What a change renames or removes is referred to nowhere under its old name.",
    level=Level.WARNING,
    catalogue="G18",
    tags=("topics", "services", "parameters", "change"),
    project=check,
)
