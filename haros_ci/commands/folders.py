# SPDX-License-Identifier: Apache-2.0
"""Formats that are directories of files: HAROS's data files, made of a report and of what it was made of."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import click

from haros_ci.analysis.architectures import Architectures
from haros_ci.commands.common import Flags, Progress, under_cache
from haros_ci.commands.output import text_in
from haros_ci.config.settings import Settings
from haros_ci.errors import UserError
from haros_ci.haros_json.documents import PROJECTS, added
from haros_ci.haros_json.gather import gathered
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.result import Report
from haros_ci.writing import put_below


def fill(
    folders: Sequence[Path],
    report: Report,
    workspace: Workspace,
    settings: Settings,
    flags: Flags,
    known: Architectures | None = None,
) -> bool:
    """Write HAROS's data files into each of *folders*; whether all that belongs into them could be found out."""

    def made(store: Store, progress: Progress) -> tuple[dict[str, str], tuple[str, ...]]:
        progress("haros-json")
        return gathered(report, workspace, (known or Architectures(settings, store)).under(store))

    files, failed = under_cache(made, settings, flags)
    for tool in sorted(set(failed) - set(report.failed_tools())):
        click.echo(f"error: {tool} failed: values of metrics are missing in haros-json", err=True)
    for folder in folders:
        try:
            whole = added(files, partial(text_in, folder))
        except ValueError as err:
            message = f"{folder / PROJECTS}: is no list of projects"
            raise UserError(message, help="remove it, or name another --output directory") from err
        put_below(folder, whole)
    return not set(failed) - settings.allow_tool_failure
