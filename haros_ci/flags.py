# SPDX-License-Identifier: Apache-2.0
"""Flags that several commands share, and what completes them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click

Complete = Callable[[click.Context, click.Parameter, str], list[str]]


def completion_of(what: str) -> Complete:
    """Completes with the words of that kind; they are looked up only when a shell asks."""

    def complete(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[str]:
        from haros_ci.completion import words

        return words(what, incomplete)

    return complete


class Words(click.ParamType):  # type: ignore[type-arg, unused-ignore]
    """A comma-separated list, given once or several times."""

    name = "sel,..."

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[str, ...]:
        return value if isinstance(value, tuple) else tuple(w for w in (p.strip() for p in value.split(",")) if w)


def options(*decorators: Callable[[Any], Any]) -> Callable[[Any], Any]:
    def apply(function: Any) -> Any:
        for decorator in reversed(decorators):
            function = decorator(function)
        return function

    return apply


LEVELS = click.Choice(["error", "warning", "note", "never"])

plugin_option = click.option(
    "--plugin", type=Words(), metavar="MODULE", multiple=True, help="Take in this plug-in (docs/plugins.md)."
)

what_options = options(
    click.argument("paths", nargs=-1, type=click.Path()),
    click.option("--project", type=click.Path(dir_okay=False), help="Project file instead of the one found."),
    click.option("--isolated", is_flag=True, help="Read no project file."),
    click.option(
        "--profile",
        metavar="NAME",
        shell_complete=completion_of("profiles"),
        help="ros (default), strict, google, bugs-only, architecture or all.",
    ),
    click.option(
        "--select",
        type=Words(),
        multiple=True,
        shell_complete=completion_of("rules"),
        help="Turn rules on: ids, tool:id, tools, globs or tags.",
    ),
    click.option(
        "--ignore", type=Words(), multiple=True, shell_complete=completion_of("rules"), help="Turn rules off."
    ),
    click.option("--exclude", metavar="GLOB", multiple=True, help="Leave these files out."),
    click.option("--compile-database", type=click.Path(), help="compile_commands.json, or its directory."),
    plugin_option,
    click.option("--trust-config", is_flag=True, help="Let the workspace's tool configuration run code."),
    click.option("--jobs", "-j", type=click.IntRange(min=1), help="Processes at once; default: all cores."),
    click.option("--cache-dir", type=click.Path(file_okay=False), help="Where the cache lies."),
    click.option("--no-cache", is_flag=True, help="Neither read nor write the cache."),
    click.option("--timings", is_flag=True, help="Say on stderr where the time went."),
)
