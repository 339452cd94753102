# SPDX-License-Identifier: Apache-2.0
"""What a change renames or removes, and the workspace still refers to under the old name."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, End, Finding, Level, Location, Project, System, regex
from haros_ci.api.changes import (
    CHANGED_ENDS,
    Causes,
    Change,
    Lost,
    both,
    change_said,
    has_unseen,
    is_unseen,
    left_out,
    lost_in,
    replaced,
)

#: What the ends that are left over do with a topic, service or action that nobody gives.
DOES = {
    "subscribers": ("listens to", "it receives no messages any more"),
    "clients": ("calls", "no call gets an answer"),
    "action_clients": ("sends goals to", "no goal is accepted"),
}
#: A display's topic in a configuration of rviz.
_RVIZ = regex(r"^\s*(?:Topic|Value|Image Topic|Marker Topic): [\"']?(/[\w/]+)[\"']?\s*(?:#.*)?$")
#: The largest configuration of rviz that is looked into, in characters.
MAX_RVIZ = 500_000
SHOWN = 10
#: Ends that have a type which others have to have, too.
_TYPED = frozenset(("publishers", "subscribers", "servers", "clients", "action_servers", "action_clients"))
#: What is renamed, and not taken away, is meant to be there: whoever has the old name is an error.
RENAMED = "renamed"


def check(project: Project) -> Iterator[Finding]:
    if project.base is None:
        return
    yield from _ends(project)
    causes = Causes(project)
    for old, new in both(project):
        if causes.touches(new):
            yield from _remaps(old, new, causes)
    yield from _values(project, causes)
    yield from _displays(project)
    yield from _types(project)
    yield from _names(project)
    yield from _nodes(project)


def _nodes(project: Project) -> Iterator[Finding]:
    """Nodes that a launch file still makes and does not start any more, and those that may be of another class."""
    reported: set[tuple[Location, str]] = set()
    for place, node in left_out(project):
        if (place, node.name) not in reported:
            reported.add((place, node.name))
            yield Finding(
                at=place,
                message=(
                    f"{node.name} is not seen to be started any more, though the launch file still names its program {node.raw.type}: it is not "
                    "among the actions that are given back, as far as these are known; take it away, or start it"
                ),
                about=(node.name, node.type),
                level=Level.NOTE,
            )
    for node, unknown in replaced(project):
        place = unknown.location or node.location
        if (place, unknown.reason) not in reported:
            reported.add((place, unknown.reason))
            message = f"{node.name} is not wholly known since the change: {unknown.reason}, with other topics, services or types; look at it"
            yield Finding(at=place, message=message, about=(node.name, unknown.reason), level=Level.NOTE)


def _names(project: Project) -> Iterator[Finding]:
    """Ends of nodes whose names were known, and are not since the change."""
    reported: set[Location] = set()
    for old, new in both(project):
        before = {node.name: node for node in old.nodes}
        for node in new.nodes:
            was = before.get(node.name)
            if was is None:
                continue
            for kind in sorted(_TYPED):
                vague = [end for end in node.of(kind) if "?" in end.name and end.in_source]
                known = {end.name for end in node.of(kind)}
                lost = sorted({end.name for end in was.of(kind) if "?" not in end.name and end.in_source} - known)
                if not lost or len(vague) <= sum("?" in end.name for end in was.of(kind)):
                    continue
                end = max(vague, key=lambda one: one.location.sort_key)
                if end.location not in reported:
                    reported.add(end.location)
                    yield Finding(
                        at=end.location,
                        message=(
                            f"the name of a {end.word} in {node} is not known any more{_why(end, 'name')}, before the change it had "
                            f"{lost[0]}: no check compares it with those of others; look at it, or write the name where it is used"
                        ),
                        about=(lost[0], kind, node.name),
                        level=Level.NOTE,
                    )


def _types(project: Project) -> Iterator[Finding]:
    """Ends whose type was known, and is not since the change: no check compares it any more."""
    reported: set[Location] = set()
    for old, new in both(project):
        before = {(end.node.name, end.kind, end.name): end.type for end in old.ends if end.type is not None}
        known = {(end.node.name, end.kind, end.name) for end in new.ends if end.type is not None}
        for end in new.ends:
            place = (end.node.name, end.kind, end.name)
            if place in known or place not in before or "?" in end.name or end.implicit or not end.in_source:
                continue
            if end.kind in _TYPED and end.location not in reported:
                reported.add(end.location)
                yield Finding(
                    at=end.location,
                    message=(
                        f"the type of the {end.word} of {end.name} in {end.node} is not known any more{_why(end, 'type')}, it was {before[place]}: "
                        "no check compares it with those of others; look at it, or name the type where it is used"
                    ),
                    about=(end.name, end.kind, end.node.name),
                    level=Level.NOTE,
                )


def _why(end: End, field: str) -> str:
    """Why the *field* of an end is not known, in brackets; "" where the model gives no reason."""
    reason = next((unknown.reason for unknown in end.raw.unknowns if unknown.field == field), "")
    return f" ({reason})" if reason else ""


def _ends(project: Project) -> Iterator[Finding]:
    """Ends at a name that nobody gives any more, one finding for what one renaming or removal has done."""
    groups: dict[tuple[str, ...], list[tuple[Lost, End]]] = {}
    for lost in lost_in(project):
        new = lost.change.name if lost.change.action == "renamed" else ""
        key = (lost.kind, _last(lost.name), lost.change.what, lost.change.action, _last(new), str(lost.is_new_name))
        groups.setdefault(key, []).extend((lost, end) for end in lost.left)
    for group in groups.values():
        lost, end = min(
            group, key=lambda item: (len(item[0].name), item[0].name, item[1].node.name, item[1].location.sort_key)
        )
        nodes = sorted({other_end.node.name for _, other_end in group if other_end.name == end.name} - {end.node.name})
        does, result = DOES[end.kind]
        who = end.node.name + (f" and {len(nodes)} more" if nodes else "")
        name = lost.name
        if lost.is_new_name:
            message = (
                f"{who} {does} {end.name} now, because {name} was {change_said(lost.change, name)}, but only {name} "
                f"exists: {result}"
            )
        else:
            message = f"{who} still {does} {name}, {_what_happened(lost.change, name)}: {result}"
        others = {
            other_end.location: (other_end.location, str(other_end))
            for _, other_end in group
            if other_end.location != end.location
        }
        yield Finding(
            at=end.location,
            message=f"{message}; use the same name in both places, or remap one",
            about=(name, end.node.name, *nodes[:SHOWN]),
            related=(*_cause(lost.change), *list(others.values())[:SHOWN]),
            level=Level.ERROR if lost.change.action == RENAMED and not lost.is_new_name else None,
        )


def _last(name: str) -> str:
    return name.rpartition("/")[2]


def _what_happened(change: Change, name: str) -> str:
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
        if was is None or not node.known or is_unseen(node):
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
                        message=f"{node}: the remapping of {rule.source} to {rule.target} has no effect, because the {end.word} was "
                        f"{change_said(change, end.name)}; remap the new name, or remove the rule",
                        about=(node.name, rule.source_name),
                        related=tuple(_cause(change)),
                    )
                    break


def _values(project: Project, causes: Causes) -> Iterator[Finding]:
    """Values for a parameter that the nodes which get them had, and have no more; one finding for each line."""
    by_place: dict[tuple[Location, str], tuple[Change, str, dict[str, None]]] = {}
    for _, new in both(project):
        if causes.touches(new):
            for at, key, node, name in (*_untaken(new), *_set(new)):
                change = causes.named("parameter", name, new)
                if change is not None:
                    by_place.setdefault((at, key), (change, name, {}))[2][node or (change.nodes or ("",))[0]] = None
    for (at, key), (change, name, nodes) in by_place.items():
        names = sorted(nodes)
        owner = f" of {names[0]}" + (f" and {len(names) - 1} more" if len(names) > 1 else "")
        yield Finding(
            at=at,
            message=f"{key}{owner} is still set here, but the parameter was {change_said(change, name)}: the value has no "
            "effect; set the new name, or remove the line",
            about=(key, *names[:SHOWN]),
            related=tuple(_cause(change)),
            level=Level.ERROR if change.action == RENAMED else None,
        )


def _untaken(system: System) -> Iterator[tuple[Location, str, str, str]]:
    """Place, name, node and full name of each value that no node takes (ROS 2)."""
    for parameter in system.given:
        if parameter.place not in system.taken and parameter.place not in system.whole.taken:
            yield parameter.at, parameter.key, parameter.node.name, f"{parameter.node.name}:{parameter.key}"


def _set(system: System) -> Iterator[tuple[Location, str, str, str]]:
    """The same of ROS 1."""
    read = {end.name for node in system.nodes for end in node.of("getters")}
    for parameter in system.parameters:
        at = parameter.origin or parameter.location
        if ":" not in parameter.name and parameter.name not in read and not parameter.unknowns and at is not None:
            yield at, parameter.name, "", parameter.name


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
    published = {channel.name for system in project.systems for channel in system.topics if channel.givers}
    vague = {new.name for old, new in both(project) if has_unseen(new, old)}
    for path in sorted(project.workspace.names):
        if not path.endswith(".rviz"):
            continue
        for number, line in enumerate(project.text(path)[:MAX_RVIZ].splitlines(), 1):
            match = _RVIZ.match(line)
            change = changes.get(match[1]) if match else None
            if match and change is not None and match[1] not in published and vague.isdisjoint(change.configurations):
                yield Finding(
                    at=Location(path, number),
                    message=f"rviz still displays {match[1]}, which was {change_said(change, match[1])}: the display stays empty; "
                    "write the new name",
                    about=(match[1], path),
                    related=tuple(_cause(change)),
                )


CHECK = Check(
    id="graph-change",
    summary="Old name of a topic, service, action, node or parameter still used after a change.",
    level=Level.WARNING,
    catalogue="G18",
    tags=("topics", "services", "parameters", "change"),
    project=check,
)
