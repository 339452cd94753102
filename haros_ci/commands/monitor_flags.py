# SPDX-License-Identifier: Apache-2.0
"""Flags of ``haros-ci monitor``, and the command itself, which is imported only when it runs."""

from __future__ import annotations

from typing import Any

import click

from haros_ci.commands.flags import finding_options, options, workspace_options
from haros_ci.commands.manual import Command

#: What ``haros-ci monitor`` has besides.
monitor_options = options(
    click.argument("path", required=False, type=click.Path()),
    click.option("--bag", metavar="BAG", type=click.Path(), help="A bag of ROS 1 or ROS 2: a file, or a directory."),
    click.option("--jsonl", metavar="FILE", type=click.Path(), help="A message in each line, as JSON."),
    click.option("--configuration", metavar="NAME", help="What has been recorded."),
    click.option(
        "--export",
        metavar="rosmonitoring[=PATH]",
        help="Instead: what ROSMonitoring needs to record the topics of the properties.",
    ),
    click.option(
        "--generate",
        metavar="DIR",
        type=click.Path(file_okay=False),
        help="Instead: write monitors that run beside the system, a file for each configuration.",
    ),
    click.option("--property", metavar="ID|TEXT", multiple=True, help="Only these properties; repeatable."),
    click.option(
        "--clock",
        type=click.Choice(["log", "header"]),
        default="log",
        show_default=True,
        help="Times of recording, or of the messages' headers.",
    ),
    finding_options("text, sarif, github, json, junit, gitlab, rdjson, checkstyle, csv or markdown"),
)


@click.command(cls=Command)
@monitor_options
@workspace_options
def monitor(**flags: Any) -> int:
    """Hold properties in HPL against a recording of messages (docs/monitor.md)."""
    from haros_ci.commands import monitor as monitor_command

    return monitor_command.monitor(flags)
