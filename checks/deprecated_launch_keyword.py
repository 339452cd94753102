# SPDX-License-Identifier: Apache-2.0
"""Keywords that launch_ros has dropped."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Fix, Level, System
from haros_ci.api.launch import (
    ConstructUse,
    depends_on_distribution,
    included_by,
    is_called_old,
    is_tried,
    renamed_keyword,
    told_of,
)

#: So many further places are related.
_SHOWN = 5


def check(system: System) -> Iterator[Finding]:
    """One finding stands for a file, however many calls have such keywords."""
    files: dict[str, list[ConstructUse]] = {}
    for use in system.facts(ConstructUse):
        if use.kind == "deprecated" and not is_called_old(use.location.path):
            files.setdefault(use.location.path, []).append(use)
    for path, uses in files.items():
        text = system.workspace.text(path) if system.workspace is not None else ""
        left = [u for u in uses if not depends_on_distribution(text, u.location) and not is_tried(text, u.location)]
        place = told_of(path, system) if left else ""
        if left and place not in ("file", "branch"):
            yield _finding(system, left, Level.NOTE if place == "old" else None)


def _finding(system: System, uses: list[ConstructUse], level: Level | None) -> Finding:
    first = min(uses, key=lambda use: (len(use.presence), len(use.included), use.location.line or 0))
    places = dict.fromkeys(use.location for use in uses)
    words = dict.fromkeys((use.text, use.instead) for use in uses)
    old, new = _listed([text for text, _ in words]), _listed([instead for _, instead in words])
    others = len(places) - 1
    more = (
        f"; so {'has' if others == 1 else 'have'} {others} more {'call' if others == 1 else 'calls'} of this file"
        if others
        else ""
    )
    return Finding(
        at=first.location,
        message=f"{old} {'was' if len(words) == 1 else 'were'} removed from launch_ros after ROS 2 Foxy: launch stops here; write {new}{more}",
        about=tuple(text for text, _ in words),
        related=tuple((place, "has such keywords, too") for place in places if place != first.location)[:_SHOWN],
        flow=included_by(first),
        presence=first.presence,
        apart=tuple(text for text, _ in words),
        level=level,
        fixes=fixes(system, uses),
    )


def _listed(words: list[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def fixes(system: System, uses: list[ConstructUse]) -> tuple[Fix, ...]:
    """The keywords written as they are today, if that is sure for all of them."""
    text = system.workspace.text(uses[0].location.path) if system.workspace is not None else ""
    keywords = dict.fromkeys((use.location, use.text, use.instead) for use in uses)
    edits = tuple(
        edit
        for place, old, new in keywords
        for edit in [renamed_keyword(text, place, old.rstrip("="), new.rstrip("="))]
        if edit is not None
    )
    title = f"write {_listed(list(dict.fromkeys(new for _, _, new in keywords)))}"
    return (Fix(title, edits),) if len(edits) == len(keywords) else ()


CHECK = Check(
    id="deprecated-launch-keyword",
    summary="Launch keyword that launch_ros has removed.",
    level=Level.WARNING,
    catalogue="L13",
    tags=("launch",),
    run=check,
)
