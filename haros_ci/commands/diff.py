# SPDX-License-Identifier: Apache-2.0
"""``haros-ci diff``: what the change from one revision to another does to the system."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from haros_ci.analysis.architecture import varied
from haros_ci.analysis.comparison import revision_of
from haros_ci.changes.revision import changes_of
from haros_ci.commands.collector import without_collector
from haros_ci.commands.common import cores, settings_from, store_for
from haros_ci.commands.timings import with_timings
from haros_ci.config.settings import Settings
from haros_ci.errors import UserError
from haros_ci.model.changes import Changes
from haros_ci.model.workspace import Store, Workspace
from haros_ci.report.escape import terminal
from haros_ci.timing import remark, timed
from haros_ci.workspace.git import BaselineUnavailable
from haros_ci.workspace.revision import Revisions, revisions
from haros_ci.writing import write

FORMATS = ("text", "markdown", "json", "html")


@with_timings
def diff(flags: Mapping[str, Any]) -> int:
    """Compare, print; exit code 0, with ``--exit-code`` 1 if anything has changed; 2 for a revision that cannot be had."""
    without_collector()
    settings = settings_from({**flags, "paths": (), "no_baseline": True, "baseline_rev": flags["base"]})
    store = store_for(settings)
    try:
        with revisions(
            settings.root,
            flags["base"],
            flags["head"],
            paths=settings.paths,
            exclude=settings.exclude,
            max_file_size=settings.max_file_size,
            from_merge_base=flags["merge_base"],
        ) as found:
            changes = compared(found, settings, store, rates=flags["rates"])
            sides = found.base_commit, found.head_commit
    except BaselineUnavailable as err:
        raise UserError(str(err), help="name commits, branches or tags of this repository: haros-ci diff main") from err
    problem = store.flush()
    if problem:
        click.echo(f"warning: {problem}", err=True)
    if settings.base_missing:
        click.echo(f"warning: {terminal(settings.without_base)}", err=True)
    for note in settings.notes:
        click.echo(f"note: {terminal(note)}", err=True)
    if flags["format"] == "html":
        text = page_of(changes, found.head, settings, *sides)
    else:
        text = rendered(changes, flags["format"], *sides)
    write(text, Path(flags["output"]) if flags["output"] else None)
    remark(f"cache: {store.stats}")
    return 1 if flags["exit_code"] and changes else 0


def compared(found: Revisions, settings: Settings, store: Store, *, rates: bool = False) -> Changes:
    """The architectures of both revisions, from *store* where their files are known there, and what is otherwise.

    With *rates* how often nodes publish is compared in any case. Where no file that is analysed has changed there is nothing to look at.
    """
    if {(file.path, file.digest) for file in found.base.files} == {
        (file.path, file.digest) for file in found.head.files
    }:
        return Changes()
    sides = []
    for workspace in (found.base, found.head):
        made = varied(workspace, settings, store, processes=cores(), alternatives=False)
        sides.append(revision_of(workspace, made))
    return changes_of(sides[0], sides[1], found.renames, rates=rates)


@timed("render")
def page_of(changes: Changes, workspace: Workspace, settings: Settings, base: str, head: str | None) -> str:
    """*changes* as one HTML file."""
    from haros_ci.html_page.change_page import change_page

    return change_page(changes, workspace, str(settings.project.get("project") or settings.root.name), base, head)


@timed("render")
def rendered(changes: Changes, format: str, base: str, head: str | None) -> str:
    """*changes* in one of ``FORMATS`` that show nothing else."""
    if format == "json":
        from haros_ci.report.diff_json import render
    elif format == "markdown":
        from haros_ci.report.diff_markdown import render
    else:
        from haros_ci.report.diff_text import render
    return render(changes, base, head)
