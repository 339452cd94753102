# SPDX-License-Identifier: Apache-2.0
"""The command line: flags and exit codes. The work is in commands/common.py, imported only when a command runs."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from typing import Any

import click

from haros_ci.commands.flags import (
    analysis_options,
    costs_option,
    diff_options,
    file_option,
    format_option,
    hpl_options,
    metrics_options,
    page_options,
    policy_options,
    query_options,
    report_options,
    system_options,
    timings_options,
    what_options,
    workspace_options,
)
from haros_ci.commands.manual import EXIT_CODES, Group
from haros_ci.commands.monitor_flags import monitor
from haros_ci.commands.rule_flags import explain_options, rules_options, version_option
from haros_ci.commands.testgen_flags import testgen
from haros_ci.commands.verify_flags import verify
from haros_ci.errors import EXIT_INTERRUPTED, EXIT_TOOL_TROUBLE, EXIT_USAGE, RunFailure, UserError
from haros_ci.interruption import Interrupted, listening
from haros_ci.stack_room import with_room
from haros_ci.streams import flushed, prepare_streams, write_to_stderr


def main(argv: list[str] | None = None) -> int:
    """Run the command line; returns the exit code and never raises (design: exit codes)."""
    try:
        with listening():
            prepare_streams()
            return flushed(with_room(lambda: _outcome(argv)))
    except Interrupted as err:
        write_to_stderr(f"error: ended by {err.name} before the run was complete")
        return flushed(err.code)
    except KeyboardInterrupt:
        return EXIT_INTERRUPTED


def _outcome(argv: list[str] | None) -> int:
    try:
        return _invoked(sys.argv[1:] if argv is None else argv)
    except click.exceptions.Exit as err:
        return err.exit_code
    except click.exceptions.Abort:
        return EXIT_INTERRUPTED
    except click.ClickException as err:
        with suppress(OSError):
            err.show()
        return EXIT_USAGE
    except (UserError, RunFailure) as err:
        from haros_ci.report.escape import terminal

        write_to_stderr(f"error: {terminal(err.message)}", *([f"help: {terminal(err.help)}"] if err.help else []))
        return EXIT_USAGE if isinstance(err, UserError) else EXIT_TOOL_TROUBLE
    except BrokenPipeError:  # the reader closed the pipe: nothing to report
        return EXIT_TOOL_TROUBLE
    except Exception as err:
        if isinstance(err.__cause__, (Interrupted, KeyboardInterrupt)):
            raise err.__cause__ from None  # Python before 3.12 makes a RuntimeError of what comes while a class is made
        if os.environ.get("HAROS_CI_DEBUG"):
            raise
        from haros_ci.internal_errors import described

        code, *lines = described(err)
        write_to_stderr(*lines)
        return code


def _invoked(argv: list[str]) -> int:
    """What the command returns. Not click's own ``main``, to which a closed pipe is exit code 1: that of a finding."""
    if "_HAROS_CI_COMPLETE" in os.environ:
        haros_ci.main(args=argv, prog_name="haros-ci")
    with haros_ci.make_context("haros-ci", list(argv)) as context:
        outcome = haros_ci.invoke(context)
    return outcome if isinstance(outcome, int) else 0


@click.group(
    cls=Group, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110}, epilog=EXIT_CODES
)
@version_option
def haros_ci() -> None:
    """Linters, metrics and ROS architecture checks for ROS 1 and ROS 2 workspaces, as SARIF, with baselines.

    Needs no ROS, no build, no configuration: haros-ci check .
    """


@haros_ci.command()
@what_options
@report_options
@click.option("--fix", is_flag=True, help="Mend what can be mended for certain, then report what is left.")
@click.option("--diff", is_flag=True, help="Print what --fix would change as a patch; exit with 1 if there is any.")
@click.option("--show-settings", is_flag=True, help="Print the effective settings and stop.")
@click.option(
    "--watch", is_flag=True, help="Run again when a file has changed, and show what that made new, until Ctrl-C."
)
@click.option("--stdin-filename", metavar="FILE", help="With - as PATH: the file that standard input is the text of.")
@click.option("--shard", metavar="I/N", help="Do the I-th of N parts, and write it for merge: --output shard=FILE.")
@costs_option
def check(**flags: Any) -> int:
    """Analyse PATHS (default: the current directory) and report what is new."""
    from haros_ci.commands import common as commands

    return commands.check(flags)


@haros_ci.command()
@click.argument("files", nargs=-1, required=True, type=click.Path())
@click.option("--path", "paths", metavar="PATH", multiple=True, help="The PATHS that the shards were given.")
@analysis_options
@report_options
@click.option(
    "--write-costs", type=click.Path(dir_okay=False), help="Write what each part has cost, for --shard-costs."
)
def merge(**flags: Any) -> int:
    """Report what the shards in FILES have found together, as one check of all would (docs/shards.md).

    Run it in a checkout of the same commit, with the options that the shards were given. No linter is needed.
    """
    from haros_ci.commands import merge as merge_command

    return merge_command.merge(flags)


@haros_ci.group()
def baseline() -> None:
    """Keep the file of known findings (.haros-ci-baseline.jsonl)."""


@baseline.command()
@what_options
@file_option
@click.option("--force", is_flag=True, help="Write an existing FILE anew.")
def create(**flags: Any) -> int:
    """Record today's findings as known, in a new file."""
    from haros_ci.commands import baseline as baseline_command

    return baseline_command.create(flags)


@baseline.command()
@what_options
@file_option
@click.option("--accept-new", is_flag=True, help="Record new findings, too.")
def update(**flags: Any) -> int:
    """Refresh known findings that have moved or changed, and drop those that are gone."""
    from haros_ci.commands import baseline as baseline_command

    return baseline_command.update(flags)


