# SPDX-License-Identifier: Apache-2.0
"""Keywords that launch_ros has dropped."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Fix, Level, System
from haros_ci.api.launch import ConstructUse, depends_on_distribution, included_by, renamed_keyword

#: The distributions that still have the keywords; a file or directory that is called after one is not for a later one.
_OLD = re.compile(r"(?:^|[/_.-])(?:ardent|bouncy|crystal|dashing|eloquent|foxy)(?=$|[/_.-])", re.IGNORECASE)


def check(system: System) -> Iterator[Finding]:
    calls: dict[tuple[object, ...], list[ConstructUse]] = {}
    for use in system.facts(ConstructUse):
        if use.kind == "deprecated":
            calls.setdefault((use.location, use.presence, use.included), []).append(use)
    for uses in calls.values():
        place = uses[0].location
        text = system.workspace.text(place.path) if system.workspace is not None else ""
        if not depends_on_distribution(text, place) and not _OLD.search(place.path):
            yield _finding(system, uses)


def _finding(system: System, uses: list[ConstructUse]) -> Finding:
    """One finding for a call, however many such keywords it has."""
    first = uses[0]
    old, new = (_listed([each.text for each in uses]), _listed([each.instead for each in uses]))
    return Finding(
        at=first.location,
        message=f"{old} was removed from launch_ros after ROS 2 Foxy: launch stops here; write {new}",
        about=tuple(each.text for each in uses),
        flow=included_by(first),
        presence=first.presence,
        apart=tuple(each.text for each in uses),
        fixes=fixes(system, uses),
    )


def _listed(words: list[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def fixes(system: System, uses: list[ConstructUse]) -> tuple[Fix, ...]:
    """The keywords written as they are today, if that is sure for all of them."""
    text = system.workspace.text(uses[0].location.path) if system.workspace is not None else ""
    edits = tuple(
        edit
        for use in uses
        for edit in [renamed_keyword(text, use.location, use.text.rstrip("="), use.instead.rstrip("="))]
        if edit is not None
    )
    title = f"write {_listed([each.instead for each in uses])}"
    return (Fix(title, edits),) if len(edits) == len(uses) else ()


CHECK = Check(
    id="deprecated-launch-keyword",
    summary="Launch keyword that launch_ros has removed.",
    level=Level.WARNING,
    catalogue="L13",
    tags=("launch",),
    run=check,
)
