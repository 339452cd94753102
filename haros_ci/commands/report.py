# SPDX-License-Identifier: Apache-2.0
"""``haros-ci report``, and ``html`` of ``check``: one file to look at."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from haros_ci.analysis.inspection import Architectures
from haros_ci.commands.common import (
    Flags,
    Progress,
    demand_base,
    demand_baseline,
    run_with_systems,
    settings_from,
    under_cache,
    view_of,
    warn_of_missing_base,
)
from haros_ci.commands.limits import LIMITS
from haros_ci.commands.timings import with_timings
from haros_ci.config.settings import Settings
from haros_ci.errors import EXIT_TOOL_TROUBLE, RunFailure
from haros_ci.html_page.gather import gathered
from haros_ci.model.workspace import Store, Workspace
from haros_ci.report.escape import terminal
from haros_ci.report.text import summary_line
from haros_ci.results.result import Report
from haros_ci.streams import write_to_stderr
from haros_ci.writing import write

#: Where the page goes if nothing is said.
FILE = "haros-ci-report.html"


@with_timings
def report(flags: Flags) -> int:
    """Analyse, write the page; exit code 3 if a tool failed, else 0: findings are there to be looked at."""
    settings = settings_from({**flags, "baseline_rev": flags["base"]})
    demand_base(settings)
    found, workspace, known = run_with_systems(settings, flags)
    demand_baseline(found, settings)
    warn_of_missing_base(settings)
    path = Path(flags["output"])
    text, failed = made(found, workspace, settings, flags, known, tuple(flags["configuration"]))
    write(text, path)
    click.echo(summary_line(view_of(workspace, flags, to_file=True).joined(found)), err=True)
    click.echo(f"{terminal(str(path))}: {len(text.encode()) / 1e6:.1f} MB; open it in a browser", err=True)
    return EXIT_TOOL_TROUBLE if {*found.failed_tools(), *failed} - settings.allow_tool_failure else 0


def fill(
    paths: Sequence[Path | None],
    found: Report,
    workspace: Workspace,
    settings: Settings,
    flags: Flags,
    known: Architectures | None = None,
) -> bool:
    """Write the page to each of *paths*, None is stdout; whether all that belongs into it could be found out, and written."""
    text, failed = made(found, workspace, settings, flags, known)
    is_whole = not set(failed) - settings.allow_tool_failure
    for path in paths:
        try:
            write(text, path)
        except RunFailure as err:
            write_to_stderr(f"error: {terminal(err.message)}", f"help: {terminal(err.help or '')}")
            is_whole = False
    return is_whole


def made(
    found: Report,
    workspace: Workspace,
    settings: Settings,
    flags: Flags,
    known: Architectures | None = None,
    names: tuple[str, ...] = (),
) -> tuple[str, tuple[str, ...]]:
    """The page, with these configurations only where *names* are given; and the tools that failed to measure, which is said."""
    shown = view_of(workspace, flags, to_file=True).joined(found)

    def work(store: Store, progress: Progress) -> tuple[str, tuple[str, ...]]:
        progress("report")
        return gathered(shown, workspace, (known or Architectures(settings, store)).under(store), LIMITS, names)

    text, failed = under_cache(work, settings, flags)
    for tool in sorted(set(failed) - set(found.failed_tools())):
        click.echo(f"error: {tool} failed: values of metrics are missing in the report", err=True)
    return text, failed
