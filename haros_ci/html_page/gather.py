# SPDX-License-Identifier: Apache-2.0
"""What the page needs besides the report: the architecture, the metrics, the revision's date."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime, timezone

from haros_ci.analysis.inspection import Architectures
from haros_ci.errors import UserError
from haros_ci.html_page.data import Input, data_of
from haros_ci.html_page.document import page
from haros_ci.measuring.measures import measure
from haros_ci.model.workspace import Workspace
from haros_ci.report.measurements import Limit
from haros_ci.results.result import Report
from haros_ci.timing import stage
from haros_ci.workspace.commit_time import commit_time


def gathered(
    report: Report,
    workspace: Workspace,
    architectures: Architectures,
    limits: Iterable[Limit],
    names: tuple[str, ...] = (),
) -> tuple[str, tuple[str, ...]]:
    """The page; and the tools that failed to measure, so that values are missing.

    With *names* it has these configurations only; UserError for one that is not there.
    """
    made = architectures.of(workspace)
    every = made.architecture.configurations
    for name in names:
        if name not in {one.name for one in every}:
            known = ", ".join(sorted(one.name for one in every)[:20]) or "none"
            raise UserError(f"no configuration {name}", help=f"there are {known}")
    shown = [one for one in every if not names or one.name in names]
    measures = measure(workspace, architectures.settings, architectures.store)
    title = str(architectures.settings.project.get("project") or workspace.root.name)
    with stage("page"):
        data = data_of(
            Input(
                report=report,
                workspace=workspace,
                configurations=shown,
                builds=made.builds,
                measurements=measures.values,
                limits=limits,
                name=title,
                date=_date(commit_time(workspace.root)),
                more_than_shown=len(every) - len(shown),
            )
        )
        return page(f"{title} – haros-ci", data), measures.failed


def _date(seconds: int | None) -> str:
    """A commit's time in UTC, "" for none that a calendar holds."""
    if seconds is None or seconds < 0:
        return ""
    try:
        return datetime.fromtimestamp(seconds, timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
    except (OverflowError, OSError, ValueError):
        return ""
