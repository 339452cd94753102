# SPDX-License-Identifier: Apache-2.0
"""Flags that several commands share, and what completes them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem


def completion_of(what: str) -> Callable[[click.Context, click.Parameter, str], list[CompletionItem]]:
    """Completes with the words of that kind, behind FORMAT= with files; they are looked up only when a shell asks."""

    def complete(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        from click.shell_completion import CompletionItem

        from haros_ci.commands.completion import words

        if what == "formats" and "=" in incomplete:
            return [CompletionItem(incomplete, type="file")]
        return [CompletionItem(word) for word in words(what, incomplete)]

    return complete


class CommaList(click.ParamType):  # type: ignore[type-arg, unused-ignore]  # generic in later versions of click
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
    "--plugin", type=CommaList(), metavar="MODULE", multiple=True, help="Take in this plug-in (docs/plugins.md)."
)

exact_option = click.option(
    "--exact", is_flag=True, help="Let libclang fill what is unknown, where ROS headers are installed (docs/exact.md)."
)

timings_options = options(
    click.option("--timings", is_flag=True, help="Say on stderr where the time went."),
    click.option("--verbose", "-v", is_flag=True, help="Say more: --timings and, of findings, --why and --statistics."),
)

path_arguments = click.argument("paths", nargs=-1, type=click.Path())
analysis_options = options(
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
        type=CommaList(),
        multiple=True,
        shell_complete=completion_of("rules"),
        help="Turn rules on: ids, tool:id, tools, globs or tags.",
    ),
    click.option(
        "--ignore", type=CommaList(), multiple=True, shell_complete=completion_of("rules"), help="Turn rules off."
    ),
    click.option("--exclude", metavar="GLOB", multiple=True, help="Leave these files out."),
    click.option("--compile-database", type=click.Path(), help="compile_commands.json, or its directory."),
    exact_option,
    plugin_option,
    click.option(
        "--plugin-whitelist", type=CommaList(), multiple=True, help="Of the HAROS plug-ins installed, run these."
    ),
    click.option("--plugin-blacklist", type=CommaList(), multiple=True, help="HAROS plug-ins that do not run."),
    click.option(
        "--plugin-export", type=click.Path(file_okay=False), help="Where the files go that HAROS plug-ins export."
    ),
    click.option("--trust-config", is_flag=True, help="Let the workspace's tool configuration run code."),
    click.option("--jobs", "-j", type=click.IntRange(min=1), help="Processes at once; default: all cores."),
    click.option("--cache-dir", type=click.Path(file_okay=False), help="Where the cache lies."),
    click.option("--no-cache", is_flag=True, help="Neither read nor write the cache."),
    timings_options,
)


def output_options(formats: str) -> Callable[[Any], Any]:
    """Where results go, in which of these *formats*, and for whom the SARIF is."""
    return options(
        click.option(
            "--output",
            metavar="FORMAT[=PATH]",
            multiple=True,
            shell_complete=completion_of("formats"),
            help=f"{formats}; repeatable.",
        ),
        click.option(
            "--sarif-for",
            type=click.Choice(["archive", "github"]),
            default="archive",
            show_default=True,
            help="Who reads the SARIF.",
        ),
    )


def finding_options(formats: str) -> Callable[[Any], Any]:
    """The same of findings alone, which may fail the run."""
    return options(
        output_options(formats),
        click.option("--fail-on", type=LEVELS, help="Lowest level of a finding that fails the run; default: warning."),
    )


report_options = options(
    output_options("text, sarif, github, json, junit, gitlab, rdjson, checkstyle, csv, markdown, html or haros-json"),
    click.option("--baseline", type=click.Path(), help="Known findings: a SARIF log or a .haros-ci-baseline.jsonl."),
    click.option(
        "--baseline-rev", metavar="REV", help="Known findings: those of the merge-base with this git revision."
    ),
    click.option("--no-baseline", is_flag=True, help="Ignore the workspace's own baseline file."),
    click.option(
        "--require-baseline/--no-require-baseline",
        default=None,
        help="Exit with 3 if there is no baseline to compare with, or report every finding where the base revision cannot be had; "
        "default: report nothing then, and exit with 2.",
    ),  # fmt: skip
    click.option("--import", "imports", metavar="FILE.sarif", multiple=True, help="Take in another tool's log."),
    click.option("--fail-on", type=LEVELS, help="Lowest level of a new result that fails the run; default: warning."),
    click.option(
        "--allow-tool-failure",
        metavar="TOOL",
        multiple=True,
        shell_complete=completion_of("tools"),
        help="This tool's trouble does not fail the run.",
    ),
    click.option("--why", is_flag=True, help="Say for each result why it is new or which old one it matched."),
    click.option("--statistics", is_flag=True, help="Counts per rule and tool at the end."),
    click.option("--quiet", "-q", is_flag=True, help="With text: findings alone, without summary and progress."),
)


costs_option = click.option(
    "--shard-costs",
    type=click.Path(dir_okay=False),
    help="Divide by what --write-costs of an earlier merge has written.",
)

#: The file of known findings.
file_option = click.option(
    "--file", type=click.Path(dir_okay=False), help="Default: .haros-ci-baseline.jsonl at the root."
)


def format_option(*formats: str, help: str) -> Callable[[Any], Any]:
    """What a command prints, the first of *formats* by default."""
    return click.option("--format", type=click.Choice(formats), default=formats[0], show_default=True, help=help)


def what_options(function: Any) -> Any:
    return path_arguments(analysis_options(function))


#: What commands have that read a workspace and report no findings.
workspace_options = options(
    click.option("--project", type=click.Path(dir_okay=False), help="Project file instead of the one found."),
    click.option("--isolated", is_flag=True, help="Read no project file."),
    plugin_option,
    click.option("--exclude", metavar="GLOB", multiple=True, help="Leave these files out."),
    click.option("--cache-dir", type=click.Path(file_okay=False), help="Where the cache lies."),
    click.option("--no-cache", is_flag=True, help="Neither read nor write the cache."),
)

#: What haros-ci query has besides.
query_options = options(
    click.argument("text", metavar="QUERY", required=False),
    click.argument("paths", nargs=-1, type=click.Path()),
    click.option("--file", type=click.Path(dir_okay=False), help="Read the query here; all arguments are PATHS then."),
    click.option(
        "--scope",
        type=click.Choice(["configuration", "package", "global"]),
        default="configuration",
        show_default=True,
        help="What the query is asked of, one after the other.",
    ),
    format_option("text", "json", help="As a table or as data."),
    click.option("--fail-on-match", is_flag=True, help="Exit with 1 if anything matches."),
    click.option("--configuration", metavar="NAME", multiple=True, help="Only these configurations."),
    click.option("--launch", metavar="FILE", multiple=True, help="These launch files as one configuration."),
    click.option("--arg", metavar="NAME:=VALUE", multiple=True, help="An argument of the launch files."),
)

#: What haros-ci hpl has besides.
hpl_options = options(
    click.argument("files", nargs=-1, required=True, type=click.Path(), metavar="FILE..."),
    click.option(
        "--configuration", metavar="NAME", multiple=True, help="The properties are about these configurations."
    ),
    click.option("--node", metavar="PACKAGE/EXECUTABLE", multiple=True, help="The properties are about these nodes."),
    finding_options("text, sarif, github, json, junit, gitlab, rdjson, checkstyle, csv or markdown"),
)

#: What ``report`` has beside what is analysed.
page_options = options(
    click.option(
        "--output",
        type=click.Path(dir_okay=False),
        default="haros-ci-report.html",
        show_default=True,
        help="File to write.",
    ),
    click.option("--base", metavar="REV", help="Show what has changed since the merge-base with this git revision."),
    click.option("--baseline", type=click.Path(), help="Known findings: a SARIF log or a .haros-ci-baseline.jsonl."),
    click.option("--configuration", metavar="NAME", multiple=True, help="Only these configurations."),
    click.option("--rates", is_flag=True, help="Show how often each node publishes (docs/rates.md)."),
    click.option("--dependence", is_flag=True, help="Show which inputs cause which outputs (docs/dependence.md)."),
    click.option("--open", "open_page", is_flag=True, help="Open the page in a browser, except in CI."),
    click.option(
        "--history",
        type=click.Path(file_okay=False),
        metavar="DIR",
        help="Show the commits that --output haros-json=DIR has kept.",
    ),
    click.option(
        "--verdicts",
        type=click.Path(dir_okay=False),
        metavar="FILE",
        multiple=True,
        help="Show what haros-ci monitor --output json=FILE says of a recording.",
    ),
    click.option(
        "--allow-tool-failure",
        metavar="TOOL",
        multiple=True,
        shell_complete=completion_of("tools"),
        help="This tool's trouble does not make the exit code 3.",
    ),
)

#: Which systems ``model`` makes.
system_options = options(
    click.option("--launch", metavar="FILE", multiple=True, help="These launch files as one configuration."),
    click.option("--arg", metavar="NAME:=VALUE", multiple=True, help="An argument of the launch files."),
    click.option("--env", metavar="NAME=VALUE", multiple=True, help="What $(env NAME) is in launch files."),
    click.option("--configuration", metavar="NAME", multiple=True, help="Only these configurations."),
    click.option("--as-running", is_flag=True, help="What ROS 1 nodelets make stands under their manager's name."),
    click.option("--rates", is_flag=True, help="With how often each node publishes (docs/rates.md)."),
    click.option("--dependence", is_flag=True, help="With which inputs cause which outputs (docs/dependence.md)."),
    click.option("--affects", metavar="NAME", multiple=True, help="All that this topic, service or action reaches."),
    click.option("--caused-by", metavar="NAME", multiple=True, help="All that reaches this topic, service or action."),
    click.option("--no-known-nodes", is_flag=True, help="Leave out what is known of nodes outside the workspace."),
    exact_option,
)

#: What haros-ci policy has besides.
policy_options = options(
    click.argument("launch", nargs=-1, metavar="[LAUNCH]..."),
    click.option("--output", type=click.Path(dir_okay=False), help="File to write; default: stdout."),
    click.option("--arg", metavar="NAME:=VALUE", multiple=True, help="An argument of the launch files."),
    click.option("--configuration", metavar="NAME", multiple=True, help="Only these configurations."),
)

#: What haros-ci diff has besides.
diff_options = options(
    click.argument("base"),
    click.argument("head", required=False),
    format_option("text", "markdown", "json", "html", help="For a terminal, a pull request, a program or a browser."),
    click.option("--output", type=click.Path(), help="File to write; default: stdout."),
    click.option("--merge-base", is_flag=True, help="Compare with the commit at which HEAD's history left BASE's."),
    click.option("--exit-code", is_flag=True, help="Exit with 1 if anything has changed."),
    click.option("--rates", is_flag=True, help="Compare rates even if no timer has another period."),
)

#: What haros-ci metrics has besides.
metrics_options = options(
    click.argument("paths", nargs=-1, type=click.Path()),
    format_option("text", "json", "csv", help="A line for each function, class, file and package, or data."),
    click.option("--output", type=click.Path(dir_okay=False), help="File to write; default: stdout."),
    click.option(
        "--level",
        type=click.Choice(["package", "file", "class", "function"]),
        multiple=True,
        help="Only values of these.",
    ),
    click.option(
        "--metric",
        metavar="NAME",
        multiple=True,
        shell_complete=completion_of("metrics"),
        help="Only these metrics (docs/metrics.md).",
    ),
    click.option(
        "--worst",
        type=click.IntRange(min=0),
        metavar="N",
        default=10,
        show_default=True,
        help="With text: first a table of the N that are furthest over a limit; 0 for none.",
    ),
    click.option("--quiet", "-q", is_flag=True, help="With text: that table alone."),
)
