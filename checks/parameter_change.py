# SPDX-License-Identifier: Apache-2.0
"""Declared parameters that a change gives another type or default, where somebody depends on the old one."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project
from haros_ci.api.changes import Change

SHOWN = 10


def check(project: Project) -> Iterator[Finding]:
    for change in project.changes.changes:
        if change.what == "parameter" and change.action == "changed" and change.head is not None:
            if change.aspect == "type":
                yield _type(project, change, change.head)
            elif change.aspect == "default":
                yield from _default(project, change, change.head)


def _type(project: Project, change: Change, at: Location) -> Finding:
    places = _set_at(project, change)
    here = f", {len(places)} of them in this workspace" if places else ""
    return Finding(
        at=at,
        message=(
            f"parameter {_name(change)} has the type {change.after} now instead of {change.before}: values of the old "
            f"type in launch files and YAML{here} make the node fail; change them too, and announce the change to "
            "users"
        ),
        about=_about(change),
        related=tuple((place, "a value is set here") for place in places[:SHOWN]),
        level=Level.WARNING,
    )


def _default(project: Project, change: Change, at: Location) -> Iterator[Finding]:
    """A default matters where a launch file starts the node and nobody gives it another value."""
    names = set(change.names)
    running = []
    for system in project.systems:
        if not system.is_launched or system.name not in change.configurations:
            continue
        for node in system.nodes:
            keys = {parameter.key for parameter in node.given}
            for end in node.of("parameters"):
                if end.name in names and end.raw.location == change.head and end.name.partition(":")[2] not in keys:
                    if not any(unknown.field in ("effective", "name") for unknown in end.raw.unknowns):
                        running.append((system.name, node))
    if not running:
        return
    systems = sorted({name for name, _ in running})
    nodes = sorted({node.name for _, node in running})
    more = f" and {len(systems) - 1} more" if len(systems) > 1 else ""
    yield Finding(
        at=at,
        message=(
            f"the default of parameter {_name(change)} is now {change.after or 'gone'}, before it was "
            f"{change.before or 'not set'}: {nodes[0]} of {systems[0]}{more} sets no value and changes its behaviour; "
            "set the old value there, or confirm the change"
        ),
        about=_about(change),
        related=tuple(dict.fromkeys((node.location, f"{node} is started here") for _, node in running[:SHOWN])),
        level=Level.NOTE,
    )


def _set_at(project: Project, change: Change) -> list[Location]:
    """Where the parameter is given a value."""
    names = set(change.names)
    found = {
        parameter.at: None
        for system in project.systems
        for parameter in system.given
        if f"{parameter.node.name}:{parameter.key}" in names
    }
    return list(found)


def _name(change: Change) -> str:
    return change.name.partition(":")[2] or change.name


def _about(change: Change) -> tuple[str, ...]:
    return (*change.programs[:SHOWN], _name(change), change.aspect)


CHECK = Check(
    id="parameter-change",
    summary="Changed type or default of a parameter.",
    level=Level.WARNING,
    tags=("parameters", "change"),
    project=check,
)
