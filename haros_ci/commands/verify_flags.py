# SPDX-License-Identifier: Apache-2.0
"""The command ``verify`` with its flags; the work is in verify.py, imported only when it runs."""

from __future__ import annotations

from typing import Any

import click

from haros_ci.commands.flags import finding_options, options, workspace_options
from haros_ci.commands.manual import Command

#: What ``haros-ci verify`` has beside what all commands have.
verify_options = options(
    click.argument("path", required=False, type=click.Path()),
    click.option("--configuration", metavar="NAME", help="The system that is looked at."),
    click.option("--property", metavar="ID|TEXT", multiple=True, help="Only these properties; repeatable."),
    click.option(
        "--depth", type=click.IntRange(1, 40), default=12, show_default=True, help="Events that a run has at most."
    ),
    click.option(
        "--budget",
        type=click.FloatRange(0.1, 3600),
        metavar="SECONDS",
        default=10,
        show_default=True,
        help="Time for each property.",
    ),
    click.option(
        "--network",
        type=click.Choice(["instant", "async"]),
        default="instant",
        show_default=True,
        help="Whether messages arrive at once, or later and in their order.",
    ),
    click.option("--latency", metavar="[LOW:]HIGH", help="With async: milliseconds from publishing to arrival."),
    click.option("--loss", is_flag=True, help="With async: a message can be lost where a queue can overflow."),
    click.option(
        "--traces", metavar="DIR", type=click.Path(file_okay=False), help="Write counterexamples for monitor --jsonl."
    ),
    finding_options("text, mermaid, sarif, github, json, junit, gitlab, rdjson, checkstyle, csv or markdown"),
)


@click.command(cls=Command)
@verify_options
@workspace_options
def verify(**flags: Any) -> int:
    """Look for runs that keep the properties of the nodes and violate those of the configuration (docs/verify.md)."""
    from haros_ci.commands import verify as verify_command

    return verify_command.verify(flags)
