# SPDX-License-Identifier: Apache-2.0
"""Ruff, where it is installed: with the workspace's ruff settings, which cannot run code, else with its defaults."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator

from haros_ci.linters import installed, python2, settings_files
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

NAME = "ruff"
LANGUAGES = frozenset({"python"})
WHEN = When.INSTALLED
COST = 0.1

MARKS = {".ruff.toml": (), "ruff.toml": (), "pyproject.toml": ("[tool.ruff",)}
SYNTAX = "invalid-syntax"


def locate(options: LintOptions) -> Program | None:
    return installed.binary("ruff", options)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return "1"


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    """One group per settings file, which is named to ruff so that it looks for no other."""
    return settings_files.units(workspace, LANGUAGES, MARKS)


def command(program: Program, batch: Batch) -> Command:
    config = f"--config={batch.workspace.root / batch.group}" if batch.group else "--isolated"
    options = ("check", "--output-format=json", "--no-cache", "--no-fix", "--exit-zero", "--quiet", config)
    return Command((*program.argv, *options, "--", *("./" + file.path for file in batch.files)))


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    """The JSON report: absolute names, code points from 1, ends exclusive; a syntax error may lack its code."""
    roots = {os.path.abspath(batch.workspace.root), os.path.realpath(batch.workspace.root)}
    paths = {os.path.join(root, file.path): file.path for root in roots for file in batch.files}
    silenced: set[str] = set()
    for said in json.loads(output.stdout):
        path, rule = paths.get(said["filename"]), said["code"] or SYNTAX
        if path is None or path in silenced:
            continue
        start, end = said["location"], said["end_location"]
        if rule == SYNTAX and python2.is_python2(batch.workspace.text(path)):
            silenced.add(path)
            yield GaveUp(path, "it is Python 2", start["row"])
            continue
        place = Location(path, start["row"], start["column"], end["row"], end["column"])
        level = Level.ERROR if rule == SYNTAX else Level.WARNING
        yield Finding(path, Result(NAME, rule, level, said["message"], place))
