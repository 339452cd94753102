# SPDX-License-Identifier: Apache-2.0
"""A change of an interface that those who were built with the old one do not understand."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project
from haros_ci.api.interfaces import InterfaceChange, InterfaceUsers, change_in_words, changes_of, containing, defined_in

#: Place and words, as a finding has them.
Place = tuple[Location, str]
GENERATE = ("rosidl_generate_interfaces", "add_message_files", "add_service_files", "add_action_files")
#: So many changes are spelled out in a message, so many digits of a long hash.
SPELLED_OUT = 4
DIGITS = 12


def check(project: Project) -> Iterator[Finding]:
    users = InterfaceUsers(project)
    by_interface: dict[tuple[str, str], list[InterfaceChange]] = {}
    for change in changes_of(project):
        if change.is_breaking:
            by_interface.setdefault((change.name, change.kind), []).append(change)
    for changes in by_interface.values():
        changes.sort(key=lambda change: change.location.sort_key)
        places = tuple(_users(project, users, changes[0]))
        at = _at(project, changes[0], places)
        if at is None:
            continue
        stale = tuple(_still_there(project, users, changes))
        yield Finding(
            at=at,
            message=_message(changes, places, stale),
            about=(changes[0].name,),
            related=(*stale, *(place for place in places if place[0] not in {other for other, _ in stale})),
            level=Level.ERROR if stale else None,
        )


def _message(changes: list[InterfaceChange], places: tuple[Place, ...], stale: tuple[Place, ...]) -> str:
    first = changes[0]
    words = [change_in_words(change) for change in changes[:SPELLED_OUT]]
    if len(changes) > SPELLED_OUT:
        words.append(f"{len(changes) - SPELLED_OUT} more changes")
    effect = "nodes and recordings with the old definition cannot read the new one"
    if all(change.what.startswith("constant-") for change in changes) and first.hash_before == first.hash_after:
        effect = "nodes with the old definition no longer build, or read the fields with another meaning"
    used = (
        f"{len(places)} place{'' if len(places) == 1 else 's'} in the workspace use it"
        if places
        else "no file in the workspace uses it"
    )
    left = f"; {stale[0][0]} still {stale[0][1]}" if stale else ""
    return f"{first.name} breaks: {', '.join(words)}{_hashes(first)}; {effect}; {used}{left}"


def _hashes(change: InterfaceChange) -> str:
    if change.hash_before is None or change.hash_after is None:
        return ""
    noun = "MD5 sum" if change.ros == 1 else "type hash"
    if change.hash_before == change.hash_after:
        return f"; the {noun} stays {_short(change.hash_before)}"
    return f"; {noun} {_short(change.hash_before)} → {_short(change.hash_after)}"


def _short(hash: str) -> str:
    prefix, _, digits = hash.rpartition("_")
    return f"{prefix}_{digits[:DIGITS]}…" if prefix else digits


def _at(project: Project, change: InterfaceChange, places: tuple[Place, ...]) -> Location | None:
    """The changed line; for an interface that is gone where the others of its package are named, or who uses it."""
    if change.is_in_head:
        return change.location
    package = project.package(change.name.partition("/")[0])
    commands = package.commands(*GENERATE) if package is not None else ()
    if commands:
        return commands[0].location
    if package is None:
        return None  # it may come from elsewhere now
    return places[0][0] if places else package.at("name")


def _users(project: Project, users: InterfaceUsers, change: InterfaceChange) -> Iterator[Place]:
    """Everything in the workspace that uses the interface, or one that contains it; each place once."""
    seen = set()
    name = change.after if change.what == "renamed" else change.name
    for item in (*users.of(change.kind, name), *(users.of(change.kind, change.name) if name != change.name else ())):
        if item.location not in seen:
            seen.add(item.location)
            yield item.location, item.how
    for other in containing(defined_in(project), name) if change.kind == "msg" else ():
        yield Location(other.path), f"{other.name} contains it and changes with it"
        for user in users.of(other.kind, other.name):
            if user.location not in seen:
                seen.add(user.location)
                yield user.location, f"{user.how}, as a part of {other.name}"


def _still_there(project: Project, users: InterfaceUsers, changes: list[InterfaceChange]) -> Iterator[Place]:
    """Code that uses what is gone: the interface itself, or one of its constants by its name."""
    first = changes[0]
    if first.what in ("removed", "renamed") and project.package(first.name.partition("/")[0]) is not None:
        yield from (
            (user.location, f"{user.how}") for user in users.of(first.kind, first.name) if user.how.endswith(" it")
        )
    short = first.name.rpartition("/")[2]
    removed = [change.field for change in changes if change.what in ("constant-removed", "constant-renamed")]
    if not removed:
        return
    named = re.compile(rf"\b{re.escape(short)}(?:_Request|_Response|_Goal|_Result|_Feedback|::Request|::Response|::Goal"
                       rf"|::Result|::Feedback|Request|Response|\.Request|\.Response|\.Goal|\.Result|\.Feedback)?"
                       rf"(?:::|\.)({'|'.join(map(re.escape, removed))})\b")  # fmt: skip
    for path in sorted({user.location.path for user in users.of(first.kind, first.name)}):
        for number, line in enumerate(project.text(path).split("\n"), 1):
            found = named.search(line)
            if found is not None:
                yield Location(path, number, found.start() + 1), f"uses {found[1]}"


CHECK = Check(
    id="interface-break",
    summary="Message, service or action changed incompatibly.",
    level=Level.WARNING,
    catalogue="I01",
    tags=("interfaces", "change"),
    project=check,
)
