# SPDX-License-Identifier: Apache-2.0
"""``haros-ci policy``: a security policy (SROS2) of what the nodes of a configuration do."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from haros_ci.analysis.architecture import architecture
from haros_ci.analysis.requested import chosen
from haros_ci.commands.common import cores, settings_from, store_for
from haros_ci.commands.model import assignment, selected, tell
from haros_ci.errors import UserError
from haros_ci.report.escape import terminal
from haros_ci.security.write import policy_of
from haros_ci.workspace.discover import discover
from haros_ci.writing import write


def policy(flags: Mapping[str, Any]) -> int:
    """Extract, link, write; unknowns are reported on stderr. Exit code 2 for wrong usage, else 0."""
    settings = settings_from({**flags, "paths": (), "no_baseline": True})
    workspace = discover(settings.root, settings.paths, exclude=settings.exclude, max_file_size=settings.max_file_size)
    store = store_for(settings)
    arguments = dict(assignment(item, "--arg", ":=") for item in flags["arg"])
    launches = chosen(workspace, flags["launch"], arguments, "command line") if flags["launch"] else None
    if arguments and launches is None:
        raise UserError("--arg is for launch files", help="name them: haros-ci policy package/launch/x.launch.py")
    found = architecture(workspace, settings, store, requested=launches, processes=cores())
    if problem := store.flush():
        click.echo(f"warning: {problem}", err=True)
    found = selected(found, flags["configuration"])
    tell(tuple(dict.fromkeys((*workspace.problems, *workspace.faults, *found.problems))))
    written = policy_of(node for configuration in found.configurations for node in configuration.nodes)
    if written is None:
        raise UserError(
            "no node of ROS 2 whose name is known", help="security policies are for ROS 2; see haros-ci model"
        )
    for gap in written.gaps:
        click.echo(f"warning: {terminal(gap)}", err=True)
    write(written.text, Path(flags["output"]) if flags["output"] else None)
    return 0
