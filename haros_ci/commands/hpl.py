# SPDX-License-Identifier: Apache-2.0
"""``haros-ci hpl``: the properties in files, held against the language and the workspace."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from haros_ci.commands.common import reported, settings_from, store_for
from haros_ci.commands.output import parse_outputs
from haros_ci.errors import UserError
from haros_ci.pipeline import described, finished, found, own_run, selected, selection_of
from haros_ci.results.coverage import coverage
from haros_ci.results.result import Artifact, Report


def hpl(flags: Mapping[str, Any]) -> int:
    """Extract, read, check, write every output; exit code 1 for a finding at or above ``--fail-on``, 2 for wrong usage, else 0."""
    if flags["files"][0] == "suggest" and not Path("suggest").exists():
        if len(flags["files"]) > 1:
            raise UserError("haros-ci hpl suggest takes no files", help="--configuration NAME chooses what it is about")
        from haros_ci.commands.hpl_suggest import suggest

        return suggest(flags)
    from haros_ci.analysis.architectures import Architectures
    from haros_ci.analysis.properties import checked
    from haros_ci.registry import registry

    outputs = parse_outputs(flags["output"])
    # all that the checks say, hints included: of a few files that is not much
    settings = settings_from({**flags, "paths": flags["files"], "no_baseline": True, "profile": "architecture"})
    files = settings.paths
    settings = replace(settings, packages=(), ignore_files=())  # what is named is looked at
    known = registry(settings)
    selection, _ = selection_of(settings, known)
    workspace = found(settings, selection)
    store = store_for(settings)
    read = checked(workspace, Architectures(settings, store, known), files, flags["configuration"], flags["node"])
    workspace = replace(workspace, targets=read.paths | frozenset(files))
    if trouble := store.flush():
        click.echo(f"warning: {trouble}", err=True)
    run = replace(
        own_run(workspace, known),
        results=selected(read.outcome.results, selection, workspace),
        notifications=read.outcome.notifications,
        successful=not read.outcome.notifications,
    )
    report = Report(
        runs=tuple(
            described(finished_run, selection) for finished_run in finished((run,), workspace, selection, settings)
        ),
        coverage=coverage(workspace),
        artifacts=tuple(Artifact(f.path, f.digest, f.size, f.language) for f in workspace.files if f.path in files),
        fail_on=settings.fail_on,
    )
    code = reported(report, workspace, outputs, {}, settings, {**flags, "statistics": False, "why": False})
    click.echo(f"{read.count} {'property' if read.count == 1 else 'properties'} read", err=True)
    return code
