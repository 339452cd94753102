# SPDX-License-Identifier: Apache-2.0
"""Flags of ``haros-ci testgen``, and the command itself, which is imported only when it runs."""

from __future__ import annotations

from typing import Any

import click

from haros_ci.commands.flags import options, workspace_options
from haros_ci.commands.manual import Command

#: What ``haros-ci testgen`` has besides.
testgen_options = options(
    click.argument("directory", metavar="DIR", type=click.Path(file_okay=False)),
    click.argument("path", required=False, type=click.Path()),
    click.option("--configuration", metavar="NAME", help="What is tested."),
    click.option("--run", is_flag=True, help="Run the tests, too: start the nodes of the launch files (ROS 1)."),
    click.option(
        "--examples", type=click.IntRange(1), metavar="N", help="So many examples for each property; default: 100."
    ),
    click.option("--non-finite", is_flag=True, help="Send infinities and NaN, too."),
    click.option(
        "--patience",
        type=click.FloatRange(0.01, 60),
        default=2.0,
        show_default=True,
        metavar="SECONDS",
        help="When an answer counts as missing where the property has no bound.",
    ),
)


@click.command(cls=Command)
@testgen_options
@workspace_options
def testgen(**flags: Any) -> int:
    """Write property-based tests of the nodes in PATH into DIR (docs/testgen.md)."""
    from haros_ci.commands import testgen as testgen_command

    return testgen_command.testgen(flags)
