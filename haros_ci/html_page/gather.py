# SPDX-License-Identifier: Apache-2.0
"""What the page needs besides the report: the architecture, the metrics, the revision's date."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from datetime import datetime, timezone
from functools import partial
from typing import Any

from haros_ci.analysis.architectures import Architectures
from haros_ci.analysis.kept_runs import Output, kept_output
from haros_ci.checking.transforms import broadcasts
from haros_ci.config.digests import settings_digests
from haros_ci.errors import UserError
from haros_ci.html_page.data import History, Input, data_of
from haros_ci.html_page.document import page
from haros_ci.html_page.properties import held
from haros_ci.html_page.verdicts import Recorded
from haros_ci.measuring.measures import measure, measuring_tools
from haros_ci.model.architecture import Architecture, Configuration
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.report.measurements import Limit
from haros_ci.results.result import Report
from haros_ci.results.values import plain
from haros_ci.timing import stage
from haros_ci.workspace.commit_time import commit_time


@dataclass(frozen=True, slots=True)
class Shown:
    """What else a user wants to see: these configurations only where there are *names*, commits of the past, recordings, rates, and dependence."""

    names: tuple[str, ...] = ()
    past: History = ()
    recordings: tuple[Recorded, ...] = ()
    has_rates: bool = False
    has_dependence: bool = False


#: All configurations, and nothing else.
ALL = Shown()


def gathered(
    report: Report,
    workspace: Workspace,
    architectures: Architectures,
    limits: Iterable[Limit],
    shown: Shown = ALL,
) -> tuple[str, tuple[str, ...]]:
    """The page with what is to be *shown*; and the tools that failed to measure, so that values are missing.

    UserError for a configuration that is not there. The page's data is kept in the cache: the same report of
    the same files gives the same. It is data there, too: what is read is escaped again.
    """
    settings = architectures.settings
    title = str(settings.project.get("project") or workspace.root.name)
    date = _date(commit_time(workspace.root))

    def make() -> Output:
        data, failed = _made(report, workspace, architectures, limits, shown, title, date)
        return Output(json.dumps(data, allow_nan=False).encode("ascii"), failed)

    with stage("page"):
        found = (
            make() if settings.plugins else _kept(make, report, workspace, architectures, (plain(shown), title, date))
        )
        return page(f"{title} – haros-ci", json.loads(found.content)), found.messages


def _kept(
    make: Any, report: Report, workspace: Workspace, architectures: Architectures, named: tuple[Any, ...]
) -> Output:
    settings = architectures.settings
    listed = {file.path for file in workspace.files}
    others = sorted({result.location.path for result in report.results} - listed)
    key = json.dumps(
        [
            *named,
            settings.project_file,
            settings_digests(settings, architectures.registry.components),
            measuring_tools(settings),
            [workspace.text(path) for path in others],
            plain(report),
        ]
    )
    store = architectures.store
    return kept_output(
        "report", make, workspace, key, store, is_binary=True, is_kept=lambda output: not output.messages
    )


def _made(
    report: Report,
    workspace: Workspace,
    architectures: Architectures,
    limits: Iterable[Limit],
    shown: Shown,
    title: str,
    date: str,
) -> tuple[Mapping[str, Any], tuple[str, ...]]:
    made = architectures.of(workspace)
    every, names = made.architecture.configurations, shown.names
    for name in names:
        if name not in {one.name for one in every}:
            known = ", ".join(sorted(one.name for one in every)[:20]) or "none"
            raise UserError(f"no configuration {name}", help=f"there are {known}")
    chosen = [one for one in every if not names or one.name in names]
    if shown.has_rates or shown.has_dependence:
        from haros_ci.analysis.code_of import code_of

        found = replace(made.architecture, configurations=tuple(chosen))
        chosen = _with_more(found, partial(code_of, made, workspace), shown)
    project = architectures.project(workspace)
    measures = measure(workspace, architectures.settings, architectures.store, sources=made.sources)
    data = data_of(
        Input(
            report=report,
            workspace=workspace,
            configurations=chosen,
            broadcasts={
                system.name: tuple(broadcasts(project, system))
                for system in project.systems
                if not names or system.name in names
            },
            properties=held(project.properties),
            verdicts=shown.recordings,
            builds=made.builds,
            measurements=measures.values,
            limits=limits,
            name=title,
            date=date,
            history=shown.past,
            processes=architectures.settings.jobs,
            more_than_shown=len(every) - len(chosen),
        )
    )
    return data, measures.failed


def _with_more(found: Architecture, code: Callable[[], Any], shown: Shown) -> list[Configuration]:
    """The configurations of *found* with the rates and the dependence in them, as far as they are asked for: they are dear."""
    if shown.has_rates:
        from haros_ci.analysis.rates import with_rates

        found = with_rates(found, code())
    if shown.has_dependence:
        from haros_ci.analysis.dependence import with_dependence

        found = with_dependence(found, code())
    return list(found.configurations)


def _date(seconds: int | None) -> str:
    """A commit's time in UTC, "" for none that a calendar holds."""
    if seconds is None or seconds < 0:
        return ""
    try:
        return datetime.fromtimestamp(seconds, timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
    except (OverflowError, OSError, ValueError):
        return ""
