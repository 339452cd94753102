# SPDX-License-Identifier: Apache-2.0
"""Every value of every metric of a workspace; docs/metrics.md defines them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from haros_ci.config.settings import Settings
from haros_ci.linters import values
from haros_ci.linters.linter import LintOptions
from haros_ci.linters.run import lint
from haros_ci.model.measurement import Measurement
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.result import Notification, Run

Progress = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Measures:
    """The values, sorted; what could not be measured and why; and the tools that failed, so that values are missing."""

    values: tuple[Measurement, ...]
    notifications: tuple[Notification, ...] = ()
    failed: tuple[str, ...] = ()


def measured(
    workspace: Workspace, settings: Settings, store: Store, progress: Progress | None = None
) -> tuple[Measurement, ...]:
    """The metrics of functions, classes, files and packages, sorted."""
    return measure(workspace, settings, store, progress).values


def measure(workspace: Workspace, settings: Settings, store: Store, progress: Progress | None = None) -> Measures:
    """The same, with what went wrong."""
    options = LintOptions(timeout=settings.linter_timeout, jobs=settings.jobs, root=settings.root)
    runs = lint(workspace, values.ADAPTERS, options, store, lambda tool, rule, path: True, progress)
    packages = {file.path: file.package or "" for file in workspace.files}
    return Measures(
        tuple(sorted(_measurements(runs, packages))),
        tuple(note for run in runs for note in run.notifications),
        tuple(run.tool.name for run in runs if not run.successful),
    )


def _measurements(runs: Iterable[Run], packages: dict[str, str]) -> Iterator[Measurement]:
    for run in runs:
        for result in run.results:
            place = result.location
            package = packages.get(place.path, "")
            if result.value is not None:
                yield Measurement(package, place.path, place.line or 0, "", result.scope, result.rule, result.value)
