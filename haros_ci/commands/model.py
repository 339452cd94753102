# SPDX-License-Identifier: Apache-2.0
"""``haros-ci model``: the architecture, in the format asked for, and how a declared or documented one differs."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from haros_ci.analysis.kept_runs import Output, kept_output
from haros_ci.commands.collector import without_collector
from haros_ci.commands.common import cores, settings_from, store_for
from haros_ci.commands.timings import with_timings
from haros_ci.config.settings import Settings
from haros_ci.errors import UserError
from haros_ci.model.architecture import Architecture
from haros_ci.model.running import as_running
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.report.escape import log_line, terminal
from haros_ci.timing import remark, stage, timed
from haros_ci.workspace.cache import DiskCache, MemoryCache
from haros_ci.workspace.discover import discover
from haros_ci.writing import put as put_bytes

#: The most problems that are printed one by one.
SHOWN = 20
#: Options that say what of the architecture is made, and how it is written.
OPTIONS = (
    *(
        "launch",
        "arg",
        "env",
        "no_known_nodes",
        "as_running",
        "configuration",
        "format",
        "compact",
        "rates",
        "dependence",
    ),
    *("affects", "caused_by"),
)
#: Options that choose of what is printed, and change nothing of which calls the model has.
UNCOVERED = (
    "configuration",
    "as_running",
    "expect",
    "check_readme",
    "rates",
    "dependence",
    "affects",
    "caused_by",
    "observed",
)
#: What --format json --compact is called here.
COMPACT = "compact json"
FORMATS = ("text", "json", "dot", "mermaid", "svg", "sqlite", "nodl", "readme")


@with_timings
def model(flags: Mapping[str, Any]) -> int:
    """Extract, link, print; exit code 1 if what is expected or documented differs, 2 for wrong usage, else 0."""
    refuse(flags)
    format = COMPACT if flags["compact"] else flags["format"]
    without_collector()
    settings = settings_from({**flags, "no_baseline": True})
    workspace = discover(settings.root, settings.paths, exclude=settings.exclude, max_file_size=settings.max_file_size)
    store = store_for(settings)
    arguments = dict(assignment(text, "--arg", ":=") for text in flags["arg"])
    environment = dict(assignment(text, "--env", "=") for text in flags["env"])
    if arguments and not flags["launch"]:
        raise UserError("--arg is for the launch files of --launch", help="name them: --launch package/launch/x.launch")
    options: dict[str, Any] = {
        "requested": None,
        "alternatives": False,
        "environment": environment,
        "known_nodes": not flags["no_known_nodes"],
        "exact": flags["exact"],
        "processes": cores(),
    }
    if flags["launch"]:
        from haros_ci.analysis.requested import chosen

        options["requested"] = chosen(workspace, flags["launch"], arguments, "command line")

    def make() -> tuple[Architecture, tuple[str, ...]]:
        with stage("loading"):  # what is kept does without all that follows nodes
            from haros_ci.analysis.architecture import varied
            from haros_ci.analysis.code_of import code_of
            from haros_ci.analysis.unmodelled import of_tests, unmodelled
        made = varied(workspace, settings, store, **options)
        found = selected(made.architecture, flags["configuration"])
        if flags["rates"] or flags["observed"]:
            from haros_ci.analysis.rates import with_rates

            found = with_rates(found, code_of(made, workspace))
        if flags["dependence"] or flags["affects"] or flags["caused_by"]:
            from haros_ci.analysis.dependence import with_dependence

            found = with_dependence(found, code_of(made, workspace), flags["affects"], flags["caused_by"])
        found = as_running(found) if flags["as_running"] else found
        problems = (*workspace.problems, *workspace.faults, *found.problems)
        found = replace(found, problems=tuple(dict.fromkeys(problems)))
        unknown = notes(unmodelled(made.architecture, made.builds, made.sources))
        tests = notes(() if flags["launch"] else of_tests(workspace))
        return found, (*notes(settings.notes), *warnings(found.problems), *unknown, *tests)

    def output() -> Output:
        found, messages = make()
        return Output(encoded(rendered(found, format)), messages)

    path = Path(flags["output"]) if flags["output"] else None
    code = 0
    if flags["coverage"]:
        from haros_ci.analysis.architecture import varied
        from haros_ci.analysis.coverage import coverage_of
        from haros_ci.commands.coverage import content

        covered = content(coverage_of(varied(workspace, settings, store, **options), workspace, settings), format)
        end(store, notes(settings.notes))
        put_content(covered, format, path)
        return 0
    if flags["observed"]:
        from haros_ci.commands.observed import compared, recording_at

        recording = recording_at(flags["observed"])
        found, messages = make()
        end(store, messages)
        put_content(encoded(compared(found, recording, flags["format"])), format, path)
    elif is_kept(flags, settings):
        from haros_ci.config.digests import settings_digests

        key = repr(
            (settings.project_file, settings.notes, settings_digests(settings, ()), *(flags[name] for name in OPTIONS))
        )
        is_binary = flags["format"] == "sqlite"
        kept = kept_output("model", output, workspace, key, store, is_binary=is_binary)
        end(store, kept.messages)
        put_content(kept.content, format, path)
    else:
        found, messages = make()
        end(store, messages)
        if path is not None or not flags["check_readme"]:
            put(found, format, path, workspace.root)
        code = expected(found, flags["expect"]) if flags["expect"] else 0
        code = max(code, documented(workspace, found)) if flags["check_readme"] else code
    remark(f"cache: {store.stats}")
    return code


def refuse(flags: Mapping[str, Any]) -> None:
    """UserError for options that do not go together."""
    if flags["compact"] and flags["format"] != "json":
        raise UserError(f"--compact is for json, not {flags['format']}", help="write --format json --compact")
    if flags["coverage"] and (flags["compact"] or flags["format"] not in ("text", "json")):
        raise UserError("--coverage is text or json", help="write --coverage --format json")
    if flags["observed"] and (flags["compact"] or flags["format"] not in ("text", "json")):
        raise UserError("--observed is text or json", help="write --observed FILE --format json")
    others = [name for name in UNCOVERED if flags[name]] if flags["coverage"] else []
    if others:
        option = f"--{others[0].replace('_', '-')}"
        raise UserError(
            f"--coverage is about the code of the whole workspace, so {option} has no say in it",
            help=f"leave {option} out; --launch is the option that looks at some launch files only",
        )


def is_kept(flags: Mapping[str, Any], settings: Settings) -> bool:
    """Whether the same options give the same output for the same files: no plug-in, compiler or further file has a say."""
    further = flags["exact"] or flags["expect"] or flags["check_readme"] or flags["format"] in ("nodl", "readme")
    return not (settings.plugins or further)


def end(store: DiskCache | MemoryCache, messages: Iterable[str]) -> None:
    """Write the cache, and *messages* to the standard error."""
    problem = store.flush()
    if problem:
        click.echo(f"warning: {problem}", err=True)
    for line in messages:
        click.echo(log_line(line), err=True)


def put(found: Architecture, format: str, path: Path | None, root: Path) -> None:
    """Write *found* to *path*, or to stdout; UserError if that is not possible."""
    if format in ("nodl", "readme"):
        from haros_ci.commands.interface_files import put as put_interfaces

        put_interfaces(found, format, path, root)
        return
    put_content(encoded(rendered(found, format)), format, path)


@timed("render")
def put_content(content: bytes, format: str, path: Path | None) -> None:
    """Write *content* to *path*, or to stdout; UserError if that is not possible."""
    if path is not None:
        if path.is_dir():
            raise UserError(f"{path} is a directory", help="name a file; nodl and readme write one for each package")
        put_bytes(content, path)
    elif format == "sqlite":
        raise UserError("SQLite is a binary file", help="name it: --output model.db")
    else:
        sys.stdout.flush()
        sys.stdout.buffer.write(content)


def encoded(content: str | bytes) -> bytes:
    """*content* as it is written: text in UTF-8."""
    return content.encode("utf-8", "backslashreplace") if isinstance(content, str) else content


def tell(problems: tuple[Problem, ...]) -> None:
    """The first problems on stderr, and how many there are beside them."""
    for line in warnings(problems):
        click.echo(line, err=True)


def notes(sentences: Iterable[str]) -> Iterator[str]:
    """A line for each of *sentences*."""
    return (f"note: {terminal(sentence)}" for sentence in sentences)


def warnings(problems: tuple[Problem, ...]) -> Iterator[str]:
    """A line for each of the first problems, and how many there are beside them."""
    for problem in problems[:SHOWN]:
        at = f"{problem.path}:{problem.line}" if problem.line else problem.path
        yield f"warning: {terminal(at)}: {terminal(problem.message)}"
    if len(problems) > SHOWN:
        yield f"warning: and {len(problems) - SHOWN} more; --format json has them all"


@timed("render")
def rendered(found: Architecture, format: str) -> str | bytes:
    """*found* in one of ``FORMATS``, or ``COMPACT``."""
    if format in ("dot", "mermaid") and any(one.dependence is not None for one in found.configurations):
        from haros_ci.report import model_dependence_graph as graph

        return graph.dot(found) if format == "dot" else graph.mermaid(found)
    if format == COMPACT:
        from haros_ci.report.model_compact import render
    elif format == "json":
        from haros_ci.report.model_json import render
    elif format == "dot":
        from haros_ci.report.model_dot import render
    elif format == "mermaid":
        from haros_ci.report.model_mermaid import render
    elif format == "svg":
        return drawn(found)
    elif format == "sqlite":
        from haros_ci.report.model_sqlite import render as render_bytes

        return render_bytes(found)
    else:
        from haros_ci.report.model_text import render
    return render(found)


def drawn(found: Architecture) -> str:
    """The picture of the one configuration of *found*; UserError if there are others, or it is too large."""
    from haros_ci.html_page.svg import render

    if len(found.configurations) != 1:
        known = ", ".join(sorted(one.name for one in found.configurations)[:20]) or "none"
        raise UserError(
            "svg is a picture of one configuration", help=f"name it: --configuration NAME; there are {known}"
        )
    text = render(found.configurations[0])
    if text is None:
        raise UserError(
            "it is too large for a picture", help="haros-ci report shows it as lists, --format dot draws it"
        )
    return text


def selected(found: Architecture, names: tuple[str, ...]) -> Architecture:
    """Only the configurations called *names*, all without any; UserError for one that is not there."""
    if not names:
        return found
    known = [c.name for c in found.configurations]
    for name in names:
        if name not in known:
            raise UserError(f"no configuration {name}", help=f"there are {', '.join(known) or 'none'}")
    return replace(found, configurations=tuple(c for c in found.configurations if c.name in names))


def assignment(text: str, option: str, sign: str) -> tuple[str, str]:
    name, found, value = text.partition(sign)
    if not found or not name:
        raise UserError(f"{option} {text} sets nothing", help=f"write {option} name{sign}value")
    return name, value


def expected(found: Architecture, path: str) -> int:
    """Compare with the architecture that the file declares, and say on stdout where they differ."""
    from haros_ci.baselines import read_input
    from haros_ci.bounded_yaml import YamlFault, YamlLimits, data
    from haros_ci.declared.expectation import compare, problems

    try:
        declared = data(
            read_input(Path(path), path).decode("utf-8-sig"), YamlLimits(characters=10_000_000, aliases=1_000)
        )
    except UnicodeDecodeError as err:
        raise UserError(f"{path} cannot be read: it is not UTF-8 text", help="save the file as UTF-8") from err
    except YamlFault as err:
        at = f"{path}:{err.line}" if err.is_placed else path
        raise UserError(f"{at} cannot be read: {err.message}", help="it is YAML, as in docs/model.md") from err
    for problem in problems(declared, path, [c.name for c in found.configurations]):
        click.echo(f"warning: {terminal(problem.path)}: {terminal(problem.message)}", err=True)
    count = 0
    for configuration in found.configurations:
        for difference in compare(configuration, declared, found.packages):
            at = f"{difference.location}: " if difference.location is not None else ""
            click.echo(log_line(f"{at}{difference.level}: {difference.message} [{difference.rule}]"))
            count += difference.level != "note"
    return 1 if count else 0


def documented(workspace: Workspace, found: Architecture) -> int:
    """Say on stdout where the interface tables of READMEs and the model disagree; 1 if by more than notes, else 0."""
    from haros_ci.commands.readme_check import differences

    count = 0
    for item in differences(workspace, found):
        click.echo(log_line(f"{item.path}:{item.line}: {item.level}: {item.message} [{item.rule}]"))
        count += item.level != "note"
    return 1 if count else 0
