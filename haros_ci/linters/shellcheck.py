# SPDX-License-Identifier: Apache-2.0
"""ShellCheck on shell scripts, each by itself; of a .shellcheckrc what can lead to no other file."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from posixpath import basename, dirname

from haros_ci.linters import copies, installed, settings_files
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "shellcheck"
LANGUAGES = frozenset({"shell"})
WHEN = When.ASKED
COST = 60.0

MARKS: settings_files.Marks = {".shellcheckrc": (), "shellcheckrc": ()}
#: ``external-sources`` and ``source-path`` would have it read further files.
INERT = regex(r"[ \t]*(?:disable|enable|shell|extended-analysis)=[\w,.:-]+[ \t]*(?:#.*)?")
#: Shells that ShellCheck does not know, by their shebang.
_OTHER_SHELL = regex(r"#![ \t]*(?:\S*/env[ \t]+(?:-\S+[ \t]+)*)?(?:\S*/)?(?:zsh|fish|csh|tcsh|nu|pwsh|xonsh)(?:\s|$)")
LEVELS = {"error": Level.ERROR, "warning": Level.WARNING}


def locate(options: LintOptions) -> Program | None:
    return installed.binary("shellcheck", options)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return ""


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # plan() knows it


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    for unit in settings_files.units(workspace, LANGUAGES, MARKS):
        if not _OTHER_SHELL.match(workspace.text(unit.file.path)):
            yield unit


def command(program: Program, batch: Batch) -> Command:
    """Copies far from each other: a script is not to be read with those that happen to share its batch."""
    copied = _names(batch)
    copies.lay(batch, copied)
    lines = batch.workspace.setting(batch.group).splitlines() if batch.group else []
    copies.put(batch, ".shellcheckrc", "".join(line + "\n" for line in lines if INERT.fullmatch(line)))
    return Command((*program.argv, "--format=json1", "--", *copied), cwd=copies.tree(batch))


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """The json1 report: columns count code points from 1, ends are exclusive."""
    if output.code not in (0, 1):
        raise ValueError(f"exit code {output.code}")
    paths = _names(batch)
    for report in json.loads(output.stdout)["comments"]:
        path, start, end = (
            paths[report["file"]],
            (report["line"], report["column"]),
            (report["endLine"], report["endColumn"]),
        )
        place = Location(path, *start, *(end if end > start else (None, None)))
        level = LEVELS.get(report["level"], Level.NOTE)
        yield Finding(path, Result(NAME, f"SC{report['code']}", level, report["message"], place))


def _names(batch: Batch) -> dict[str, str]:
    """As other copies, but no script lies where it would be taken for its own settings."""
    named = copies.names(batch).items()
    return {name if basename(name) not in MARKS else f"{dirname(name)}/script": path for name, path in named}
