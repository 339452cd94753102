# SPDX-License-Identifier: Apache-2.0
"""All checks of a run, shared out to processes: those of systems are one piece of work, those of what a change does another."""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from haros_ci.checking.check import Check
from haros_ci.checking.checked import Checked, Unseen
from haros_ci.checking.patience import Patience
from haros_ci.checking.project import Project
from haros_ci.checking.run import CHECKS, Under, markers, run_checks, run_on_project
from haros_ci.checking.system import System
from haros_ci.checking.unseen import Held, Part
from haros_ci.checking.unstarted import lowered
from haros_ci.model.changes import Changes
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.timing import Spent, now, side_by_side

#: The tag of checks that look at the base revision, too.
OF_CHANGES = "change"
#: The piece of work that the checks of systems are.
SYSTEMS = "systems"
#: The piece of work that is no check: what else is to be said of the model.
BESIDE = "beside"
#: The tags of checks that are one piece of work: those of code ask for its call graph, those of packages for what is included and imported.
_TOGETHER = (
    (OF_CHANGES, frozenset((OF_CHANGES,))),
    ("code", frozenset(("code", "python", "interfaces", "topics"))),
    ("packages", frozenset(("packages", "build", "launch", "parameters", "plugins"))),
)
Notes = tuple[str, ...]
#: Does pieces of work, those of one group in one process, and gives their results in order.
Share = Callable[[Sequence[Callable[[], Any]], Sequence[Hashable]], Sequence[Any]]


@dataclass(frozen=True, slots=True)
class _Done:
    """What a piece of work found, the process that did it, and what it took there."""

    found: Any
    process: int
    spent: Spent


def run_all(
    checks: Sequence[Check],
    systems: Sequence[System],
    project: Project,
    tool: str,
    under: Under | None,
    share: Share,
    base: Workspace | None = None,
    beside: Callable[[], Notes] = tuple,
    parts: Sequence[Part] = (),
    held: Held | None = None,
) -> tuple[Checked, Checked, Changes | None, Notes]:
    """What *checks* say of the *systems* and of the *project*, what has changed in the graph since *base*, where there is one, and what *beside* gives.

    Findings of systems are confirmed under other launch arguments in the order of the systems, and share what is followed for that, so they
    are one piece of work. The checks that look at the base revision are another: one process links it, this one if *share* does them here.
    They are asked on the *parts* first; those that are *held* are not asked.
    """
    asked, held = checks, held or Held()
    checks = [check for check in asked if check.id not in held.checks]
    of_project = [check for check in checks if check.project is not None]
    if project.is_as_before:
        of_project = [check for check in of_project if OF_CHANGES not in check.tags]
    unseen, budget = markers(project.workspace, base), Patience()
    work: list[tuple[str, str, Callable[[], Any]]] = [(OF_CHANGES, "", lambda: project.changes)] if base else []
    for check in sorted(of_project, key=lambda check: OF_CHANGES not in check.tags):
        of_check = partial(run_on_project, (check,), project, tool, unseen, budget)
        work.append((_group(check), check.id, partial(_of_project, check, parts, tool, unseen, of_check)))
    place = sum(group == OF_CHANGES for group, _, _ in work)
    work.insert(place, (SYSTEMS, "", partial(_of_systems, checks, systems, tool, under, parts)))
    work.insert(place + 1, (BESIDE, "", beside))
    done: Sequence[_Done] = share([partial(_timed, do) for _, _, do in work], [group for group, _, _ in work])
    if any(piece.process != os.getpid() for piece in done):
        for (_, part, _), piece in zip(work, done, strict=True):
            side_by_side(CHECKS, part, piece.spent)
    found = {name or group: piece.found for (group, name, _), piece in zip(work, done, strict=True)}
    of_checks = _together([found[check.id] for check in of_project])
    of_checks = _together([of_checks, held.of(check for check in asked if check.project is not None)])
    of_systems = _together([found[SYSTEMS], held.of(check for check in asked if check.run is not None)])
    unread = frozenset(fault.path for fault in project.workspace.faults)
    of_systems, of_checks = _not_at(unread, of_systems), _not_at(unread, of_checks)
    of_systems = replace(of_systems, results=tuple(lowered(project, of_systems.results)))
    return of_systems, of_checks, found.get(OF_CHANGES), found[BESIDE]


def _group(check: Check) -> str:
    """The piece of work that a check belongs to: what those of one have in common, the index of the code or the texts of build files, is made in one process."""
    return next((group for group, tags in _TOGETHER if tags.intersection(check.tags)), check.id)


def _timed(do: Callable[[], Any]) -> _Done:
    before = now()
    found = do()
    return _Done(found, os.getpid(), now().less(before))


def _not_at(manifests: frozenset[str], checked: Checked) -> Checked:
    """*checked* without findings at *manifests* that cannot be parsed: what these declare is not known, and malformed-manifest says so."""
    if not manifests:
        return checked
    return replace(checked, results=tuple(one for one in checked.results if one.location.path not in manifests))


def _together(found: Sequence[Checked]) -> Checked:
    """The findings of several checks as one, sorted; what failed in the order of the checks."""
    results = sorted((result for one in found for result in one.results), key=lambda result: result.sort_key)
    graphs = {graph.name: graph for one in found for graph in one.graphs}
    notes = tuple(note for one in found for note in one.notifications)
    unseen = Unseen(*(frozenset().union(*sets) for sets in zip(*(one.unseen for one in found), strict=True)))
    return Checked(tuple(results), tuple(graphs[name] for name in sorted(graphs)), notes, unseen)


def _of_project(
    check: Check, parts: Sequence[Part], tool: str, markers: Sequence[str], of_all: Callable[[], Checked]
) -> Checked:
    """What *check* says of the first of *parts* that is enough for it; where none is, what *of_all* says."""
    asked = (part.of_project(check, tool, markers) for part in parts if OF_CHANGES not in check.tags)
    return next((found for found in asked if found is not None), None) or of_all()


def _of_systems(
    checks: Sequence[Check], systems: Sequence[System], tool: str, under: Under | None, parts: Sequence[Part]
) -> Checked:
    """The same of all checks of systems: what these see of C++ is the same in all parts."""
    asked = ((check, part.of_systems(check, tool)) for part in parts[:1] for check in checks if check.run is not None)
    found = {check.id: checked for check, checked in asked if checked is not None}
    left = [check for check in checks if check.id not in found]
    return _together([*found.values(), run_checks(left, systems, tool, under)])