@baseline.command()
@what_options
@file_option
def prune(**flags: Any) -> int:
    """Drop known findings that are gone; change nothing else."""
    from haros_ci.commands import baseline as baseline_command

    return baseline_command.prune(flags)


@baseline.command()
@file_option
def show(**flags: Any) -> int:
    """List what a baseline file holds."""
    from haros_ci.commands import baseline as baseline_command

    return baseline_command.show(flags)


@haros_ci.command()
@click.argument("paths", nargs=-1, type=click.Path())
@format_option(
    *("text", "json", "dot", "mermaid", "svg", "sqlite", "nodl", "readme"),
    help="As a table, data, a picture, a database, or files for each node type or package.",
)
@click.option("--compact", is_flag=True, help="With json: on one line, and what several configurations have once.")
@click.option(
    "--output", type=click.Path(), help="File to write, of nodl and readme also a directory; default: stdout."
)
@system_options
@click.option(
    "--expect", type=click.Path(dir_okay=False), help="Compare with the architecture that this file declares."
)
@click.option("--check-readme", is_flag=True, help="Compare with the interface tables of the packages' READMEs.")
@click.option("--coverage", is_flag=True, help="Tell which calls of ROS APIs the model has, and which it lacks.")
@click.option(
    "--observed", metavar="FILE", type=click.Path(), help="Tell what this bag or .jsonl file has beside the model."
)
@workspace_options
@timings_options
def model(**flags: Any) -> int:
    """Reconstruct the running system from source: nodes, topics, services, actions, parameters."""
    from haros_ci.commands import model as model_command

    return model_command.model(flags)


@haros_ci.command()
@query_options
@workspace_options
def query(**flags: Any) -> int:
    """Ask a QUERY of the running systems, as HAROS does: topics[len(self.publishers) > 1] (docs/queries.md)."""
    from haros_ci.commands import query as query_command

    return query_command.query(flags)


@haros_ci.command()
@metrics_options
@workspace_options
@click.option("--jobs", "-j", type=click.IntRange(min=1), help="Processes at once; default: all cores.")
@timings_options
def metrics(**flags: Any) -> int:
    """Measure functions, classes, files and packages, with HAROS's limits beside the values."""
    from haros_ci.commands import metrics as metrics_command

    return metrics_command.metrics(flags)


@haros_ci.command("report")
@what_options
@page_options
def report_(**flags: Any) -> int:
    """Write one HTML file of findings and running systems."""
    from haros_ci.commands import report as report_command

    return report_command.report(flags)


@haros_ci.command()
@policy_options
@workspace_options
def policy(**flags: Any) -> int:
    """Write a security policy (SROS2) that allows what the nodes of LAUNCH files, or of all configurations, do."""
    from haros_ci.commands import policy as policy_command

    return policy_command.policy(flags)


@haros_ci.command()
@hpl_options
@workspace_options
def hpl(**flags: Any) -> int:
    """Check the properties in each FILE, written in HPL, against the language and the workspace (docs/hpl.md).

    haros-ci hpl suggest prints properties that the code suggests.
    """
    from haros_ci.commands import hpl as hpl_command

    return hpl_command.hpl(flags)


haros_ci.add_command(monitor)
haros_ci.add_command(testgen)
haros_ci.add_command(verify)


@haros_ci.command()
@diff_options
@workspace_options
@timings_options
def diff(**flags: Any) -> int:
    """Say what the change from BASE to HEAD (default: the work tree) does to interfaces, graph, parameters and QoS."""
    from haros_ci.commands import diff as diff_command

    return diff_command.diff(flags)


@haros_ci.command()
@rules_options
def rules(**flags: Any) -> int:
    """List the documented rules that FILTER fits (a glob, a part of an id or summary, a tag), or all of them."""
    from haros_ci.commands import rules as rules_command

    if flags["standards"]:
        return rules_command.standards_table()
    return rules_command.check_table() if flags["as_checks"] else rules_command.rules(flags)


@haros_ci.command()
@explain_options
def explain(rule: str, **flags: Any) -> int:
    """Say what a RULE means, why it matters and how to silence it."""
    from haros_ci.commands import explain as explain_command

    return explain_command.explain(rule, flags)


@haros_ci.command()
@click.argument("path", required=False, type=click.Path())
@click.option("--dry-run", is_flag=True, help="Only show what would be written.")
def init(**flags: Any) -> int:
    """Write a GitHub workflow, a pre-commit configuration and a project file for the workspace; overwrite nothing."""
    from haros_ci.commands import init as init_command

    return init_command.init(flags)


@haros_ci.command("new-check")
@click.argument("name")
def new_check_(name: str) -> int:
    """Begin a new check called NAME in a clone of haros-ci: its module and its page."""
    from pathlib import Path

    from haros_ci.commands.new_check import new_check

    for path in new_check(name, Path.cwd()):
        click.echo(f"checks/{path.name}")
    return 0


@haros_ci.command()
@click.argument("action", type=click.Choice(["dir", "stats", "clear"]))
@click.option("--cache-dir", type=click.Path(file_okay=False), help="Where the cache lies.")
def cache(action: str, cache_dir: str | None) -> int:
    """Show or clear the cache; deleting it is always safe."""
    from haros_ci.commands import cache as cache_command

    return cache_command.cache(action, cache_dir)


@haros_ci.command()
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
def completion(shell: str) -> int:
    """Print the script that completes haros-ci's commands, options, formats, profiles and rules in SHELL."""
    from haros_ci.commands.completion import script

    click.echo(script(haros_ci, shell))
    return 0
