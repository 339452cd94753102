# SPDX-License-Identifier: Apache-2.0
"""The thresholds on calls, nesting, paths and classes: which functions and classes cross them."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from haros_ci.linters.metrics import CLASS_THRESHOLDS, STRUCTURE_THRESHOLDS, crossed
from haros_ci.measuring.measures import Structure, class_values, function_values, problems, structure
from haros_ci.model.location import Location
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.result import Result, Run, Tool
from haros_ci.timing import timed

#: The run's name; pipeline.with_metrics joins it with what lizard and radon said.
NAME = "structure"


@timed("structure")
def exceeded_limits(
    workspace: Workspace, store: Store, processes: int, progress: Callable[[str], None] | None = None
) -> Run:
    """Every band that is crossed, at the line of the function's signature or the class's head."""
    if progress is not None:
        progress(NAME)
    found = structure(workspace, store, processes)
    results = (*_of_functions(found, workspace), *_of_classes(found, workspace))
    return Run(
        Tool(NAME),
        results=tuple(sorted(results, key=lambda r: r.sort_key)),
        notifications=tuple(problems(found, workspace)),
        analysed=frozenset(path for path in found.facts if workspace.reports_on(path)),
    )


def _of_functions(found: Structure, workspace: Workspace) -> Iterator[Result]:
    for path, facts in found.facts.items():
        for function in facts.functions if workspace.reports_on(path) else ():
            place = Location(path, function.line, function.column)
            subject, values = f"Function '{function.name}'", function_values(function)
            yield from crossed(place, subject, function.name, values, STRUCTURE_THRESHOLDS)


def _of_classes(found: Structure, workspace: Workspace) -> Iterator[Result]:
    for measured in found.classes.every:
        facts, path = measured.facts, measured.source.path
        if workspace.reports_on(path):
            place = Location(path, facts.line, facts.column)
            yield from crossed(place, f"Class '{facts.name}'", facts.name, class_values(measured), CLASS_THRESHOLDS)
