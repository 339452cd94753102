# SPDX-License-Identifier: Apache-2.0
"""Findings that the code around them speaks against, and that come with a change: it may have written that code for them.

Linters take some code for wrong that is right, and filters know such code by its look. Of who writes both, the mistake and the look, nothing would be reported;
so what is dropped since a change, at a place that it brings or by what it brings, is named.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

from haros_ci.config.settings import Settings
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Notification, Result, Run
from haros_ci.results.rule import Level
from haros_ci.workspace.base import Base

#: Places that are named; the rest is counted.
MOST = 20


def refuted_since(
    workspace: Workspace,
    settings: Settings,
    base: Base | None,
    runs: tuple[Run, ...],
    examine: Callable[[Workspace], tuple[Run, ...]],
) -> tuple[Notification, ...]:
    """A note on the findings that *runs* leave out by the code around them, and that *base* neither had nor left out.

    Whatever file they are in: what makes them, or speaks against them, may lie in another one. None where what *base* has is not known:
    *examine* gives its findings.
    """
    if base is None or settings.baseline is not None:
        return ()
    old = {file.path: file.digest for file in base.workspace.files}
    is_changed = old != {file.path: file.digest for file in workspace.files}
    now = tuple(replace(run, results=run.refuted) for run in runs if run.refuted and is_changed)
    places = _unknown(now, workspace, base, examine) if now else []
    if not places:
        return ()
    named = ", ".join(f"{place} ({rule})" for place, rule in places[:MOST])
    more = f" and {len(places) - MOST:,} more" if len(places) > MOST else ""
    noun, them = ("finding is", "it") if len(places) == 1 else ("findings are", "them")
    text = f"since this change {len(places):,} {noun} not reported, as the code around speaks against {them}: {named}{more}; look at {them}"
    return (Notification(Level.NOTE, text),)


def missing(before: Iterable[Result], after: Iterable[Result]) -> Iterable[Result]:
    """Those of *before* that are not in *after*, where a result may have another level."""
    kept = {(result.full_id, result.location, result.message) for result in after}
    return (result for result in before if (result.full_id, result.location, result.message) not in kept)


def _unknown(
    now: tuple[Run, ...], workspace: Workspace, base: Base, examine: Callable[[Workspace], tuple[Run, ...]]
) -> list[tuple[Location, str]]:
    """The places and rules of the findings of *now* that are none of those at *base*."""
    from haros_ci.results.fingerprint import fingerprint
    from haros_ci.results.known import known_from, sides
    from haros_ci.results.pairing import pair
    from haros_ci.results.silenced import by_place

    languages = {file.path: file.language for it in (base.workspace, workspace) for file in it.files}
    of_tools = {run.tool.name for run in now}
    before = tuple(
        replace(run, results=(*run.refuted, *run.results))
        for run in examine(base.workspace)
        if run.tool.name in of_tools
    )
    before = fingerprint(before, base.workspace.text, lambda path: languages.get(path, ""))
    now = fingerprint(now, workspace.text, lambda path: languages.get(path, ""))
    results = [result for run in now for result in run.results]
    known = [known_from(result) for run in before for result in run.results]
    paired = {one.new for one in pair(results, known, sides(workspace, now, (".",), base.workspace, base.renames))}
    new = {
        (Location(result.location.path, result.location.line), result.full_id)
        for i, result in enumerate(results)
        if i not in paired
    }
    return sorted(new, key=by_place)
