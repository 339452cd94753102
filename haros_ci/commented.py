# SPDX-License-Identifier: Apache-2.0
"""What comments keep linters from saying of files that a change touches: nobody counts it, and a comment that was there before may come to hide a new defect."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

from haros_ci.analysis.architectures import Architectures
from haros_ci.config.selection import Selection
from haros_ci.config.settings import Settings
from haros_ci.linters.uncommented import silenced_findings
from haros_ci.linting import lint_options
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Result, Run

#: Of the results of linters those that are reported where they are.
Select = Callable[[Iterable[Result], Selection, Workspace], tuple[Result, ...]]


def uncommented(
    architectures: Architectures,
    selection: Selection,
    narrow: Callable[[Workspace, Settings, Selection], Workspace],
    select: Select,
) -> Callable[[Workspace, frozenset[str]], tuple[Run, ...]]:
    """What tells, of a revision and the paths in it that have changed, the findings that comments silence and no tool names.

    Linters run on copies without these comments, where some may hold; *narrow* and *select* are as for a run.
    """

    settings, known = architectures.settings, architectures.registry

    def found(workspace: Workspace, changed: frozenset[str]) -> tuple[Run, ...]:
        here = narrow(workspace, settings, selection)
        chosen = selection.over(here.package_finder())
        options = lint_options(settings, known)
        runs = silenced_findings(here, changed, known.linters, options, architectures.store, chosen.wants)
        return tuple(replace(run, results=select(run.results, chosen, here)) for run in runs)

    return found
