# SPDX-License-Identifier: Apache-2.0
"""``haros-ci report``, and ``html`` of ``check``: one file to look at."""

from __future__ import annotations

import os
from dataclasses import replace
from functools import partial
from pathlib import Path

import click

from haros_ci.analysis.architectures import Architectures
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
from haros_ci.commands.output import FOLDERS, PAGES, Outputs, text_in
from haros_ci.commands.timings import with_timings
from haros_ci.config.settings import Settings
from haros_ci.errors import EXIT_TOOL_TROUBLE, RunFailure, UserError
from haros_ci.html_page.data import History
from haros_ci.html_page.gather import ALL, Shown, gathered
from haros_ci.html_page.verdicts import Recorded, recorded
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
    settings = replace(settings_from({**flags, "baseline_rev": flags["base"]}), is_measured=True)
    demand_base(settings)
    recordings = tuple(verdicts_in(Path(name)) for name in flags["verdicts"])
    found, workspace, known = run_with_systems(settings, flags)
    demand_baseline(found, settings)
    warn_of_missing_base(settings)
    path = Path(flags["output"])
    past = history_in(Path(flags["history"]), settings) if flags["history"] else ()
    shown = Shown(tuple(flags["configuration"]), past, recordings, flags["rates"], flags["dependence"])
    text, failed = made(found, workspace, settings, flags, known, shown)
    write(text, path)
    click.echo(summary_line(view_of(workspace, flags, to_file=True).joined(found)), err=True)
    click.echo(f"{terminal(str(path))}: {len(text.encode()) / 1e6:.1f} MB; open it in a browser", err=True)
    if flags["open_page"]:
        open_page(path)
    return EXIT_TOOL_TROUBLE if {*found.failed_tools(), *failed} - settings.allow_tool_failure else 0


def fill(
    outputs: Outputs,
    found: Report,
    workspace: Workspace,
    settings: Settings,
    flags: Flags,
    known: Architectures | None = None,
) -> bool:
    """Write the page where *outputs* say, after the folder of HAROS's data files; whether all that belongs into it could be found out, and written."""
    folder = next((path for format, path in outputs if format in FOLDERS and path is not None), None)
    past = history_in(folder, settings) if folder is not None else ()
    text, failed = made(found, workspace, settings, flags, known, Shown(past=past))
    is_whole = not set(failed) - settings.allow_tool_failure
    for path in (path for format, path in outputs if format in PAGES):
        try:
            write(text, path)
        except RunFailure as err:
            write_to_stderr(f"error: {terminal(err.message)}", f"help: {terminal(err.help or '')}")
            is_whole = False
    return is_whole


def open_page(path: Path) -> None:
    """Show the file that was written in the user's browser; in CI nobody would see it."""
    if os.environ.get("CI"):
        click.echo("warning: the page is not opened in CI", err=True)
        return
    import webbrowser

    if not webbrowser.open(path.resolve().as_uri()):
        click.echo("warning: no browser was found to open the page", err=True)


def history_in(folder: Path, settings: Settings) -> History:
    """The history of the project that a folder of HAROS's data files has; it is data of unknown origin. UserError for what is no folder."""
    from haros_ci.haros_json.documents import history_of

    if not folder.is_dir():
        raise UserError(f"{folder}: is no directory", help="name one that --output haros-json=DIR has filled")
    return history_of(settings.project, partial(text_in, folder))


def verdicts_in(path: Path) -> Recorded:
    """What ``haros-ci monitor`` has written of a recording; UserError for what is no such file."""
    text = text_in(path.parent, path.name)
    if text is None:
        raise UserError(f"{path}: there is no such file", help="haros-ci monitor --output json=FILE writes one")
    return recorded(text, str(path))


def made(
    found: Report,
    workspace: Workspace,
    settings: Settings,
    flags: Flags,
    known: Architectures | None = None,
    shown: Shown = ALL,
) -> tuple[str, tuple[str, ...]]:
    """The page with what is to be *shown*; and the tools that failed to measure, which is said."""
    joined = view_of(workspace, flags, to_file=True).joined(found)

    def work(store: Store, progress: Progress) -> tuple[str, tuple[str, ...]]:
        progress("report")
        architectures = (known or Architectures(settings, store)).under(store)
        return gathered(joined, workspace, architectures, LIMITS, shown)

    text, failed = under_cache(work, settings, flags)
    for tool in sorted(set(failed) - set(found.failed_tools())):
        click.echo(f"error: {tool} failed: values of metrics are missing in the report", err=True)
    return text, failed
