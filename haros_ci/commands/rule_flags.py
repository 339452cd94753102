# SPDX-License-Identifier: Apache-2.0
"""Flags of the commands that say what there is: versions, rules, one rule."""

from __future__ import annotations

import click

from haros_ci.commands.flags import completion_of, options, plugin_option


def _print_version(ctx: click.Context, param: click.Parameter, value: bool) -> None:
    """Ends the program with our version and those of the tools, if that is what is asked."""
    if value and not ctx.resilient_parsing:
        from haros_ci import __version__
        from haros_ci.commands.versions import text

        click.echo(text(__version__))
        ctx.exit()


version_option = click.option(
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_print_version,
    help="Show the versions of haros-ci and its tools, and exit.",
)

#: What ``haros-ci rules`` has.
rules_options = options(
    click.argument("filter", required=False),
    click.option(
        "--tool",
        metavar="NAME",
        multiple=True,
        shell_complete=completion_of("tools"),
        help="Only rules of this tool; repeatable.",
    ),
    click.option("--enabled", "only_enabled", is_flag=True, help="Only rules that the profile turns on."),
    click.option("--json", "as_json", is_flag=True, help="As JSON."),
    click.option(
        "--checks", "as_checks", is_flag=True, help="Only our own checks, as the Markdown table of docs/checks.md."
    ),
    click.option(
        "--standards", is_flag=True, help="CERT, CWE and others with the rules for them, as docs/standards.md."
    ),
    click.option("--profile", metavar="NAME", default="ros", show_default=True, help="Mark what this profile enables."),
    plugin_option,
)

#: What ``haros-ci explain`` has.
explain_options = options(
    click.argument("rule", shell_complete=completion_of("rules")),
    click.option("--full", is_flag=True, help="The whole page, with all examples and limits."),
    plugin_option,
)
